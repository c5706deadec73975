#include "services/robot_link/rmi/rmi_text.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace arcstart;
using namespace arcstart::robot_link;

// Bytes of FANUC's own client (fanuc_driver), but for the whole number.
TEST_CASE("RMI: requests are FANUC's own, to the byte") {
  RmiConfiguration configuration;
  configuration.tool = 1;
  const XyzWpr place = {
      912.9650268554688, -1.2760000228881836, 13.192000389099121, 180.0, 0.5, -3.25};
  CHECK(
      rmi_write_position(5, configuration, place) ==
      R"({"Command":"FRC_WritePositionRegister","RegisterNumber":5,"Representation":"Cartesian","Configuration":{"UToolNumber":1,"UFrameNumber":0,"Front":1,"Up":1,"Left":0,"Flip":0,"Turn4":0,"Turn5":0,"Turn6":0},"Position":{"X":912.9650268554688,"Y":-1.2760000228881836,"Z":13.192000389099121,"W":180.0,"P":0.5,"R":-3.25,"Ext1":0.0,"Ext2":0.0,"Ext3":0.0}})");
  CHECK(rmi_read_position(5) == R"({"Command":"FRC_ReadPositionRegister","RegisterNumber":5})");
  CHECK(
      rmi_write_number(3, -7) ==
      R"({"Command":"FRC_WriteRegister","RegisterNumber":3,"RegisterValue":-7,"DataType":"integer"})");
  CHECK(rmi_read_number(3) == R"({"Command":"FRC_ReadRegister","RegisterNumber":3})");
  CHECK(rmi_connect() == R"({"Communication":"FRC_Connect"})");
  CHECK(rmi_disconnect() == R"({"Communication":"FRC_Disconnect"})");
  CHECK(rmi_read_user_frame(2) == R"({"Command":"FRC_ReadUFrameData","FrameNumber":2})");
}

TEST_CASE("RMI: replies with and without Representation, with spaces") {
  const auto with = decode_rmi(
      R"({"Command" : "FRC_ReadPositionRegister", "ErrorID" : 0, "RegisterNumber" : 5, "Representation" : "Cartesian", "Configuration" : {"UToolNumber" : 1, "UFrameNumber" : 2, "Front" : 1, "Up" : 1, "Left" : 0, "Flip" : 1, "Turn4" : 0, "Turn5" : -1, "Turn6" : 0}, "Position" : {"X" : 1.5, "Y" : -2, "Z" : 3, "W" : 180, "P" : 0.5, "R" : -3.25, "Ext1" : 0}})");
  REQUIRE(with.reply);
  CHECK(with.reply->number == 5);
  REQUIRE(with.reply->configuration);
  CHECK(with.reply->configuration->user_frame == 2);
  CHECK(with.reply->configuration->flip == 1);
  CHECK(with.reply->configuration->turn5 == -1);
  CHECK(with.reply->frame == XyzWpr{1.5, -2, 3, 180, 0.5, -3.25});
  const auto connect = decode_rmi(
      R"({"Communication":"FRC_Connect","ErrorID":0,"PortNumber":16002,"MajorVersion":9,"MinorVersion":0})");
  REQUIRE(connect.reply);
  CHECK(connect.reply->port == 16002);
  const auto refused = decode_rmi(R"({"Command":"Unknown","ErrorID":2556941})");
  REQUIRE(refused.reply);
  CHECK_THAT(rmi_error(refused.reply->error), Catch::Contains("no numeric registers"));
}

TEST_CASE("RMI: what is no reply is told in one line") {
  for (const char* line :
       {"", "{", "[]", "null", "\x01\x02", "{\"ErrorID\":0}", "{\"Command\":5}",
        "{\"Command\":\"X\",\"ErrorID\":\"0\"}", "{\"Command\":\"X\",\"ErrorID\":1.5}"}) {
    const auto decoded = decode_rmi(line);
    CHECK_FALSE(decoded.reply);
    CHECK_FALSE(decoded.error.empty());
    CHECK(decoded.error.find('\n') == std::string::npos);
  }
  const auto huge = decode_rmi(
      R"({"Command":"X","ErrorID":0,"RegisterNumber":99999999999999999999,"RegisterValue":1e999,"PortNumber":-1,"Position":{"X":1e300}})");
  if (huge.reply) {  // a number that no double holds may make it no JSON
    CHECK_FALSE(huge.reply->value);
    CHECK_FALSE(huge.reply->frame);
    CHECK_FALSE(huge.reply->number);
  }
}

TEST_CASE("RMI: mutated replies are decoded or refused, what is decoded is finite") {
  const std::string good =
      R"({"Command":"FRC_ReadPositionRegister","ErrorID":0,"RegisterNumber":5,"Configuration":{"UToolNumber":1,"UFrameNumber":2,"Front":1,"Up":1,"Left":0,"Flip":1,"Turn4":0,"Turn5":0,"Turn6":0},"Position":{"X":1.5,"Y":-2,"Z":3,"W":180,"P":0.5,"R":-3.25}})";
  std::mt19937 random(1);
  int decoded_count = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string line = good;
    for (unsigned change = 0; change <= random() % 3; ++change) {
      const std::size_t at = random() % line.size();
      switch (random() % 3) {
        case 0:
          line[at] = static_cast<char>(random());
          break;
        case 1:
          line.erase(at, random() % 20);
          break;
        default:
          line.insert(at, line.substr(random() % line.size(), random() % 20));
          break;
      }
      if (line.empty()) line = "{";
    }
    const auto decoded = decode_rmi(line);
    REQUIRE(decoded.reply.has_value() == decoded.error.empty());
    if (!decoded.reply) continue;
    ++decoded_count;
    if (decoded.reply->frame)
      for (const double number : *decoded.reply->frame) REQUIRE(std::abs(number) <= 1e5);
  }
  CHECK(decoded_count > 1000);
}

TEST_CASE("RMI: angles as FANUC writes them, by the M-20iA's test vectors") {
  // tool X, Y, Z axes of W 180 P 0 R 0 and of W 170.548 P 8.939 R 76.792 (devices.md, J1..J6 of the
  // model): the second by its own matrix product written out.
  const double w = 170.548 * kDegree, p = 8.939 * kDegree, r = 76.792 * kDegree;
  const Eigen::Vector3d x(std::cos(r) * std::cos(p), std::sin(r) * std::cos(p), -std::sin(p));
  const Eigen::Vector3d z(std::cos(r) * std::sin(p) * std::cos(w) + std::sin(r) * std::sin(w),
                          std::sin(r) * std::sin(p) * std::cos(w) - std::cos(r) * std::sin(w),
                          std::cos(p) * std::cos(w));
  const RigidTransform T = from_xyzwpr({1110.888, 615.490, 443.919, 170.548, 8.939, 76.792});
  CHECK((T.linear().col(0) - x).norm() < 1e-9);
  CHECK((T.linear().col(2) - z).norm() < 1e-9);
  CHECK(T.translation().isApprox(Eigen::Vector3d(1110.888, 615.490, 443.919)));
  const XyzWpr back = to_xyzwpr(T);
  CHECK(back[3] == Approx(170.548));
  CHECK(back[4] == Approx(8.939));
  CHECK(back[5] == Approx(76.792));
  const XyzWpr singular = to_xyzwpr(from_xyzwpr({0, 0, 0, 20, 90, 50}));
  CHECK(from_xyzwpr(singular).isApprox(from_xyzwpr({0, 0, 0, 20, 90, 50}), 1e-9));
}
