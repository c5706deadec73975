#include "services/robot_pose/j519/j519_session.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "tests/robot_pose/j519/j519_bytes.hpp"

using namespace arcstart;
using namespace arcstart::robot_pose;
using namespace arcstart::test;

namespace {

const auto kQuestion = from_hex("00000007 00000003 00000001 00000000 00000000 00000000 00000000");
const auto kStart3 = from_hex("000000c8 00000003"), kStart4 = from_hex("000000c8 00000004");
constexpr std::int64_t kStreamHost = 1'700'000'000'000'000;  // us, UTC, at session time 0

// A session with its clock, which notes what it sends.
struct StreamTalk {
  J519Session session;
  std::int64_t now = 0;
  std::uint32_t sequence = 0, version = 4;
  std::vector<std::vector<std::uint8_t>> sent;

  explicit StreamTalk(std::optional<Eigen::Isometry3d> T_flange_tool = {})
      : session(T_flange_tool) {}

  // The app's ticks for so long, every 20 ms.
  void pass(double seconds) {
    for (const std::int64_t end = now + static_cast<std::int64_t>(seconds * 1e6); now < end;
         now += 20'000)
      if (const auto bytes = session.step(now)) sent.push_back(*bytes);
  }
  std::optional<ReportedPosition> hear(const std::vector<std::uint8_t>& bytes) {
    return session.take(bytes, kStreamHost + now, now);
  }
  // The controller streams for so long; the last position.
  std::optional<ReportedPosition> stream(double seconds) {
    std::optional<ReportedPosition> last;
    for (const std::int64_t end = now + static_cast<std::int64_t>(seconds * 1e6); now < end;
         now += 8'000) {
      if (const auto bytes = session.step(now)) sent.push_back(*bytes);
      const auto stamp = static_cast<std::uint32_t>(now / 1000) + 5'000;
      last = hear(j519_status(version, ++sequence, stamp));
    }
    return last;
  }
  int count(const std::vector<std::uint8_t>& bytes) const {
    return static_cast<int>(std::count(sent.begin(), sent.end(), bytes));
  }
  bool silent_for(const std::string& why) const {
    return session.why_silent().find(why) != std::string::npos;
  }
};

Eigen::Isometry3d tool_at(double z_mm) {
  return Eigen::Isometry3d(Eigen::Translation3d(0, 0, z_mm));
}

}  // namespace

TEST_CASE("J519 session: asks, starts once with the version there is, and gives positions") {
  const std::uint32_t available = GENERATE(3u, 4u, 7u);
  StreamTalk talk;
  talk.version = available == 3 ? 3 : 4;
  talk.pass(0.1);
  REQUIRE(talk.sent.size() == 1);
  CHECK(talk.sent[0] == kQuestion);  // no stop comes first: it could be another's stream
  talk.hear(j519_capability(available, 1));
  talk.pass(0.3);
  REQUIRE(talk.sent.size() == 2);
  CHECK(talk.sent[1] == (available == 3 ? kStart3 : kStart4));
  const auto position = talk.stream(0.5);
  REQUIRE(position.has_value());
  CHECK(position->invalid == "");
  CHECK(position->source == RobotProtocol::kJ519);
  CHECK(position->position == Eigen::Vector3d(985, 0, 940));
  CHECK(position->rotation.angularDistance(Eigen::Quaterniond(0, 1, 0, 0)) < 1e-6);
  CHECK(position->tool_frame == -1);
  CHECK(position->user_frame == -1);
  REQUIRE(position->joints.size() == 9);
  CHECK(position->joints[1] == Approx(0.0349065850));  // 2 deg
  CHECK(position->device_tick_us == 1000);
  CHECK(talk.session.why_silent() == "");
  CHECK(talk.sent.size() == 2);
  CHECK(talk.session.stop() ==
        (available == 3 ? from_hex("00000002 00000003") : from_hex("00000002 00000004")));
  CHECK_FALSE(talk.session.stop().has_value());
}

TEST_CASE("J519 session: a lost packet leaves a hole in the numbers, a late one is dropped") {
  StreamTalk talk;
  talk.pass(0.1);
  talk.hear(j519_capability(4, 1));
  talk.pass(0.3);
  const std::int64_t before = talk.stream(0.4)->seq;
  talk.now += 24'000;
  talk.sequence += 3;
  const auto after = talk.stream(0.008);
  CHECK(after->seq == before + 4);
  CHECK(talk.session.counts().lost == 3);
  CHECK_FALSE(talk.hear(j519_status(4, talk.sequence - 1, 5'000)).has_value());
  talk.stream(0.008);
  CHECK(talk.session.counts().late == 1);
}

TEST_CASE("J519 session: a stream that runs already, of a predecessor, is taken over") {
  StreamTalk talk;
  talk.pass(0.04);
  CHECK_FALSE(talk.stream(0.05).has_value());  // whose position it is is not known yet
  CHECK(talk.session.counts().foreign > 0);
  talk.hear(j519_capability(4, 1));
  CHECK(talk.stream(1).has_value());
  CHECK(talk.count(kStart4) == 0);
  CHECK(talk.session.stop().has_value());
}

TEST_CASE("J519 session: a controller that does not answer is asked less and less often") {
  StreamTalk talk;
  talk.pass(30);
  CHECK(talk.silent_for("does not answer"));
  CHECK(talk.count(kQuestion) >= 8);
  CHECK(talk.count(kQuestion) <= 12);
  CHECK(talk.sent.size() == static_cast<std::size_t>(talk.count(kQuestion)));
  CHECK_FALSE(talk.session.stop().has_value());
}

TEST_CASE("J519 session: a stream that another client ended is not started again") {
  StreamTalk talk;
  talk.pass(0.1);
  talk.hear(j519_capability(4, 1));
  talk.pass(0.3);
  talk.stream(1);
  for (int i = 0; i < 20; ++i) {  // it answers every question
    talk.pass(1);
    talk.hear(j519_capability(4, 1));
  }
  CHECK(talk.count(kStart4) == 1);
  CHECK(talk.silent_for("the stream ended while the controller answers: another client"));
  CHECK_FALSE(talk.session.stop().has_value());  // nor is the other's stream stopped
}

TEST_CASE("J519 session: a start that gives no stream is said, and not repeated") {
  StreamTalk talk;
  for (int i = 0; i < 20; ++i) {
    talk.pass(1);
    talk.hear(j519_capability(4, 1));
  }
  CHECK(talk.count(kStart4) == 1);
  CHECK(talk.silent_for("streams nothing after the start: another client"));
}

TEST_CASE("J519 session: a controller that was switched off is started again") {
  StreamTalk talk;
  talk.pass(0.1);
  talk.hear(j519_capability(4, 1));
  talk.pass(0.3);
  const std::int64_t before = talk.stream(1)->seq;
  talk.pass(20);
  CHECK(talk.silent_for("does not answer"));
  talk.hear(j519_capability(4, 1));
  talk.pass(0.3);
  CHECK(talk.count(kStart4) == 2);
  talk.sequence = 0;
  const auto position = talk.stream(1);
  REQUIRE(position.has_value());
  CHECK(position->invalid == "");
  CHECK(position->seq > before);
}

TEST_CASE("J519 session: a stream that pauses goes on without a start") {
  StreamTalk talk;
  talk.pass(0.1);
  talk.hear(j519_capability(4, 1));
  talk.pass(0.3);
  talk.stream(1);
  talk.pass(1);
  talk.sequence += 125;
  CHECK(talk.stream(0.5).has_value());
  CHECK(talk.count(kStart4) == 1);
}

TEST_CASE("J519 session: flange or tool, by the capability, must be what is set") {
  SECTION("the flange comes and no tool is set") {
    StreamTalk talk;
    talk.pass(0.1);
    talk.hear(j519_capability(4, 0));
    talk.pass(1);
    CHECK(
        talk.silent_for("streams the flange (rob_status_use_tcp 0): set "
                        "robot_pose.tool_in_flange"));
    CHECK(talk.count(kStart4) == 0);
    CHECK_FALSE(talk.stream(0.5).has_value());
  }
  SECTION("the tool comes where the flange is asked for") {
    StreamTalk talk(tool_at(0));
    talk.pass(0.1);
    talk.hear(j519_capability(4, 1));
    talk.pass(1);
    CHECK(talk.silent_for("leave robot_pose.tool_in_flange away"));
    CHECK(talk.count(kStart4) == 0);
  }
  SECTION("the flange comes, and the tool's place in it is set") {
    // The tool points down, so 100 mm along its axis are 100 mm less in height.
    const double z = GENERATE(0., 100.);
    StreamTalk talk(tool_at(z));
    talk.pass(0.1);
    talk.hear(j519_capability(4, 0));
    talk.pass(0.3);
    const auto position = talk.stream(0.5);
    REQUIRE(position.has_value());
    CHECK((position->position - Eigen::Vector3d(985, 0, 940 - z)).norm() < 1e-4);
    CHECK(position->tool_frame == (z == 0 ? 0 : -1));
  }
}

TEST_CASE("J519 session: a controller too old is refused with its version") {
  StreamTalk talk;
  talk.pass(0.1);
  talk.hear(j519_capability(2, 1));
  talk.pass(1);
  CHECK(talk.silent_for("J519 version 2: version 3 or 4 is needed"));
  CHECK(talk.count(from_hex("000000c8 00000002")) == 0);
}

TEST_CASE("J519 session: whatever comes, no motion command and no stop but the last is sent") {
  std::mt19937 random(8);
  StreamTalk talk;
  for (int i = 0; i < 3000; ++i) {
    talk.pass(0.1);
    auto bytes = random() % 2 ? j519_capability(random() % 6, random() % 2)
                              : j519_status(3 + random() % 2, random(), random());
    if (random() % 3 == 0) bytes[random() % 28] = static_cast<std::uint8_t>(random());
    talk.hear(bytes);
  }
  for (const auto& bytes : talk.sent)
    CHECK((bytes == kQuestion || bytes == kStart3 || bytes == kStart4));
}
