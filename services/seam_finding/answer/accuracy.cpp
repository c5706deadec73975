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

Eigen::Matrix3d covariance_at(const std::array<JointPlate, 2>& plates, const Line& line,
                              const std::array<PlaneAccuracy, 2>& accuracies, const SeamEnd& end) {
  // A point moves by e0 out of the one plane, e1 out of the other, and s along the line.
  Eigen::Matrix3d rows;
  rows << plates[0].plane.normal.transpose(), plates[1].plane.normal.transpose(),
      line.direction.transpose();
  const Eigen::Matrix3d inverse = rows.inverse();
  const Eigen::Vector3d variances(accuracies[0].height_at(end.along),
                                  accuracies[1].height_at(end.along), end.variance);
  return inverse * variances.asDiagonal() * inverse.transpose();
}

}  // namespace

PlaneAccuracy plane_accuracy(const ScanCloud& cloud, const JointPlate& plate,
                             const JointPlate& other, const Line& line, double distance_mm,
                             double spacing_mm) {
  const Eigen::Vector3d away = away_from_seam(plate, other);
  const std::size_t every = 1 + plate.points.size() / kCloud.small_sample;
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
  if (means.n < kModel.plane_stripes || !(places.variance() > 0) || !(r.variance() > 0))
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

std::array<PlaneAccuracy, 2> plane_accuracies(const ScanCloud& cloud, const Joint& joint,
                                              const Scales& scales,
                                              const SeamFindingSettings& settings) {
  const auto of_plate = [&](int j) {
    return plane_accuracy(cloud, joint.plates[j], joint.plates[1 - j], joint.line,
                          settings.refit_distance_mm, scales.spacing);
  };
  return {of_plate(0), of_plate(1)};
}

std::optional<SeamAccuracy> crossing_accuracy(const Joint& joint,
                                              const std::array<PlaneAccuracy, 2>& accuracies,
                                              const std::array<SeamEnd, 2>& ends) {
  if (!accuracies[0].determined || !accuracies[1].determined) return std::nullopt;
  SeamAccuracy accuracy;
  accuracy.start = covariance_at(joint.plates, joint.line, accuracies, ends[0]);
  accuracy.end = covariance_at(joint.plates, joint.line, accuracies, ends[1]);
  double across = 0;  // of the direction, as a plane's slope along the seam tilts it
  const double sine = joint.plates[0].plane.normal.cross(joint.plates[1].plane.normal).norm();
  for (int j = 0; j < 2; ++j) {
    across += accuracies[j].slope_along / (sine * sine);
    accuracy.normals[j] = std::sqrt(accuracies[j].slope_along + accuracies[j].slope_away);
  }
  accuracy.direction = std::sqrt(across);
  accuracy.angle = std::sqrt(accuracies[0].slope_away + accuracies[1].slope_away);
  return accuracy;
}

std::optional<SeamAccuracy> parallel_accuracy(const Joint& joint,
                                              const std::array<PlaneAccuracy, 2>& accuracies,
                                              const std::array<SeamEnd, 2>& ends) {
  if (!accuracies[0].determined || !accuracies[1].determined) return std::nullopt;
  const LineFit& seam = joint.parallel->seam;
  const Eigen::Vector3d& along = joint.line.direction;
  const Eigen::Vector3d across = joint.plates[0].plane.normal.cross(along).normalized();
  const Eigen::Vector3d out = along.cross(across);
  const auto covariance_at = [&](const SeamEnd& place) -> Eigen::Matrix3d {
    // The line's own point is where the seam is known best.
    const double sideways = seam.variance + seam.slope_variance * place.along * place.along;
    return place.variance * along * along.transpose() +
           (sideways + kAnswer.across_floor * kAnswer.across_floor) * across * across.transpose() +
           accuracies[0].height_at(place.along) * out * out.transpose();
  };
  SeamAccuracy accuracy;
  accuracy.start = covariance_at(ends[0]);
  accuracy.end = covariance_at(ends[1]);
  accuracy.direction = std::sqrt(seam.slope_variance + accuracies[0].slope_along);
  for (int j = 0; j < 2; ++j)
    accuracy.normals[j] = std::sqrt(accuracies[j].slope_along + accuracies[j].slope_away);
  if (joint.type != JointType::kV)
    accuracy.angle = std::sqrt(accuracies[0].slope_away + accuracies[1].slope_away);
  return accuracy;
}

}  // namespace arcstart::seam_finding
