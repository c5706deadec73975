#include "services/command_line/output/seam_error.hpp"

#include <fmt/core.h>

#include "common/geometry.hpp"

namespace arcstart::command_line {

SeamError seam_error(const seam_t& seam, const truth_t& truth) {
  const Eigen::Map<const Eigen::Vector3d> answer(seam.start), answer_direction(seam.direction);
  const Eigen::Map<const Eigen::Vector3d> start(truth.start), end(truth.end),
      direction(truth.direction);
  const Eigen::Vector3d error = answer - start;
  SeamError result{};
  result.start_mm = error.norm();
  result.along_mm = error.dot(direction);
  result.lateral_mm = (error - result.along_mm * direction).norm();
  result.direction_deg = angle_between(answer_direction, direction) * 180 / M_PI;
  result.wrong = result.lateral_mm > 5 || result.direction_deg > 5 ||
                 seam.joint_type != truth.joint_type || (answer - end).norm() < error.norm();
  return result;
}

std::string verdict_line(const seam_t& seam, const truth_t& truth) {
  if (seam.verdict != seam_t::FOUND) return "no seam: " + seam.reason;
  const SeamError error = seam_error(seam, truth);
  return fmt::format("seam found: start error {:.2f} mm, lateral {:.3f} mm, direction {:.3f} deg{}",
                     error.start_mm, error.lateral_mm, error.direction_deg,
                     error.wrong ? " - WRONG" : "");
}

}  // namespace arcstart::command_line
