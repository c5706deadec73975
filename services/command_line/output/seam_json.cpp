#include "services/command_line/output/seam_json.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace arcstart::command_line {
namespace {

using Json = nlohmann::ordered_json;

const char* verdict_word(std::int8_t verdict) {
  switch (verdict) {
    case seam_t::FOUND:
      return "found";
    case seam_t::AMBIGUOUS:
      return "ambiguous";
    case seam_t::BACKGROUND_STORED:
      return "background_stored";
    default:
      return "refused";
  }
}

const char* visibility_word(std::int8_t visibility) {
  switch (visibility) {
    case seam_t::SEEN:
      return "seen";
    case seam_t::HIDDEN:
      return "hidden";
    case seam_t::OUTSIDE:
      return "outside";
    default:
      return "not determined";
  }
}

template <std::size_t N>
Json numbers(const double (&values)[N]) {
  return std::vector<double>(values, values + N);
}

template <std::size_t Rows, std::size_t Columns>
Json matrix(const double (&values)[Rows][Columns]) {
  Json rows = Json::array();
  for (const auto& row : values) rows.push_back(numbers(row));
  return rows;
}

Json station(const seam_station_t& s) {
  return {{"distance", s.distance}, {"position", numbers(s.position)},
          {"gap", s.gap},           {"gap_deviation", s.gap_deviation},
          {"residual", s.residual}, {"tack", s.tack != 0}};
}

Json alternative(const seam_alternative_t& a) {
  return {{"joint_type", a.joint_type}, {"score", a.score},     {"start", numbers(a.start)},
          {"end", numbers(a.end)},      {"refusal", a.refusal}, {"reason", a.reason}};
}

}  // namespace

nlohmann::ordered_json seam_to_json(const seam_t& seam) {
  Json json = {{"utime", seam.utime},
               {"run_id", seam.run_id},
               {"scan_id", seam.scan_id},
               {"background_scan_id", seam.background_scan_id},
               {"calibration_id", seam.calibration_id},
               {"command_id", seam.command_id},
               {"request", seam.request},
               {"job", seam.job},
               {"part", seam.part},
               {"verdict", verdict_word(seam.verdict)},
               {"refusal", seam.refusal},
               {"reason", seam.reason},
               {"usable", seam.usable},
               {"remark", seam.remark},
               {"joint_type", seam.joint_type},
               {"start", numbers(seam.start)},
               {"start_covariance", matrix(seam.start_covariance)},
               {"start_systematic", matrix(seam.start_systematic)},
               {"start_visibility", visibility_word(seam.start_visibility)},
               {"start_second", numbers(seam.start_second)},
               {"start_second_weight", seam.start_second_weight},
               {"end", numbers(seam.end)},
               {"end_covariance", matrix(seam.end_covariance)},
               {"end_systematic", matrix(seam.end_systematic)},
               {"end_visibility", visibility_word(seam.end_visibility)},
               {"end_second", numbers(seam.end_second)},
               {"end_second_weight", seam.end_second_weight},
               {"direction", numbers(seam.direction)},
               {"direction_deviation", seam.direction_deviation},
               {"normals", matrix(seam.normals)},
               {"normal_deviations", numbers(seam.normal_deviations)},
               {"angle", seam.angle},
               {"angle_deviation", seam.angle_deviation},
               {"gap", seam.gap},
               {"gap_deviation", seam.gap_deviation},
               {"thickness", seam.thickness},
               {"mismatch", seam.mismatch},
               {"groove_angle", seam.groove_angle},
               {"stripes_checked", seam.stripes_checked},
               {"explained_share", seam.explained_share},
               {"worst_contradiction", seam.worst_contradiction},
               {"polyline", seam.polyline},
               {"polyline_deviation", seam.polyline_deviation},
               {"stations", Json::array()},
               {"alternatives", Json::array()},
               {"torch_determined", seam.torch_determined != 0},
               {"torch_position", numbers(seam.torch_position)},
               {"torch_quaternion", numbers(seam.torch_quaternion)},
               {"approach_position", numbers(seam.approach_position)},
               {"points", seam.points},
               {"background_points", seam.background_points},
               {"seam_points", seam.seam_points},
               {"stripes", seam.stripes},
               {"stripes_empty", seam.stripes_empty},
               {"stripes_overlit", seam.stripes_overlit},
               {"stripes_unusable", seam.stripes_unusable},
               {"stripes_without_pose", seam.stripes_without_pose},
               {"images_lost", seam.images_lost},
               {"profiles_lost", seam.profiles_lost}};
  for (const auto& s : seam.stations) json["stations"].push_back(station(s));
  for (const auto& a : seam.alternatives) json["alternatives"].push_back(alternative(a));
  return json;
}

std::string seam_to_json_line(const seam_t& seam) { return seam_to_json(seam).dump(); }
std::string seam_to_json_text(const seam_t& seam) { return seam_to_json(seam).dump(2); }

}  // namespace arcstart::command_line
