#include "services/robot_pose/rtde/rtde_session.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "tests/robot_pose/rtde/rtde_bytes.hpp"

using namespace arcstart;
using namespace arcstart::robot_pose;
using namespace arcstart::test;

namespace {

constexpr std::int64_t kRtdeHost = 1'700'000'000'000'000;  // us, UTC, at the controller's 0 s

std::vector<std::uint8_t> outputs_request(const std::string& names) {
  Bytes bytes;
  bytes.u16(static_cast<std::uint32_t>(11 + names.size()));
  bytes.data.push_back('O');
  bytes.f64(125);
  bytes.data.insert(bytes.data.end(), names.begin(), names.end());
  return bytes.data;
}
const std::string kThreeNames = "timestamp,actual_TCP_pose,actual_q";
const auto kFourRequest = outputs_request(kThreeNames + ",tcp_offset");

// A session with the controller's clock.
struct RtdeTalk {
  RtdeSession session;
  double clock_s = 1000;

  explicit RtdeTalk(std::optional<Eigen::Isometry3d> T_flange_tool = {})
      : session(125, std::move(T_flange_tool)) {}

  RtdeSession::Step hear(const std::vector<std::uint8_t>& bytes) {
    return session.take(bytes, kRtdeHost + std::llround(clock_s * 1e6) + 300);
  }
  void connect() {
    REQUIRE(session.begin() == from_hex("00 05 56 00 02"));
    REQUIRE(hear(rtde_frame('V', {1})).request == kFourRequest);
    REQUIRE(hear(rtde_types(1, kAllVectors)).request == from_hex("00 03 53"));
    REQUIRE(hear(rtde_frame('S', {1})).fault == "");
    REQUIRE(session.streaming());
  }
  // So many packages, every 8 ms; the last one's position.
  ReportedPosition stream(int packages, const std::array<double, 6>& offset = kOffsetMetres) {
    ReportedPosition last;
    for (int i = 0; i < packages; ++i) {
      clock_s += 0.008;
      const auto step = hear(rtde_data(clock_s, kPoseMetres, &offset));
      REQUIRE(step.fault == "");
      REQUIRE(step.positions.size() == 1);
      last = step.positions[0];
    }
    return last;
  }
};

}  // namespace

TEST_CASE("RTDE session: version, recipe, start, positions") {
  RtdeTalk talk;
  talk.connect();
  const ReportedPosition early = talk.stream(10);
  CHECK(early.invalid.find("not been compared") != std::string::npos);
  const ReportedPosition position = talk.stream(30);
  CHECK(position.invalid == "");
  CHECK(position.source == RobotProtocol::kRtde);
  CHECK((position.position - Eigen::Vector3d(985, 0, 940)).norm() < 1e-9);
  // Two radians about y.
  const Eigen::Quaterniond turned(std::cos(1.0), 0, std::sin(1.0), 0);
  CHECK(position.rotation.angularDistance(turned) < 1e-9);
  CHECK(position.joints == std::vector<double>{1, 2, 3, 4, 5, 6});
  CHECK(position.user_frame == 0);
  CHECK(position.tool_frame == -1);
  CHECK(position.device_tick_us == 1);
  CHECK(position.device_clock == std::llround(talk.clock_s * 1e6));
  CHECK(position.seq == early.seq + 30);
  CHECK(talk.session.counts().received == 40);
  CHECK(talk.session.counts().lost == 0);
}

TEST_CASE("RTDE session: the hand is the flange's where so set, whatever tool the controller has") {
  // 300 mm of tool along z of a hand turned by 2 rad about y.
  const Eigen::Vector3d flange =
      Eigen::Vector3d(985, 0, 940) - 300 * Eigen::Vector3d(std::sin(2.0), 0, std::cos(2.0));
  RtdeTalk talk(Eigen::Isometry3d::Identity());
  talk.connect();
  ReportedPosition position = talk.stream(40);
  CHECK((position.position - flange).norm() < 1e-9);
  CHECK(position.tool_frame == 0);
  position = talk.stream(1, {0, 0, 0, 0, 0, 0});  // another tool is chosen at the controller
  CHECK((position.position - Eigen::Vector3d(985, 0, 940)).norm() < 1e-9);
  CHECK(position.invalid == "");
}

TEST_CASE("RTDE session: a tool centre point that is changed makes positions invalid") {
  RtdeTalk talk;
  talk.connect();
  CHECK(talk.stream(40).invalid == "");
  for (const std::size_t part : {0u, 5u}) {
    auto other = kOffsetMetres;
    other[part] += 1e-4;
    CHECK(talk.stream(1, other).invalid.find("the tool centre point was changed") == 0);
    CHECK(talk.stream(1).invalid == "");
  }
  talk.connect();  // a new connection does not forget it
  CHECK(talk.stream(40, {0, 0, 0, 0, 0, 0}).invalid.find("the tool centre point was") == 0);
}

TEST_CASE("RTDE session: an old controller that does not tell the tool's offset") {
  SECTION("is asked without it") {
    RtdeTalk talk;
    talk.session.begin();
    talk.hear(rtde_frame('V', {1}));
    const auto step = talk.hear(rtde_types(0, "DOUBLE,VECTOR6D,VECTOR6D,NOT_FOUND"));
    CHECK(step.fault == "");
    CHECK(step.request == outputs_request(kThreeNames));
    CHECK(talk.hear(rtde_types(1, "DOUBLE,VECTOR6D,VECTOR6D")).request == from_hex("00 03 53"));
    talk.hear(rtde_frame('S', {1}));
    const auto data = talk.hear(rtde_data(5, kPoseMetres, nullptr));
    REQUIRE(data.positions.size() == 1);
    CHECK((data.positions[0].position - Eigen::Vector3d(985, 0, 940)).norm() < 1e-9);
  }
  SECTION("is refused where the flange is needed") {
    RtdeTalk talk(Eigen::Isometry3d::Identity());
    talk.session.begin();
    talk.hear(rtde_frame('V', {1}));
    CHECK(talk.hear(rtde_types(0, "DOUBLE,VECTOR6D,VECTOR6D,NOT_FOUND")).fault ==
          "the controller does not know the output variable tcp_offset: its software is too old");
  }
}

TEST_CASE("RTDE session: each refusal in a line of its own") {
  struct Case {
    std::vector<std::vector<std::uint8_t>> answers;
    std::string fault;
  };
  const auto yes = rtde_frame('V', {1});
  const std::vector<Case> cases = {
      {{rtde_frame('V', {0})}, "refuses RTDE protocol version 2"},
      {{yes, rtde_types(0, "DOUBLE,NOT_FOUND,VECTOR6D,VECTOR6D")},
       "does not know the output variable actual_TCP_pose"},
      {{yes, rtde_types(0, "DOUBLE,VECTOR6D,IN_USE,VECTOR6D")},
       "actual_q is in use by another client"},
      {{yes, rtde_types(1, "DOUBLE,VECTOR6D,VECTOR6D,DOUBLE")},
       "tcp_offset has type DOUBLE and not VECTOR6D"},
      {{yes, rtde_types(1, "DOUBLE")}, "answers 4 output variables with 1 types"},
      {{yes, rtde_frame('O', {})}, "answers 4 output variables with 0 types"},
      {{yes, rtde_types(0, kAllVectors)}, "robot_pose.rate_hz"},
      {{yes, rtde_types(1, kAllVectors), rtde_frame('S', {0})}, "refuses to start"},
      {{yes, rtde_frame('S', {1})}, "owed an answer to the output recipe"},
      {{rtde_data(1)}, "owed an answer to the request for version 2"},
      {{rtde_frame('V', {1, 1})}, "a frame of type V with 5 bytes"},
      {{from_hex("00 00 05 6c 10")}, "is no RTDE, it begins with 00 00 05: is the port RTDE's"},
      {{rtde_text("busy"), rtde_frame('V', {0})}, "the controller says: busy"},
  };
  for (const Case& c : cases) {
    RtdeTalk talk;
    talk.session.begin();
    std::string fault;
    for (const auto& answer : c.answers) {
      REQUIRE(fault == "");
      fault = talk.hear(answer).fault;
    }
    INFO(c.fault);
    CHECK(fault.find(c.fault) != std::string::npos);
    CHECK(fault.find('\n') == std::string::npos);
    CHECK_FALSE(talk.session.streaming());
  }
}

TEST_CASE("RTDE session: packages the controller leaves out are counted by its clock") {
  RtdeTalk talk;
  talk.connect();
  const std::int64_t before = talk.stream(40).seq;
  talk.clock_s += 3 * 0.008 + 0.0009;  // and its stamps need not be exact
  CHECK(talk.stream(1).seq == before + 4);
  CHECK(talk.session.counts().lost == 3);
}

TEST_CASE("RTDE session: over a new connection numbers and clock go on, or begin with a restart") {
  RtdeTalk talk;
  talk.connect();
  const ReportedPosition before = talk.stream(40);
  const bool restarted = GENERATE(false, true);
  talk.clock_s += 2;
  if (!restarted) {
    talk.connect();
    const ReportedPosition after = talk.stream(1);
    CHECK(after.seq == before.seq + 251);
    CHECK(after.invalid == "");
    CHECK_FALSE(after.clock_begins);
  } else {
    // The controller's clock begins again at 10 s, the host's goes on.
    const double began = talk.clock_s - 10;
    talk.connect();
    bool begins = false;
    ReportedPosition last;
    for (int i = 0; i < 60; ++i) {
      talk.clock_s += 0.008;
      for (const auto& position : talk.hear(rtde_data(talk.clock_s - began)).positions) {
        if (position.invalid.empty()) begins = begins || position.clock_begins;
        CHECK(position.seq > before.seq);
        last = position;
      }
    }
    CHECK(begins);
    CHECK(last.invalid == "");
    CHECK(last.device_clock == std::llround((talk.clock_s - began) * 1e6));
  }
}

TEST_CASE("RTDE session: data that are none are counted, and the stream goes on") {
  RtdeTalk talk;
  talk.connect();
  talk.stream(40);
  auto nan = kPoseMetres;
  nan[0] = std::nan("");
  CHECK(talk.hear(rtde_data(talk.clock_s + 0.008, nan)).positions.empty());
  CHECK(talk.hear(rtde_data(talk.clock_s + 0.008, kPoseMetres, nullptr)).positions.empty());
  CHECK(talk.session.counts().malformed == 2);
  CHECK(talk.session.last_error().find("has 108 bytes and must have 156") != std::string::npos);
  CHECK(
      talk.hear(rtde_data(talk.clock_s + 0.008, kPoseMetres, &kOffsetMetres, 2)).positions.empty());
  CHECK(talk.session.counts().foreign == 1);
  CHECK(talk.stream(1).invalid == "");
}

TEST_CASE("RTDE session: hostile bytes end in a fault or are survived") {
  std::mt19937 random(9);
  for (int i = 0; i < 2000; ++i) {
    RtdeTalk talk;
    talk.session.begin();
    std::vector<std::uint8_t> all;
    for (const auto& part : {rtde_frame('V', {1}), rtde_types(1, kAllVectors), rtde_frame('S', {1}),
                             rtde_data(1), rtde_text("x"), rtde_data(1.008)})
      all.insert(all.end(), part.begin(), part.end());
    for (std::uint32_t flips = random() % 4; flips > 0; --flips)
      all[random() % all.size()] = static_cast<std::uint8_t>(random());
    all.resize(all.size() - random() % 20);
    for (std::size_t at = 0; at < all.size(); at += 64) {
      const auto step =
          talk.hear({all.begin() + static_cast<std::ptrdiff_t>(at),
                     all.begin() + static_cast<std::ptrdiff_t>(std::min(at + 64, all.size()))});
      for (const auto& position : step.positions) REQUIRE(position.position.norm() < 2e5);
      REQUIRE(step.fault.find('\n') == std::string::npos);
      if (!step.fault.empty()) break;
    }
  }
}
