// Why a stripe gives no points: a code by which everybody decides, and its words for people.
#pragma once

#include <cstdint>
#include <string>

namespace arcstart::reconstruction {

// Values as in profile_t; up to kUnknownEncoding extraction's own, as in stripe_t.
enum class EmptyProfile : std::int8_t {
  kNone = 0,  // it gives points
  kNoStripe = 1,
  kTooMuchLight = 2,
  kIncompleteImage = 3,
  kLaserOff = 4,
  kUnreadableImage = 5,
  kUnknownEncoding = 6,
  kNoneChosen = 9,  // second candidates alone
  kNoPosition = 10,
  kNoCalibration = 11,
  kCalibrationChanged = 12,  // within the scan
  kOtherSensor = 13,         // the image is of another size than the calibration's sensor
  kOutOfRange = 14,          // no point within the working range
  kWrongTime = 15            // far ahead of the positions and of the stripe after it
};

// The stripe itself has no centre that could become a point: nothing is wrong here.
inline bool lies_with_stripe(EmptyProfile why) {
  return why > EmptyProfile::kNone && why <= EmptyProfile::kNoneChosen;
}

// detail: of extraction's own reasons its words, of kNoPosition and kOtherSensor what was found.
std::string to_words(EmptyProfile why, const std::string& detail = "");

}  // namespace arcstart::reconstruction
