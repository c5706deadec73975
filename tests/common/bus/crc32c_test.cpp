#include "common/bus/crc32c.hpp"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>
#include <string>
#include <vector>

using namespace arcstart;

// RFC 3720, appendix B.4, and the check value of the CRC catalogue.
TEST_CASE("CRC-32C of the vectors of RFC 3720") {
  const auto both = [](const std::vector<std::uint8_t>& bytes, std::uint32_t expected) {
    CHECK(crc32c(bytes) == expected);
    CHECK(crc32c_by_tables(bytes) == expected);
  };
  both({}, 0);
  both(std::vector<std::uint8_t>(32, 0x00), 0x8A9136AA);
  both(std::vector<std::uint8_t>(32, 0xFF), 0x62A8AB43);
  std::vector<std::uint8_t> rising(32);
  std::iota(rising.begin(), rising.end(), std::uint8_t{0});
  both(rising, 0x46DD794E);
  both({rising.rbegin(), rising.rend()}, 0x113FDB5C);
  both({0x01, 0xC0, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
        0x00, 0x00, 0x00, 0x00, 0x14, 0x00, 0x00, 0x00, 0x00, 0x00, 0x04, 0x00,
        0x00, 0x00, 0x00, 0x14, 0x00, 0x00, 0x00, 0x18, 0x28, 0x00, 0x00, 0x00,
        0x00, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00},
       0xD9963A56);
  const std::string check = "123456789";
  both({check.begin(), check.end()}, 0xE3069283);
}

TEST_CASE("CRC-32C by the instruction is that by tables, whatever the length and the place") {
  std::mt19937 random(3);
  std::vector<std::uint8_t> bytes(300);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  for (std::size_t from = 0; from < 9; ++from)
    for (std::size_t size = 0; from + size <= bytes.size(); ++size) {
      const auto part = std::span(bytes).subspan(from, size);
      REQUIRE(crc32c(part) == crc32c_by_tables(part));
    }
}
