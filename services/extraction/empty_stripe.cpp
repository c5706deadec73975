#include "services/extraction/empty_stripe.hpp"

namespace arcstart::extraction {

std::string to_words(EmptyStripe why, const std::string& detail) {
  switch (why) {
    case EmptyStripe::kNone:
      break;
    case EmptyStripe::kNoStripe:
      return "no stripe found";
    case EmptyStripe::kTooMuchLight:
      if (detail.empty()) return "the surface is full of lines, and none stands out as the stripe";
      return "more than " + detail + " ridge points, too many to tell a stripe from";
    case EmptyStripe::kIncompleteImage:
      return "image incomplete: " + detail;
    case EmptyStripe::kLaserOff:
      return "laser off";
    case EmptyStripe::kUnreadableImage:
      return detail;
    case EmptyStripe::kUnknownEncoding:
      return "encoding " + detail + " is not read yet: send MONO8 or PNG";
  }
  return "";
}

}  // namespace arcstart::extraction
