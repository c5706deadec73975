// The client against the simulated controller, whose bytes are its own.
#include "services/robot_link/rmi/rmi_link.hpp"

#include <arpa/inet.h>

#include <catch2/catch.hpp>

#include "common/time.hpp"
#include "services/cell_simulator/controller/rmi_server.hpp"
#include "services/robot_link/handshake/handshake.hpp"

using namespace arcstart;
using namespace arcstart::robot_link;
using cell_simulator::ControllerMemory;
using cell_simulator::RmiServer;
using cell_simulator::RmiServerSettings;

namespace {

const XyzWpr kFrame = {800, -20, 5, 0.5, -1, 30}, kTool = {31.5, -4.2, 297.8, 1.3, 28.4, -2.1};

struct Controller {
  ControllerMemory memory;
  std::optional<RmiServer> server;

  explicit Controller(RmiServerSettings settings = {}) {
    settings.port = 0;
    settings.request_ms = 0;  // time is counted by requests
    memory.frames[3] = {800, -20, 5, 0.5, -1, 30};
    memory.tools[2] = {31.5, -4.2, 297.8, 1.3, 28.4, -2.1};
    server.emplace(settings, memory, [] { return RigidTransform::Identity(); });
  }
  RmiLinkSettings link() const {
    RmiLinkSettings settings;
    settings.address = "127.0.0.1";
    settings.port = server->port();
    settings.first_number = 50;
    settings.first_position = 20;
    settings.user_frame = 3;
    settings.tool = 2;
    settings.frame_in_base = kFrame;
    settings.tool_in_flange = kTool;
    return settings;
  }
};

}  // namespace

TEST_CASE("RMI: registers by number, positions in the job's frame and tool") {
  Controller controller;
  RmiLink link(controller.link());
  link.connect();
  controller.memory.numbers[50] = 17;  // kRequest
  CHECK(link.carry_out(Operation::read(Slot::kRequest)).number == 17);
  link.carry_out(Operation::write(Slot::kAnswer, 17));
  CHECK(controller.memory.numbers[59] == 17);

  const RigidTransform position = from_xyzwpr({12.3456, -7.5, 3.25, 170, 5, -80});
  link.carry_out(Operation::write(Place::kApproach, position));
  link.carry_out(Operation::write(Place::kEnd, position));
  const auto& held = controller.memory.positions[22];
  CHECK(held.position.x == Approx(12.3456));
  CHECK(held.position.w == Approx(170));
  CHECK(held.position.r == Approx(-80));
  CHECK(held.user_frame == 3);
  CHECK(held.tool == 2);
  CHECK(held.configuration.flip == 1);  // as the arm stands
  const RigidTransform back = link.carry_out(Operation::read(Place::kEnd)).position;
  CHECK((back.translation() - position.translation()).norm() < 0.001);
  CHECK(controller.server->motion_asked() == 0);
}

TEST_CASE("RMI: another frame or tool than the settings' is told, and nothing is written") {
  Controller controller;
  SECTION("frame") {
    controller.memory.frames[3].x += 0.1;
    RmiLink link(controller.link());
    CHECK_THROWS_WITH(link.connect(),
                      Catch::Contains("UFRAME[3]") && Catch::Contains("robot_link.frame_in_base"));
  }
  SECTION("tool") {
    controller.memory.tools[2].p += 0.1;
    RmiLink link(controller.link());
    CHECK_THROWS_WITH(link.connect(), Catch::Contains("UTOOL[2]"));
  }
}

TEST_CASE("RMI: what can be wrong is told in one line") {
  RmiServerSettings settings;
  SECTION("nobody there") {
    RmiLinkSettings nobody;
    nobody.address = "127.0.0.1";
    nobody.port = 1;
    RmiLink link(nobody);
    CHECK_THROWS_WITH(link.connect(), Catch::Contains("refuses the connection"));
  }
  SECTION("no numeric registers") {
    settings.numeric_registers = false;
    Controller controller(settings);
    RmiLink link(controller.link());
    link.connect();
    CHECK_THROWS_WITH(link.carry_out(Operation::read(Slot::kAnswer)),
                      Catch::Contains("no numeric registers"));
  }
  SECTION("a register out of range") {
    Controller controller;
    RmiLinkSettings outside = controller.link();
    outside.first_number = 195;
    RmiLink link(outside);
    link.connect();
    CHECK_THROWS_WITH(link.carry_out(Operation::read(Slot::kAnswer)),
                      Catch::Contains("robot_link.first_number"));
  }
  SECTION("no whole number") {
    Controller controller;
    controller.memory.numbers[50] = 1.5;
    RmiLink link(controller.link());
    link.connect();
    CHECK_THROWS_WITH(link.carry_out(Operation::read(Slot::kRequest)),
                      Catch::Contains("R[50]") && Catch::Contains("whole number"));
  }
  SECTION("half an answer, then none") {
    settings.half_from = 3;
    Controller controller(settings);
    RmiLink link(controller.link());
    link.connect();
    CHECK_THROWS_WITH(link.carry_out(Operation::read(Slot::kRequest)),
                      Catch::Contains("only half a line"));
  }
  SECTION("the session is held by another") {
    Controller controller;
    RmiLink first(controller.link());
    first.connect();
    RmiLink second(controller.link());
    CHECK_THROWS_WITH(second.connect(), Catch::Contains("another client hold the session"));
    CHECK(first.carry_out(Operation::read(Slot::kRequest)).number == 0);
  }
}

TEST_CASE("RMI: from the answer's coming to read back at 66 ms a request takes less than 1 s") {
  Controller controller;
  RmiLink link(controller.link());
  link.connect();
  Handshake handshake;
  std::int64_t now = 1'000'000;
  double beat = 0;
  int requests = 0;
  const auto run = [&](auto until) {
    for (int i = 0; i < 60 && !until(); ++i) {
      const Operation operation = handshake.next(now);
      const int before = controller.server->requests();
      {
        const std::lock_guard lock(controller.memory.mutex);
        controller.memory.numbers[55] = ++beat;
      }
      const Reading reading = link.carry_out(operation);
      requests += controller.server->requests() - before;
      now += 66'000 * (controller.server->requests() - before);
      handshake.take(operation, reading, now);
    }
  };
  controller.memory.numbers[51] = 2;
  controller.memory.numbers[52] = 77;
  run([&] { return handshake.report().robot_alive; });
  controller.memory.numbers[50] = 5;
  run([&] { return handshake.scan_wanted().has_value(); });
  REQUIRE(handshake.scan_wanted() == Question{5, 2, 77});
  const std::int64_t came = now;
  requests = 0;
  handshake.answer({{5, 2, 77}, kValid, {}, now + 60'000'000});
  run([&] { return handshake.report().progress == Handshake::Progress::kDelivered; });
  CHECK(controller.memory.numbers[59] == 5);
  CHECK(controller.memory.numbers[58] == kValid);
  CHECK(requests >= 11);  // the arm's place, three written, three read, verdict, answer, both read
  CHECK(now - came <= 1'000'000);
}
