// The program itself, over real multicast, against a double of the services; run under
// scripts/in-private-network.
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/bus/bus.hpp"
#include "common/service.hpp"
#include "common/time.hpp"
#include "services/seam_finding/scan/answer_mark.hpp"
#include "tests/command_line/support/synthetic_recording.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// arcstart with these arguments, its outputs in files.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), ARCSTART_PROGRAM);
    child_ = fork();
    if (child_ == 0) {
      std::vector<char*> pointers;
      for (auto& argument : arguments) pointers.push_back(argument.data());
      pointers.push_back(nullptr);
      dup2(open((folder_ / "out").c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
      dup2(open((folder_ / "err").c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
      execv(pointers[0], pointers.data());
      _exit(127);
    }
  }
  ~Program() {
    if (child_ > 0) kill(child_, SIGKILL), waitpid(child_, nullptr, 0);
  }
  void interrupt() const { kill(child_, SIGINT); }
  bool ended() {
    if (child_ <= 0) return true;
    int status = 0;
    if (waitpid(child_, &status, WNOHANG) == 0) return false;
    child_ = -1;
    code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return true;
  }
  int code() const { return code_; }
  std::string out() const { return text_of(folder_ / "out"); }
  std::string err() const { return text_of(folder_ / "err"); }

 private:
  Folder folder_;
  pid_t child_ = -1;
  int code_ = -1;
};

// sensor_capture and seam_finding, as far as the operator sees them.
struct Cell {
  Bus bus{BusSettings{}};
  std::vector<scan_command_t> commands;
  scan_t state{};
  seam_t seam{}, forged{};  // the second by a stranger, where it has a scan_id
  std::int64_t next = 0, started = 0;
  double scan_s = 1e9;  // after which it ends by itself
  std::string also;     // a channel on which something strange is sent as well

  Cell() {
    state.run_id = 5;
    seam.direction[0] = 1;
    seam.joint_type = "tee";
    bus.subscribe<scan_command_t>(
        "LASER0_SCAN_COMMAND", Queue::measurements(), [this](const scan_command_t& command) {
          commands.push_back(command);
          if (command.action == scan_command_t::START && state.state != scan_t::SCANNING &&
              command.command_id != state.command_id) {
            state.state = scan_t::SCANNING;
            state.end_cause = scan_t::NONE;
            state.command_id = command.command_id;
            state.scan_id = state.begin_utime = started = utime_now();
          }
          if (command.action == scan_command_t::STOP && state.state == scan_t::SCANNING) end();
        });
  }
  void end() {
    state.state = scan_t::ENDED;
    state.end_utime = utime_now();
    state.end_cause = scan_t::STOP;
    seam.scan_id = state.scan_id;
  }
  void step() {
    bus.handle(20ms);
    if (state.state == scan_t::SCANNING && utime_now() - started > seconds_to_us(scan_s)) end();
    if (steady_now() < next) return;
    next = steady_now() + 200'000;
    state.utime = utime_now();
    bus.publish("LASER0_SCAN", state);
    if (!also.empty()) bus.publish_bytes(also, {1, 2, 3});
    if (seam.scan_id == 0) return;
    bus.publish("LASER0_SEAM", seam);
    service_status_t status{};
    status.utime = status.run_id = 5;
    status.state = service_status_t::RUNNING;
    status.last_error = seam_finding::answer_mark(seam);
    bus.publish("LASER0_SEAM_FINDING_STATUS", status);
    if (forged.scan_id == 0) return;
    forged.scan_id = seam.scan_id;
    bus.publish("LASER0_SEAM", forged);
  }
  // Runs the cell until the program ends, 60 s at most.
  void serve(Program& program) {
    for (const std::int64_t end = steady_now() + 60'000'000;
         steady_now() < end && !program.ended();)
      step();
    INFO(program.err());
    REQUIRE(program.ended());
  }
};

}  // namespace

TEST_CASE("arcstart scan runs a scan and prints its seam as JSON") {
  Cell cell;
  cell.scan_s = 0.7;
  Program program({"scan", "--kind", "workpiece", "--duration", "9"});
  cell.serve(program);
  CHECK(program.code() == 0);
  const auto seam = nlohmann::json::parse(program.out());
  CHECK(seam["scan_id"] == cell.state.scan_id);
  CHECK(seam["joint_type"] == "tee");
  REQUIRE_FALSE(cell.commands.empty());
  CHECK(cell.commands[0].kind == scan_t::WORKPIECE);
  CHECK(cell.commands[0].longest_duration == 9);
}

TEST_CASE("a stranger's SEAM beside the true one changes nothing, and is told") {
  Cell cell;
  cell.scan_s = 0.7;
  cell.forged = cell.seam;
  cell.forged.scan_id = 1;
  cell.forged.start[0] = 444;
  Program program({"scan", "--kind", "workpiece"});
  while (cell.state.state != scan_t::SCANNING) cell.step();
  seam_t early = cell.forged;
  early.scan_id = cell.state.scan_id;
  cell.bus.publish("LASER0_SEAM", early);
  cell.serve(program);
  CHECK(program.code() == 0);
  CHECK(nlohmann::json::parse(program.out())["start"][0] == 0);
  CHECK_THAT(program.err(), Contains("start 444.000"));
}

TEST_CASE("Ctrl-C stops the scan, and its answer is printed all the same") {
  Cell cell;
  cell.seam.verdict = seam_t::REFUSED;
  cell.seam.refusal = seam_t::FEW_STRIPES_CROSS;
  cell.seam.reason = "too few stripes";
  Program program({"scan", "--kind", "workpiece"});
  while (cell.state.state != scan_t::SCANNING) cell.step();
  for (int i = 0; i < 20; ++i) cell.step();
  program.interrupt();
  cell.serve(program);
  CHECK(cell.commands.back().action == scan_command_t::STOP);
  CHECK(program.code() == 1);
  CHECK(nlohmann::json::parse(program.out())["reason"] == "too few stripes");
  CHECK_THAT(program.err(), Contains("too few stripes"));
}

TEST_CASE("where no service runs, arcstart scan says so and ends with 1") {
  Program program({"scan", "--kind", "background", "--timeout", "1"});
  for (int i = 0; i < 1200 && !program.ended(); ++i) usleep(50'000);
  REQUIRE(program.ended());
  CHECK(program.code() == 1);
  CHECK(program.out().empty());
  CHECK_THAT(program.err(),
             Contains("LASER0_SCAN is not heard") && Contains("no service of the chain is heard"));
}

TEST_CASE("arcstart cell check looks at this host and at who is on the bus") {
  Cell cell;
  cell.seam.scan_id = 77;
  Program program({"cell", "check", "--seconds", "1", "--state", "/tmp"});
  cell.serve(program);
  CHECK(program.code() == 1);
  CHECK_THAT(program.out(), Contains("good  route       239.255.76.67 leaves by lo, ttl 0") &&
                                Contains("calibration none in force") &&
                                Contains("LASER0_SEAM_FINDING runs") &&
                                Contains("--only sensor_capture,robot_pose,calibration,extraction,"
                                         "reconstruction\n"));
  CHECK(program.err().empty());

  Program wrong({"cell", "check", "--cell", "/not/there.yaml"});
  cell.serve(wrong);
  CHECK(wrong.code() == 2);
}

TEST_CASE("arcstart monitor shows what is on the bus") {
  Cell cell;
  Program program({"monitor", "--once", "--json"});
  cell.serve(program);
  CHECK(program.code() == 0);
  const auto list = nlohmann::json::parse(program.out());
  REQUIRE(list.size() == 1);
  CHECK(list[0]["channel"] == "LASER0_SCAN");
  CHECK(list[0]["undecodable"] == 0);
  CHECK(list[0]["messages"] > 0);
  CHECK(list[0]["rate_hz"] > 0);

  Program table({"monitor", "--once", "--seconds", "1"});
  cell.also = "\x1b[2J\nEVIL";
  cell.serve(table);
  CHECK(table.code() == 0);
  CHECK_THAT(table.out(), Contains("LASER0_SCAN") && Contains("\\x1b[2J\\x0aEVIL"));
  CHECK(table.out().find('\x1b') == std::string::npos);  // piped: plain

  Program nothing({"monitor", "--seconds", "0.5"});
  for (int i = 0; i < 1200 && !nothing.ended(); ++i) usleep(50'000);
  REQUIRE(nothing.ended());
  CHECK(nothing.code() == 1);
}

TEST_CASE("arcstart monitor --seams tells each seam once") {
  Cell cell;
  cell.seam.scan_id = 77;
  Program program({"monitor", "--seams", "--seconds", "2"});
  cell.serve(program);
  CHECK(program.code() == 0);
  CHECK(nlohmann::json::parse(program.out())["scan_id"] == 77);
}
