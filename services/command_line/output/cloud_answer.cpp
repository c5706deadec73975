#include "services/command_line/output/cloud_answer.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

#include "services/command_line/clouds/cloud_picture.hpp"
#include "services/command_line/clouds/point_cloud.hpp"
#include "services/seam_finding/answer/wording.hpp"

namespace arcstart::command_line {
namespace {

using Verdict = seam_finding::SeamResult::Verdict;

std::string end_in_words(const char* name, const Eigen::Vector3d& place,
                         seam_finding::EndVisibility visibility, const Eigen::Matrix3d* covariance,
                         const Eigen::Vector3d& direction) {
  if (visibility == seam_finding::EndVisibility::kNotDetermined)
    return fmt::format("{} not determined, near {} mm", name, in_words(place, 0));
  if (!covariance) return fmt::format("{} {} mm", name, in_words(place, 2));
  return fmt::format("{} {} mm (deviation {:.2f} mm along)", name, in_words(place, 2),
                     std::sqrt(std::max(0.0, direction.dot(*covariance * direction))));
}

std::string verdict_line(const seam_finding::SeamResult& result) {
  if (result.verdict == Verdict::kAmbiguous) return "ambiguous: " + in_words(result.reason);
  if (result.verdict == Verdict::kRefused) return "refused: " + in_words(result.reason);
  const auto& accuracy = result.accuracy;
  return fmt::format("found {}, {}, {}, direction {}", result.joint_type,
                     end_in_words("start", result.start, result.start_visibility,
                                  accuracy ? &accuracy->start : nullptr, result.direction),
                     end_in_words("end", result.end, result.end_visibility,
                                  accuracy ? &accuracy->end : nullptr, result.direction),
                     in_words(result.direction, 4));
}

}  // namespace

std::string in_words(const Eigen::Vector3d& v, int decimals) {
  return fmt::format("({:.{}f}, {:.{}f}, {:.{}f})", v.x(), decimals, v.y(), decimals, v.z(),
                     decimals);
}

std::vector<std::string> answer_lines(const seam_finding::SeamResult& result) {
  std::vector<std::string> lines = {verdict_line(result)};
  for (const seam_finding::Reason& remark : result.remarks) lines.push_back(in_words(remark));
  for (const auto& other : result.alternatives)
    lines.push_back(fmt::format("also {} mm to {} mm, score {:.1f}: {}", in_words(other.start, 1),
                                in_words(other.end, 1), other.score, in_words(other.reason)));
  return lines;
}

void draw_answer(const seam_finding::ScanCloud& cloud, const seam_finding::SeamResult& result,
                 const std::optional<Plane>& dominant_plane, const std::string& cloud_name,
                 const std::string& path) {
  enum Part : char { kOther, kBackground, kFirst, kSecond };
  std::vector<Part> parts(cloud.points.size(), kOther);
  for (const int i : result.background) parts[i] = kBackground;
  for (const int i : result.plates[0]) parts[i] = kFirst;
  for (const int i : result.plates[1]) parts[i] = kSecond;
  CloudPicture picture;
  for (int i = 0; i < cloud.size(); ++i)
    (parts[i] == kOther        ? picture.others
     : parts[i] == kBackground ? picture.background
                               : picture.plates[parts[i] - kFirst])
        .push_back(cloud.points[i]);
  for (const auto& other : result.alternatives)
    picture.alternatives.emplace_back(other.start, other.end);
  if (dominant_plane) picture.up = dominant_plane->normal;
  picture.toward_viewer = picture.up + picture.up.unitOrthogonal();
  picture.title = cloud_name + ": " + in_words(result.reason);
  if (result.verdict == Verdict::kFound) {
    picture.seam = {result.start, result.end};
    picture.toward_viewer = result.normals[0] + result.normals[1] - 0.6 * result.direction;
    picture.title = fmt::format("{}: {}, start {} mm", cloud_name, result.joint_type,
                                in_words(result.start, 1));
  }
  draw_cloud(picture, path);
}

void write_stations(const seam_finding::SeamResult& result, const std::string& path) {
  std::string text = "distance,x,y,z,residual,tack,gap\n";  // mm
  for (const seam_finding::SeamMeasurement& place : result.stations)
    text += fmt::format("{:.3f},{:.4f},{:.4f},{:.4f},{},{},{}\n", place.along, place.position.x(),
                        place.position.y(), place.position.z(),
                        place.residual < 0 ? "" : fmt::format("{:.4f}", place.residual),
                        place.tack ? 1 : 0, place.gap < 0 ? "" : fmt::format("{:.3f}", place.gap));
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw PointCloudFileError(path + ": cannot be written: " + std::strerror(errno));
}

}  // namespace arcstart::command_line
