#include "services/seam_finding/scan/scan_refusal.hpp"

#include <arcstart/seam_t.hpp>

namespace arcstart::seam_finding {
namespace {

std::string to_words(std::int16_t code, const std::string& detail) {
  switch (code) {
    case seam_t::TOO_LITTLE_KNOWN:
      return "too little of the scan is known, " + detail + "scan again";
    case seam_t::TOO_MUCH_LIGHT:
      return "too little of the scan is known, " + detail +
             "keep other light off the work, then scan again";
    case seam_t::BACKGROUND_INCOMPLETE:
      return "the background is not complete, " + detail + "scan again";
    case seam_t::BACKGROUND_OVERLIT:
      return "the background is not complete, " + detail +
             "keep other light off the cell, then scan again";
    case seam_t::SENSOR_CAPTURE_RESTARTED:
      return "sensor_capture restarted within the scan: scan again";
    case seam_t::END_NOT_REPORTED:
      return "the scan's end was never told: scan again";
    case seam_t::NO_IMAGES:
      return "the scan has no images";
    case seam_t::CALIBRATION_CHANGED:
      return "the calibration changed within the scan: scan again";
    case seam_t::NO_STRIPE:
      return "no stripe in any image: is the laser on, and the work within the working range?";
    case seam_t::BACKGROUND_EMPTY:
      return "the background scan has no points: is the laser on, and the table within the working "
             "range?";
    case seam_t::NO_BACKGROUND:
      return "no background: scan the empty cell under this calibration first (scan --kind "
             "background)";
    case seam_t::TOO_MANY_POINTS:
      return "the scan has more points than memory is kept for: scan less, or thin it out";
    case seam_t::CAMERA_LOST:
      return "the camera was lost in the background scan: scan again";
    case seam_t::CLOCKS_DIFFER:
      return "the clocks of the hosts that stamp images and positions differ by " + detail +
             ": let both follow one source, by chrony or PTP, wait two minutes, scan again";
    case seam_t::TWO_SENDERS:
      return "two senders: of sensor_capture, extraction, reconstruction or robot_pose two do the "
             "same work, or a stranger sends: see 'arcstart monitor', end one, scan again";
    case seam_t::NO_PROFILES:
      return "chain dead: no profile for " + detail +
             " s after the scan's end: see the STATUS of extraction, reconstruction and robot_pose";
    case seam_t::SENSOR_CAPTURE_SILENT:
      return "chain dead: no word of the running scan for " + detail +
             " s: see the STATUS of sensor_capture";
    default:
      return "refusal " + std::to_string(code);
  }
}

}  // namespace

ScanRefusal refuse_scan(std::int16_t code, const std::string& detail) {
  return {code, to_words(code, detail)};
}

}  // namespace arcstart::seam_finding
