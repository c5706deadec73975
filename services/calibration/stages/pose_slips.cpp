#include "services/calibration/stages/pose_slips.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "services/calibration/stages/hand_eye_fit.hpp"

namespace arcstart::calibration {
namespace {

constexpr std::size_t kFewestShown = 5;  // poses, as for a calibration
// Above this no robot errs so, the poses mean something else; the worst real set known, whose
// robot is off by 3.4 mm, has 7.
constexpr double kNoHandEye = 20;  // mm
// Share by which a length unit's factor may be off: the next unit is 2.5 times another.
constexpr double kUnit = 0.1;
constexpr double kSureUnit = 5;  // standard deviations
// Misfits whose ratio is less come to the same - calibration_stages_test: 10 draws a slip.
constexpr double kAlike = 1.5;
// Times, where the poses fit as they stand: such as turn about the plate alone leave little apart
// even where they mean something else - calibration_stages_test, as above.
constexpr double kClearlyBetter = 5;
// mm; the worst real set known has 4.4.
constexpr double kPositionsFit = 5;

struct LengthUnit {
  double factor;  // of the plate's lengths, that the robot's moves fit
  const char* what;
  const char* cure;
};

constexpr const char* kPositions =
    "poses.csv wants mm; arcstart import calibration --pose-units reads others";
constexpr const char* kLengths = "plate.yaml wants mm";
constexpr LengthUnit kUnits[] = {{1, "", ""},
                                 {1e-3, "positions in metres", kPositions},
                                 {0.1, "positions in centimetres", "poses.csv wants mm"},
                                 {1 / 25.4, "positions in inches", kPositions},
                                 {10, "the plate's lengths in centimetres", kLengths},
                                 {25.4, "the plate's lengths in inches", kLengths},
                                 {1e3, "the plate's lengths in metres", kLengths}};

// As what the moves' lengths fit, if they do.
const LengthUnit* unit_of(const HandEyeFit& fit) {
  if (!(fit.misfit_mm < kNoHandEye)) return nullptr;
  for (const LengthUnit& unit : kUnits)
    if (std::abs(std::abs(fit.factor) / unit.factor - 1) <
        std::max(kUnit, kSureUnit * fit.deviation / unit.factor))
      return &unit;
  return nullptr;
}

// But for the plate's pitch, which may be another one; that is told by scale_consistency.
bool fits_as_given(const HandEyeFit& free) {
  constexpr double kOtherPitch = 3;  // less than between any two units
  return free.misfit_mm < kNoHandEye && free.factor > 1 / kOtherPitch && free.factor < kOtherPitch;
}

std::string distance(double mm) {
  return mm < 1000 ? fmt::format("{:.0f} mm", mm) : "more than a metre";
}

std::string joined(const std::string& a, const char* between, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + between + b;
}

// The poses of a plate on the robot before a camera that stands look like inverted ones: told by
// which of the two lies nearer to what moves.
bool looks_eye_to_hand(const HandEyeFit& inverted) {
  return inverted.T_tool_camera.translation().norm() > inverted.T_base_plate.translation().norm();
}

std::string words(const PoseReading& reading, const HandEyeFit& fit, const LengthUnit& unit) {
  std::string what = joined(reading.what, " and ", unit.what);
  std::string cure = joined(reading.cure, "; ", unit.cure);
  if (fit.factor < 0) {
    what = joined(what, " and ", "everything mirrored");
    cure = joined(cure, "; ",
                  "a left-handed base or tool, or mirrored images: give right-handed poses, switch "
                  "the camera's ReverseX and ReverseY off");
  }
  if (reading.inverts)
    cure += looks_eye_to_hand(fit)
                ? fmt::format(
                      "; or the camera stands still, {} from base, and the robot holds the "
                      "plate (eye-to-hand), which looks the same: arcstart wants the "
                      "camera on the robot",
                      distance(fit.T_tool_camera.translation().norm()))
                : "; a camera that stands before a plate on the robot (eye-to-hand) looks the same";
  return fmt::format("{} ({:.1f} mm): {}", what, fit.misfit_mm, cure);
}

}  // namespace

std::string pose_slip(const Target& plate, const std::vector<PairedPose>& poses) {
  const auto shown = std::count_if(
      poses.begin(), poses.end(), [](const auto& pose) { return pose.T_camera_plate.has_value(); });
  if (shown < static_cast<std::ptrdiff_t>(kFewestShown)) return "";
  const HandEyeFit free = fit_hand_eye(plate, poses);
  const double as_given =
      fits_as_given(free) ? free.misfit_mm : fit_hand_eye(plate, poses, 1.0).misfit_mm;
  const bool refused = as_given >= kNoHandEye;
  std::string best_words;
  double best = refused ? as_given : as_given / kClearlyBetter;
  for (const PoseReading& reading : pose_readings()) {
    const HandEyeFit fit = fit_hand_eye(plate, reading.read(poses));
    const LengthUnit* unit = unit_of(fit);
    if (!unit || kAlike * fit.misfit_mm > best) continue;
    best = fit.misfit_mm;
    best_words = words(reading, fit, *unit);
  }
  if (!refused && best_words.empty()) return "";
  const std::string none = fmt::format(
      "no hand-eye fits the robot's poses: they put the plate {} apart", distance(as_given));
  if (!best_words.empty()) return none + ". They fit with " + best_words;
  const auto positions = position_misfit(poses);
  if (positions && *positions < kPositionsFit)
    return none + fmt::format(
                      ". Their positions fit the images ({:.1f} mm), their orientations do not, in "
                      "no usual order: angles in degrees, which were read as radians, look so; "
                      "arcstart import calibration --pose-format wpr reads degrees",
                      *positions);
  return none +
         ". None of the usual slips explains it (order and unit of the angles, quaternions, "
         "inverted or mirrored poses, length units, images paired with other poses): take "
         "images and poses anew of a plate that stays where it is";
}

}  // namespace arcstart::calibration
