// A case of shared data: a rendered scan in files and its truth.yaml.
#pragma once

#include <Eigen/Core>
#include <string>

#include "common/calibration.hpp"

namespace arcstart::test {

struct CaseTruth {
  Calibration calibration;                 // as truth.yaml has it; of LASER0 on ROBOT0
  std::string joint;                       // "tee", "lap", "butt"; empty where there is no seam
  Eigen::Vector3d a{0, 0, 0}, b{0, 0, 0};  // the seam's ends, along the search; in base, mm
};

// Throws YAML::Exception.
CaseTruth read_case_truth(const std::string& path);

}  // namespace arcstart::test
