// Why a scan gives no seam, decided before one is sought: a code by which everybody decides, and
// its words for people.
#pragma once

#include <cstdint>
#include <string>

namespace arcstart::seam_finding {

struct ScanRefusal {
  std::int16_t code = 0;  // a constant of seam_t, 0 where nothing is refused
  std::string words;

  bool empty() const { return code == 0; }
};

// detail: where stripes are missing, how many and for what ("20 of 60 stripes are missing: 20
// images with too much light; "); of NO_PROFILES and SENSOR_CAPTURE_SILENT the seconds waited, of
// CLOCKS_DIFFER by how much.
ScanRefusal refuse_scan(std::int16_t code, const std::string& detail = "");

}  // namespace arcstart::seam_finding
