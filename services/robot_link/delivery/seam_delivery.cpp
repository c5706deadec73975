#include "services/robot_link/delivery/seam_delivery.hpp"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace arcstart::robot_link {
namespace {

// The largest standard deviation in any direction; nothing where the random part was not
// determined. A calibration without covariance has no systematic part (all -1).
std::optional<double> deviation(const double (&random)[3][3], const double (&systematic)[3][3]) {
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Matrix covariance = Eigen::Map<const Matrix>(&random[0][0]);
  if (covariance(0, 0) < 0) return std::nullopt;
  const Matrix further = Eigen::Map<const Matrix>(&systematic[0][0]);
  if (further(0, 0) >= 0) covariance += further;
  const double largest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .maxCoeff();
  if (!std::isfinite(largest)) return std::nullopt;
  return std::sqrt(std::max(largest, 0.0));
}

SeamDelivery refused(std::int32_t number, std::string reason) {
  return {number, std::move(reason), {}};
}

std::string why_not_usable(std::int16_t usable) {
  switch (usable) {
    case seam_t::START_NOT_SEEN:
      return "its start was not seen";
    case seam_t::START_UNSURE:
      return "its start is not sure";
    case seam_t::END_NOT_SEEN:
      return "its end was not seen";
    case seam_t::END_UNSURE:
      return "its end is not sure";
    case seam_t::CONTRADICTED:
      return "stripes contradict it";
    case seam_t::CALIBRATION_FAILED:
      return "the calibration did not pass";
    case seam_t::CLOCKS_APART:
      return "the hosts' clocks differ by too much";
    default:
      return fmt::format("reason {}", usable);
  }
}

}  // namespace

SeamDelivery deliver(const seam_t& seam, const DeliveryLimits& limits, std::int64_t now_utime) {
  if (seam.verdict == seam_t::BACKGROUND_STORED)
    return refused(kForeign, "the scan was one of the background");
  if (seam.verdict != seam_t::FOUND)
    return refused(seam.refusal > kValid ? seam.refusal : seam_t::NO_SEAM, seam.reason);
  if (seam.usable != seam_t::USABLE) {
    const bool call = seam.usable >= seam_t::CALIBRATION_FAILED;
    return refused((call ? kNotUsableCall : kNotUsable) + seam.usable,
                   "found, and not usable: " + why_not_usable(seam.usable));
  }
  const double age = static_cast<double>(now_utime - seam.utime) * 1e-6;
  if (!(age <= limits.longest_age))
    return refused(kTooOld, fmt::format("the scan ended {:.1f} s ago, {:.1f} s are allowed", age,
                                        limits.longest_age));
  if (!seam.torch_determined) return refused(kNoTorch, "no torch pose was determined");
  struct Side {
    const char* name;
    std::optional<double> deviation;
    double longest;
  };
  for (const Side& side : {Side{"start", deviation(seam.start_covariance, seam.start_systematic),
                                limits.longest_start_deviation},
                           Side{"end", deviation(seam.end_covariance, seam.end_systematic),
                                limits.longest_end_deviation}}) {
    if (!side.deviation)
      return refused(kTooUncertain,
                     fmt::format("the {}'s deviation was not determined", side.name));
    if (*side.deviation > side.longest)
      return refused(kTooUncertain,
                     fmt::format("the {}'s deviation is {:.3f} mm, {:.3f} mm are allowed",
                                 side.name, *side.deviation, side.longest));
  }
  // The torch keeps its turn from the approach to the end; the wire's tip follows the seam.
  const RigidTransform T_base_start =
      transform_from_arrays(seam.torch_position, seam.torch_quaternion);
  const Eigen::Vector3d along =
      Eigen::Map<const Eigen::Vector3d>(seam.end) - Eigen::Map<const Eigen::Vector3d>(seam.start);
  SeamDelivery delivery{kValid, {}, {}};
  const std::array<Eigen::Vector3d, 3> places = {
      Eigen::Map<const Eigen::Vector3d>(seam.approach_position), T_base_start.translation(),
      T_base_start.translation() + along};
  constexpr const char* kNames[] = {"approach", "start", "end"};
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (places[i](axis) >= limits.box_low[a] && places[i](axis) <= limits.box_high[a]) continue;
      return refused(
          kOutOfBox,
          fmt::format("the {}'s {} is {:.1f} mm and must lie in {:.1f} .. {:.1f}", kNames[i],
                      "xyz"[axis], places[i](axis), limits.box_low[a], limits.box_high[a]));
    }
    RigidTransform T_base_tool = T_base_start;
    T_base_tool.translation() = places[i];
    delivery.positions[i] = limits.T_base_frame.inverse() * T_base_tool;
  }
  return delivery;
}

}  // namespace arcstart::robot_link
