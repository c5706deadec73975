// A synthetic scan as the messages that extraction, reconstruction and sensor_capture would send.
#pragma once

#include <arcstart/profile_t.hpp>
#include <arcstart/scan_t.hpp>
#include <string>
#include <vector>

#include "services/seam_finding/cloud/sampling.hpp"

namespace arcstart::seam_finding::synthetic {

struct ScanMessages {
  scan_t scanning{}, ended{};
  std::vector<profile_t> profiles;
};

struct ScanIdentity {
  std::int64_t run_id = 1'700'000'000'000'000;
  std::int64_t scan_id = 1'700'000'100'000'000;
  std::int8_t kind = scan_t::WORKPIECE;
  std::int64_t first_seq = 500;
  std::string calibration_id = "calibration-1";
  std::int64_t request = 7;
  std::string job = "job", part = "part";
};
ScanMessages to_messages(const ScanCloud& cloud, const ScanIdentity& identity);

// States of no scan: of a sensor_capture that has just started.
scan_t idle_state(std::int64_t run_id);

}  // namespace arcstart::seam_finding::synthetic
