#include "tests/bench/seam/wild/judgement.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"

namespace arcstart {

using cell_simulator::WildEnd;
using cell_simulator::WildSeam;
using cell_simulator::WildTruth;
using Eigen::Matrix3d, Eigen::Vector3d;
namespace {

constexpr double sure = 3;  // deviations
// What matters: mm along the seam and across it; deg of direction and normals.
constexpr double along_mm = 1, across_mm = 0.5, direction_deg = 1, normal_deg = 2;
// Another seam: its middle is so far off the true one's line, or it is turned so to it. As in the
// design's seam error.
constexpr double other_mm = 5, other_deg = 5;
constexpr double bent_mm = 0.05;  // bow from which a seam counts as bent

using Vector = Eigen::Map<const Vector3d>;
using Matrix = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

// Along, across, out of the first plate.
struct Axes {
  Vector3d along, across, height;
  bool bent;

  explicit Axes(const WildSeam& seam)
      : along(seam.direction),
        across(seam.direction.cross(seam.normals[0]).normalized()),
        height(across.cross(along)),
        bent(seam.bow_mm > bent_mm) {}
};

double deviation_in(const Vector3d& axis, const Matrix3d& covariance) {
  return std::sqrt(std::max(0.0, axis.dot(covariance * axis)));
}

// Less by what is open, not beyond 0.
double beyond(double error, double open) {
  return std::copysign(std::max(0.0, std::abs(error) - open), error);
}

bool is_silent(double error, double deviation, double matters) {
  return std::abs(error) > matters && std::abs(error) > sure * deviation;
}

double ratio_of(double error, double deviation, double matters) {
  constexpr double least = 1e-3;  // so that a deviation of 0 divides
  return std::abs(error) > matters / sure ? std::abs(error) / std::max(deviation, least) : 0;
}

// open: along the seam; beside: across it and in height.
struct Open {
  double along = 0, beside = 0;
};

PlaceError place_error(const Axes& axes, const Vector3d& error, const Open& open,
                       const Matrix3d& covariance) {
  PlaceError place;
  place.along = beyond(axes.along.dot(error), open.along);
  place.across = beyond(axes.across.dot(error), open.beside);
  if (!axes.bent) place.height = beyond(axes.height.dot(error), open.beside);
  if (covariance(0, 0) < 0) return place;
  place.deviation = deviation_in(axes.along, covariance);
  const double beside = deviation_in(axes.across, covariance),
               over = deviation_in(axes.height, covariance);
  place.silent = is_silent(place.along, place.deviation, along_mm) ||
                 is_silent(place.across, beside, across_mm) ||
                 is_silent(place.height, over, across_mm);
  place.ratio = std::max({ratio_of(place.along, place.deviation, along_mm),
                          ratio_of(place.across, beside, across_mm),
                          ratio_of(place.height, over, across_mm)});
  return place;
}

std::string told(const PlaceError& place) {
  return fmt::format("along {:.2f}, across {:.2f}, height {:.2f}, deviation along {:.2f} mm",
                     place.along, place.across, place.height, place.deviation);
}

class Judge {
 public:
  Judge(const seam_t& seam, const WildSeam& truth, double robot, WildJudgement& judgement)
      : seam_(seam), truth_(truth), axes_(truth), robot_(robot), judgement_(judgement) {}

  void judge() {
    judgement_.start = end_of(seam_.start, seam_.start_covariance, truth_.start);
    judgement_.end = end_of(seam_.end, seam_.end_covariance, truth_.end);
    take(judgement_.start, SilentError::Where::kStart, "start", seam_.start_visibility);
    take(judgement_.end, SilentError::Where::kEnd, "end", seam_.end_visibility);
    judge_stations();
    judge_direction();
    judge_normals();
  }

 private:
  PlaceError end_of(const double (&place)[3], const double (&covariance)[3][3],
                    const WildEnd& end) const {
    return place_error(axes_, Vector(place) - end.point, {end.play_mm + robot_, robot_},
                       Matrix(&covariance[0][0]));
  }

  void take(const PlaceError& place, SilentError::Where where, const char* what,
            std::int8_t visibility) {
    judgement_.worst_ratio = std::max(judgement_.worst_ratio, place.ratio);
    if (place.silent)
      judgement_.silent.push_back(
          {where, fmt::format("{} {}, {}", what, told(place), name_of_visibility(visibility))});
  }

  // The places between the ends are as sure as the less sure end; along the seam they are free.
  void judge_stations() {
    const Matrix start(&seam_.start_covariance[0][0]), end(&seam_.end_covariance[0][0]);
    if (start(0, 0) < 0 || end(0, 0) < 0) return;
    PlaceError worst;
    double at = 0;
    for (const seam_station_t& station : seam_.stations) {
      PlaceError place, other;
      const Vector3d error = Vector(station.position) - truth_.start.point;
      const Open free{1e6, robot_};
      place = place_error(axes_, error, free, start);
      other = place_error(axes_, error, free, end);
      const PlaceError& milder = place.ratio < other.ratio ? place : other;
      if (milder.ratio >= worst.ratio)
        worst = milder, worst.silent = place.silent && other.silent, at = station.distance;
    }
    judgement_.worst_ratio = std::max(judgement_.worst_ratio, worst.ratio);
    if (worst.silent)
      add(fmt::format("station at {:.1f} mm across {:.2f}, height {:.2f} mm", at, worst.across,
                      worst.height));
  }

  void judge_direction() {
    Vector3d direction = Vector(seam_.direction);
    judgement_.direction = angle_between(direction, axes_.along) / kDegree;
    if (axes_.bent) direction -= axes_.height.dot(direction) * axes_.height;
    angle("direction", angle_between(direction, axes_.along), seam_.direction_deviation,
          direction_deg);
  }

  // Either order of the plates.
  void judge_normals() {
    double off[2][2];
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        Vector3d normal = Vector(seam_.normals[i]), truth = truth_.normals[j];
        if (axes_.bent) {
          normal -= axes_.along.dot(normal) * axes_.along;
          truth -= axes_.along.dot(truth) * axes_.along;
        }
        off[i][j] = angle_between(normal, truth);
      }
    const bool swapped = off[0][1] + off[1][0] < off[0][0] + off[1][1];
    for (int i = 0; i < 2; ++i)
      angle(i == 0 ? "first normal" : "second normal", off[i][swapped ? 1 - i : i],
            seam_.normal_deviations[i], normal_deg);
  }

  void angle(const char* what, double off, double deviation, double matters) {
    if (deviation < 0) return;
    judgement_.worst_ratio =
        std::max(judgement_.worst_ratio, ratio_of(off, deviation, matters * kDegree));
    if (is_silent(off, deviation, matters * kDegree))
      add(fmt::format("{} {:.2f} deg, deviation {:.3f} deg", what, off / kDegree,
                      deviation / kDegree));
  }

  void add(std::string text) {
    judgement_.silent.push_back({SilentError::Where::kElse, std::move(text)});
  }

  const seam_t& seam_;
  const WildSeam& truth_;
  const Axes axes_;
  double robot_;  // mm, that are open on account of the robot
  WildJudgement& judgement_;
};

// Along the true seam, on how much of it the answer lies in its line; mm, 0: it is another.
double common_length(const seam_t& seam, const WildSeam& truth) {
  const Vector3d start = Vector(seam.start), end = Vector(seam.end);
  const Vector3d error = (start + end) / 2 - truth.start.point;
  const double across = (error - error.dot(truth.direction) * truth.direction).norm();
  if (across > other_mm ||
      angle_between(Vector3d(Vector(seam.direction)), truth.direction) > other_deg * kDegree)
    return 0;
  const auto along = [&](const Vector3d& p) { return truth.direction.dot(p - truth.start.point); };
  return std::min(along(end), along(truth.end.point)) - std::max(along(start), 0.0);
}

}  // namespace

double PlaceError::distance() const { return Vector3d(along, across, height).norm(); }

bool WildJudgement::silently(SilentError::Where where) const {
  return std::any_of(silent.begin(), silent.end(),
                     [&](const SilentError& error) { return error.where == where; });
}

WildJudgement judge(const seam_t& seam, const WildTruth& truth, double robot_mm) {
  WildJudgement judgement;
  judgement.found = seam.verdict == seam_t::FOUND;
  if (!judgement.found) return judgement;
  double longest = 0;
  for (std::size_t i = 0; i < truth.seams.size(); ++i) {
    const double common = common_length(seam, truth.seams[i]);
    if (common > longest) longest = common, judgement.seam = static_cast<int>(i);
  }
  judgement.right = judgement.seam >= 0;
  if (judgement.right) {
    Judge(seam, truth.seams[judgement.seam], 0, judgement).judge();
    if (robot_mm > 0 && !judgement.silent.empty()) {
      // Two axes at once, for the seam runs askew.
      WildJudgement milder;
      Judge(seam, truth.seams[judgement.seam], std::sqrt(2.0) * robot_mm, milder).judge();
      judgement.by_robot = milder.silent.empty();
    }
    return judgement;
  }
  constexpr double wrong_ratio = 1e4;  // worse than any error of a right one
  judgement.worst_ratio = wrong_ratio;
  std::string text = fmt::format("WRONG {}: start {:.0f} {:.0f} {:.0f}, end {:.0f} {:.0f} {:.0f}",
                                 seam.joint_type, seam.start[0], seam.start[1], seam.start[2],
                                 seam.end[0], seam.end[1], seam.end[2]);
  if (truth.wrong)
    text += ", there is none";
  else
    for (const WildSeam& other : truth.seams)
      text += fmt::format(", true {:.0f} {:.0f} {:.0f}, {:.0f} {:.0f} {:.0f}",
                          other.start.point.x(), other.start.point.y(), other.start.point.z(),
                          other.end.point.x(), other.end.point.y(), other.end.point.z());
  judgement.silent.push_back({SilentError::Where::kElse, text});
  return judgement;
}

const char* name_of_visibility(std::int8_t visibility) {
  switch (visibility) {
    case seam_t::SEEN:
      return "SEEN";
    case seam_t::HIDDEN:
      return "HIDDEN";
    case seam_t::OUTSIDE:
      return "OUTSIDE";
    default:
      return "NOT_DETERMINED";
  }
}

}  // namespace arcstart
