#include "services/seam_finding/answer/accuracy.hpp"

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <vector>

#include "services/seam_finding/answer/constants.hpp"

namespace arcstart::seam_finding {
namespace {

struct Sums {
  double n = 0, t = 0, off = 0;
};

// Spread of values with their mean.
struct Spread {
  double n = 0, sum = 0, squares = 0;
  void add(double value) { ++n, sum += value, squares += value * value; }
  double mean() const { return sum / n; }
  double variance() const { return std::max(0.0, squares / n - mean() * mean()); }
};

// Of a plate's plane beside the seam.
struct PlaneAccuracy {
  double middle = 0;       // place along the seam where it is known best; mm
  double height = 0;       // variance at the seam, in the middle; mm2
  double slope_along = 0;  // variance of its slope along the seam
  double slope_away = 0;   // variance of its slope away from it
  bool determined = false;

  double height_at(double along) const {
    return height + slope_along * (along - middle) * (along - middle);
  }
};
using Planes = std::array<PlaneAccuracy, 2>;

// From the points no farther than `distance` mm from the line. spacing: between stripes; mm.
PlaneAccuracy plane_accuracy(const ScanCloud& cloud, const JointPlate& plate,
                             const JointPlate& other, const Line& line, double distance_mm,
                             double spacing_mm) {
  const Eigen::Vector3d away = away_from_seam(plate, other);
  const std::size_t every = 1 + plate.points.size() / kCloud.sample;
  std::vector<int> beside;
  beside.reserve(plate.points.size() / every + 1);
  Spread all;
  for (std::size_t k = 0; k < plate.points.size(); k += every) {
    const int i = plate.points[k];
    const Eigen::Vector3d p = cloud.points[i] - line.point;
    const double t = line.direction.dot(p);
    if (p.squaredNorm() - t * t > distance_mm * distance_mm) continue;
    beside.push_back(i);
    all.add(plate.plane.signed_distance(cloud.points[i]));
  }
  PlaneAccuracy accuracy;
  if (all.n < 3) return accuracy;
  const double limit = kFit.outlier * std::sqrt(all.squares / all.n);

  Spread off, r;
  std::map<int, Sums> stripes;
  Sums* sums = nullptr;  // points of a stripe follow each other
  int last = 0;
  for (const int i : beside) {
    const Eigen::Vector3d& point = cloud.points[i];
    const double distance = plate.plane.signed_distance(point);
    if (cloud.origins[i].segment_end || std::abs(distance) > limit) continue;
    const double t = line.along(point);
    off.add(distance);
    r.add(away.dot(point - line.point));
    const int stripe =
        cloud.organised() ? cloud.origins[i].stripe : static_cast<int>(std::floor(t / spacing_mm));
    if (sums == nullptr || stripe != last) sums = &stripes[stripe], last = stripe;
    sums->n += 1, sums->t += t, sums->off += distance;
  }
  Spread means, places;
  for (const auto& [stripe, seen] : stripes)
    means.add(seen.off / seen.n), places.add(seen.t / seen.n);
  if (means.n < kModel.stripes_in_a_row || !(places.variance() > 0) || !(r.variance() > 0))
    return accuracy;
  const double per_stripe = means.variance() / (means.n - 2);
  const double per_point = off.squares / off.n / off.n / static_cast<double>(every);
  accuracy.middle = places.mean();
  accuracy.slope_along = per_stripe / places.variance();
  accuracy.slope_away = per_point / r.variance();
  accuracy.height = per_stripe + accuracy.slope_away * r.mean() * r.mean() +
                    kAnswer.height_floor * kAnswer.height_floor;
  accuracy.determined = true;
  return accuracy;
}

Eigen::Matrix3d covariance_between(const Joint& joint, const Planes& planes, const SeamEnd& end) {
  // A point moves by e0 out of the one plane, e1 out of the other, and s along the line.
  Eigen::Matrix3d rows;
  rows << joint.plates[0].plane.normal.transpose(), joint.plates[1].plane.normal.transpose(),
      joint.line.direction.transpose();
  const Eigen::Matrix3d inverse = rows.inverse();
  const Eigen::Vector3d variances(planes[0].height_at(end.along), planes[1].height_at(end.along),
                                  end.variance);
  return inverse * variances.asDiagonal() * inverse.transpose();
}

// The line's own point is where the seam is known best.
Eigen::Matrix3d covariance_beside(const Joint& joint, const Planes& planes, const SeamEnd& end) {
  const LineFit& seam = joint.parallel->seam;
  const Eigen::Vector3d& along = joint.line.direction;
  const Eigen::Vector3d across = joint.plates[0].plane.normal.cross(along).normalized();
  const Eigen::Vector3d out = along.cross(across);
  const double sideways = seam.variance + seam.slope_variance * end.along * end.along +
                          kAnswer.across_floor * kAnswer.across_floor;
  return end.variance * along * along.transpose() + sideways * across * across.transpose() +
         planes[0].height_at(end.along) * out * out.transpose();
}

// Of the seam's direction; between crossing plates a plane's slope along the seam tilts it.
double direction_variance(const Joint& joint, const Planes& planes) {
  if (joint.parallel) return joint.parallel->seam.slope_variance + planes[0].slope_along;
  const Eigen::Vector3d sine = joint.plates[0].plane.normal.cross(joint.plates[1].plane.normal);
  return (planes[0].slope_along + planes[1].slope_along) / sine.squaredNorm();
}

}  // namespace

std::optional<SeamAccuracy> seam_accuracy(const ScanCloud& cloud, const Joint& joint,
                                          const std::array<SeamEnd, 2>& ends, const Scales& scales,
                                          const SeamFindingSettings& settings) {
  Planes planes;
  SeamAccuracy accuracy;
  for (int j = 0; j < 2; ++j) {
    planes[j] = plane_accuracy(cloud, joint.plates[j], joint.plates[1 - j], joint.line,
                               settings.refit_distance_mm, scales.spacing);
    if (!planes[j].determined) return std::nullopt;
    accuracy.normals[j] = std::sqrt(planes[j].slope_along + planes[j].slope_away);
  }
  const auto covariance_at = joint.parallel ? covariance_beside : covariance_between;
  accuracy.start = covariance_at(joint, planes, ends[0]);
  accuracy.end = covariance_at(joint, planes, ends[1]);
  accuracy.direction = std::sqrt(direction_variance(joint, planes));
  if (joint.type != JointType::kV)
    accuracy.angle = std::sqrt(planes[0].slope_away + planes[1].slope_away);
  return accuracy;
}

void add_robot_accuracy(double deviation_mm, SeamResult& seam) {
  if (deviation_mm == 0 || !seam.accuracy) return;
  const double variance = deviation_mm * deviation_mm;
  for (Eigen::Matrix3d* covariance : {&seam.accuracy->start, &seam.accuracy->end})
    if ((*covariance)(0, 0) >= 0) *covariance += variance * Eigen::Matrix3d::Identity();
  const double turn = 2 * variance / (seam.end - seam.start).squaredNorm();
  seam.accuracy->direction = std::sqrt(std::pow(seam.accuracy->direction, 2) + turn);
  for (double& normal : seam.accuracy->normals) normal = std::sqrt(normal * normal + turn);
}

}  // namespace arcstart::seam_finding
