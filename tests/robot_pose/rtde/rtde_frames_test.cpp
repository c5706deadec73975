#include "services/robot_pose/rtde/rtde_frames.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "tests/robot_pose/rtde/rtde_bytes.hpp"

using namespace arcstart;
using namespace arcstart::robot_pose;
using namespace arcstart::test;

TEST_CASE("RTDE: what is sent, byte by byte") {
  CHECK(rtde_version_request() == from_hex("00 05 56 00 02"));
  CHECK(rtde_request(rtde_type::kStart) == from_hex("00 03 53"));
  CHECK(rtde_request(rtde_type::kPause) == from_hex("00 03 50"));
  const auto outputs = rtde_outputs_request(125, "timestamp,actual_TCP_pose,actual_q");
  CHECK(outputs.size() == 45);
  auto expected = from_hex("00 2d 4f 40 5f 40 00 00 00 00 00");
  for (const char c : std::string("timestamp,actual_TCP_pose,actual_q"))
    expected.push_back(static_cast<std::uint8_t>(c));
  CHECK(outputs == expected);
}

TEST_CASE("RTDE: a data package, written out") {
  const auto bytes = from_hex(
      "00 6c 55 01"
      "40 9f 40 20 c4 9b a5 e3"                           // 2000.032
      "3f f0 00 00 00 00 00 00  bf e0 00 00 00 00 00 00"  // 1, -0.5
      "3f d0 00 00 00 00 00 00  00 00 00 00 00 00 00 00"  // 0.25, 0
      "40 00 00 00 00 00 00 00  80 00 00 00 00 00 00 00"  // 2, -0
      "3f f0 00 00 00 00 00 00  40 00 00 00 00 00 00 00"
      "40 08 00 00 00 00 00 00  40 10 00 00 00 00 00 00"
      "40 14 00 00 00 00 00 00  c0 18 00 00 00 00 00 00");
  REQUIRE(bytes.size() == 108);
  RtdeFrameReader reader;
  reader.add(bytes);
  const auto frame = reader.next();
  REQUIRE(frame.has_value());
  CHECK(frame->type == 'U');
  CHECK_FALSE(reader.next().has_value());
  const auto decoded = decode_rtde_data(frame->payload, false);
  REQUIRE(decoded.data.has_value());
  CHECK(decoded.data->recipe == 1);
  CHECK(decoded.data->timestamp == 2000.032);
  CHECK(decoded.data->pose == std::array<double, 6>{1, -0.5, 0.25, 0, 2, 0});
  CHECK(decoded.data->joints == std::array<double, 6>{1, 2, 3, 4, 5, -6});
  CHECK_FALSE(decoded.data->tool_offset.has_value());
}

TEST_CASE("RTDE: the tool's offset comes last, in a package of 156 bytes") {
  const auto bytes = rtde_data(7);
  CHECK(bytes.size() == 156);
  const std::vector<std::uint8_t> payload(bytes.begin() + 3, bytes.end());
  const auto decoded = decode_rtde_data(payload, true);
  REQUIRE(decoded.data.has_value());
  CHECK(decoded.data->tool_offset == kOffsetMetres);
  CHECK(decode_rtde_data(payload, false).error ==
        "RTDE data package has 156 bytes and must have 108");
}

TEST_CASE("RTDE: frames are cut from a stream, whatever the pieces it comes in") {
  std::vector<std::uint8_t> stream;
  for (const auto& frame : {rtde_frame('V', {1}), rtde_text("hello"), rtde_data(1)})
    stream.insert(stream.end(), frame.begin(), frame.end());
  for (const std::size_t piece : {1u, 2u, 5u, 1000u}) {
    RtdeFrameReader reader;
    std::string types;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      reader.add({stream.data() + at, std::min(piece, stream.size() - at)});
      while (const auto frame = reader.next()) types += static_cast<char>(frame->type);
    }
    CHECK(types == "VMU");
    CHECK(reader.waiting() == 0);
  }
}

TEST_CASE("RTDE: what is no RTDE is recognised by its first bytes") {
  const std::vector<std::pair<const char*, std::string>> foreign = {
      {"00 00 05 6c 10", "00 00 05"},    // the primary interface, port 30001: u32 size, type 16
      {"00 02 56", "00 02 56"},          // a size below the header's
      {"48 54 54 50 2f 31", "48 54 54"}  // HTTP
  };
  for (const auto& [hex, begin] : foreign) {
    RtdeFrameReader reader;
    reader.add(from_hex(hex));
    CHECK_FALSE(reader.next().has_value());
    CHECK(reader.error() == "what answers is no RTDE, it begins with " + begin);
  }
}

TEST_CASE("RTDE: recipes and texts") {
  const auto recipe = decode_rtde_recipe(from_hex("02 44 4f 55 42 4c 45 2c 4e"));
  REQUIRE(recipe.has_value());
  CHECK(recipe->id == 2);
  CHECK(recipe->types == std::vector<std::string>{"DOUBLE", "N"});
  CHECK_FALSE(decode_rtde_recipe({}).has_value());
  CHECK(decode_rtde_text(from_hex("03 61 0a 62 01 63 02")) == "a b");
  CHECK(decode_rtde_text(from_hex("ff 61 62")) == "ab");  // says more than comes
  CHECK(decode_rtde_text({}) == "");
}

TEST_CASE("RTDE: values that are none are refused") {
  const double bad = GENERATE(std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(), 101.0, -1e300);
  auto pose = kPoseMetres;
  pose[1] = bad;
  const auto position = rtde_data(1, pose);
  CHECK(decode_rtde_data({position.data() + 3, position.size() - 3}, true).error ==
        "RTDE data package holds a position that is none");
  const auto offset = rtde_data(1, kPoseMetres, &pose);
  CHECK_FALSE(decode_rtde_data({offset.data() + 3, offset.size() - 3}, true).data.has_value());
  const auto time = rtde_data(bad == 101.0 ? -1.0 : bad);
  CHECK(decode_rtde_data({time.data() + 3, time.size() - 3}, true).error ==
        "RTDE data package holds a time that is none");
}
