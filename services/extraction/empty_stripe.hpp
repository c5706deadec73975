// Why an image gives no stripe: a code by which everybody decides, and its words for people.
#pragma once

#include <cstdint>
#include <string>

namespace arcstart::extraction {

// Values as in stripe_t.
enum class EmptyStripe : std::int8_t {
  kNone = 0,             // it gives one
  kNoStripe = 1,         // a whole image that shows none
  kTooMuchLight = 2,     // more lines than a stripe can be told from
  kIncompleteImage = 3,  // lost on its way from the camera
  kLaserOff = 4,
  kUnreadableImage = 5,
  kUnknownEncoding = 6
};

// detail: of kTooMuchLight the limit that was passed, of kIncompleteImage and kUnreadableImage what
// is wrong with it, of kUnknownEncoding its number in image_t.
std::string to_words(EmptyStripe why, const std::string& detail = "");

}  // namespace arcstart::extraction
