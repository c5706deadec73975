#include "services/extraction/image/laser_light.hpp"

#include <catch2/catch.hpp>

using namespace arcstart::extraction;

namespace {

// Four pixels in two rows, each row followed by two bytes that are none of the image.
struct Padded {
  std::vector<std::uint8_t> bytes;
  Padded(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d)
      : bytes{a, b, 99, 99, c, d, 99, 99} {}
  GreyImage view() const { return {bytes.data(), 2, 2, 4}; }
};

}  // namespace

TEST_CASE("the laser's light is what the lit image has more, pixel by pixel, and not below 0") {
  std::vector<std::uint8_t> out;
  const Padded lit(200, 10, 7, 254), unlit(50, 30, 7, 0);
  const GreyImage light = laser_light(lit.view(), unlit.view(), out);
  REQUIRE(light.width == 2);
  REQUIRE(light.height == 2);
  CHECK(light.at(0, 0) == 150);
  CHECK(light.at(1, 0) == 0);
  CHECK(light.at(0, 1) == 0);
  CHECK(light.at(1, 1) == 254);
}

TEST_CASE("what the laser clips stays white, what the lamp clips by itself is dark") {
  std::vector<std::uint8_t> out;
  const Padded lit(255, 255, 255, 255), unlit(175, 255, 250, 0);
  const GreyImage light = laser_light(lit.view(), unlit.view(), out);
  CHECK(light.at(0, 0) == 255);
  CHECK(light.at(1, 0) == 0);
  CHECK(light.at(0, 1) == 5);  // noise of two images near white
  CHECK(light.at(1, 1) == 255);
}
