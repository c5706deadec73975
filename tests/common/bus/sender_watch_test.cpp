#include "common/bus/sender_watch.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "common/bus/bus.hpp"

using namespace arcstart;

namespace {

const std::vector<std::uint8_t> kOne = {1, 2, 3}, kOther = {1, 2, 4};

robot_pose_t position(std::int64_t run_id, std::int64_t seq, double x) {
  robot_pose_t pose{};
  pose.utime = 1'000'000 + seq;
  pose.run_id = run_id;
  pose.seq = seq;
  pose.position[0] = x;
  pose.quaternion[0] = 1;
  return pose;
}

}  // namespace

TEST_CASE("senders: one alone, its losses and its restart are no dispute") {
  SenderWatch senders;
  for (const std::int64_t run : {100, 200, 300})
    for (const std::int64_t seq : {0, 1, 2, 7, 5, 900})
      CHECK_FALSE(senders.is_repeated(run, seq, kOne));
  CHECK(senders.dispute().empty());
}

TEST_CASE(
    "senders: the same bytes twice are a repetition, others under the same number two senders") {
  SenderWatch senders;
  CHECK_FALSE(senders.is_repeated(100, 4, kOne));
  CHECK_FALSE(senders.is_repeated(100, 5, kOne));
  CHECK(senders.is_repeated(100, 4, kOne));
  CHECK(senders.dispute().empty());
  CHECK_FALSE(senders.is_repeated(100, 4, kOther));
  CHECK_THAT(senders.dispute(), Catch::Contains("run 100 with seq 4 differ"));
}

TEST_CASE("senders: one that goes on after another has begun; forgotten when it is gone") {
  SenderWatch senders(10);
  std::int64_t seq = 0;
  senders.is_repeated(100, ++seq, kOne);
  senders.is_repeated(200, ++seq, kOne);
  CHECK(senders.dispute().empty());  // as after a restart
  senders.is_repeated(100, ++seq, kOne);
  CHECK_THAT(senders.dispute(), Catch::Contains("runs 100 and 200 speak by turns"));
  for (int i = 0; i < 9; ++i) senders.is_repeated(100, ++seq, kOne);
  CHECK_FALSE(senders.dispute().empty());
  senders.is_repeated(100, ++seq, kOne);
  CHECK(senders.dispute().empty());
}

TEST_CASE("the bus leaves out what comes twice, and names a channel with two senders") {
  const auto bus = Bus::in_memory();
  int here = 0, there = 0;
  bus->subscribe<robot_pose_t>("ROBOT0_POSE", Queue::measurements(),
                               [&](const robot_pose_t&) { ++here; });
  bus->subscribe<robot_pose_t>("ROBOT0_POSE", Queue::measurements(),
                               [&](const robot_pose_t&) { ++there; });
  const auto send = [&](const robot_pose_t& pose) {
    bus->publish("ROBOT0_POSE", pose);
    while (bus->handle(std::chrono::milliseconds(0))) {
    }
  };
  send(position(100, 1, 7));
  send(position(100, 1, 7));
  send(position(100, 2, 7));
  CHECK(here == 2);
  CHECK(there == 2);  // each subscription hears it once
  CHECK(bus->dispute().empty());
  send(position(100, 2, 8));
  CHECK(here == 3);
  CHECK_THAT(bus->dispute(), Catch::Contains("ROBOT0_POSE: two senders"));
  CHECK_FALSE(bus->dispute("ROBOT0_POSE").empty());
  CHECK(bus->dispute("ROBOT1_POSE").empty());
}
