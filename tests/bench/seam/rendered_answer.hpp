// One background and one workpiece scan in rendered images, through the whole pipeline.
#pragma once

#include <arcstart/seam_t.hpp>
#include <arcstart/truth_t.hpp>
#include <cstdint>
#include <string>

#include "tests/bench/seam/simulated_scan.hpp"

namespace arcstart {

struct RenderedAnswer {
  seam_t seam{};
  truth_t truth{};
};

// joint_type: the setting of seam_finding; all else as it ships.
RenderedAnswer answer_rendered(const SimulatedScanSettings& settings, const std::string& joint_type,
                               std::uint64_t seed);

}  // namespace arcstart
