#include "services/reconstruction/empty_profile.hpp"

namespace arcstart::reconstruction {

std::string to_words(EmptyProfile why, const std::string& detail) {
  switch (why) {
    case EmptyProfile::kNone:
      return "";
    case EmptyProfile::kNoneChosen:
      return "stripe empty: no centre chosen";
    case EmptyProfile::kNoPosition:
    case EmptyProfile::kOtherSensor:
      return detail;
    case EmptyProfile::kNoCalibration:
      return "no calibration";
    case EmptyProfile::kCalibrationChanged:
      return "calibration changed within the scan";
    case EmptyProfile::kOutOfRange:
      return "no point within the working range";
    case EmptyProfile::kWrongTime:
      return "its time lies far ahead of the positions and of the stripe after it";
    case EmptyProfile::kNoStripe:
    case EmptyProfile::kTooMuchLight:
    case EmptyProfile::kIncompleteImage:
    case EmptyProfile::kLaserOff:
    case EmptyProfile::kUnreadableImage:
    case EmptyProfile::kUnknownEncoding:
      break;
  }
  return "stripe empty: " + detail;
}

}  // namespace arcstart::reconstruction
