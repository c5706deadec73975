#include "services/calibration/calibration_app.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <vector>

#include "common/bus/calibration_message.hpp"
#include "services/calibration/files/calibration_file.hpp"
#include "tests/calibration/support/sample_file.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::test;
using Catch::Matchers::Contains;

namespace {

constexpr std::int64_t kBegin = 1'700'000'000'000'000, kSecond = 1'000'000;

// The app with a folder of its own, and all that it publishes. Time is what the test says.
struct Cell {
  std::filesystem::path folder;
  std::string file;
  std::unique_ptr<Bus> bus = Bus::in_memory();
  std::unique_ptr<CalibrationApp> app;
  std::vector<std::vector<std::uint8_t>> bytes;
  std::vector<calibration_t> messages;
  int writes = 0;

  Cell() {
    std::string name =
        (std::filesystem::temp_directory_path() / "arcstart_calibration_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    folder = name;
    file = name + "/calibration.yaml";
    CalibrationSettings settings;
    settings.file = file;
    app = std::make_unique<CalibrationApp>(*bus, settings, Instance{}, 1);
    bus->subscribe_pattern(
        "LASER0_CALIBRATION", Queue::measurements(),
        [this](const auto& message, const std::string&) { bytes.push_back(message); });
    bus->subscribe<calibration_t>(
        "LASER0_CALIBRATION", Queue::measurements(),
        [this](const calibration_t& message) { messages.push_back(message); });
  }
  ~Cell() { std::filesystem::remove_all(folder); }

  void write(const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
    // Whatever the file system's clock does: every write has a stamp of its own.
    std::filesystem::last_write_time(
        file, std::filesystem::file_time_type() + std::chrono::seconds(++writes));
  }
  // As the shell does: 20 times a second, from one time to another.
  void run(double from, double to) {
    for (auto n = static_cast<std::int64_t>(from * 20); n < static_cast<std::int64_t>(to * 20);
         ++n) {
      app->tick(kBegin + n * kSecond / 20);
      bus->handle(std::chrono::milliseconds(0));
    }
  }
};

}  // namespace

TEST_CASE("the calibration goes out once a second, byte for byte the same") {
  Cell cell;
  cell.write(with_id(kContent));
  cell.run(0, 5);
  REQUIRE(cell.messages.size() == 5);
  for (const auto& bytes : cell.bytes) CHECK(bytes == cell.bytes[0]);
  const calibration_t& message = cell.messages[0];
  CHECK(message.id == fingerprint(kContent));
  CHECK(message.utime == 1750000000000000);  // when it was made
  CHECK(message.camera_quaternion[1] == Approx(-0.5));
  CHECK(message.covariance_size == 0);
  CHECK(calibration_from_message(message).T_tool_camera.isApprox(
      parse_calibration(with_id(kContent), "").T_tool_camera, 1e-15));
  // M by hand: -d K^-1 above n' K^-1.
  CHECK(message.pixel_to_camera[0][0] == Approx(-111.77405781307215 / 2400));
  CHECK(message.pixel_to_camera[1][2] == Approx(111.77405781307215 * 599.5 / 2401.5));
  CHECK(message.pixel_to_camera[2][2] == Approx(-111.77405781307215));
  CHECK(message.pixel_to_camera[3][1] == Approx(0.928 / 2401.5));
  CHECK(message.pixel_to_camera[3][2] == Approx(-0.3725801927102405 - 0.928 * 599.5 / 2401.5));
  CHECK(cell.app->health().state == service_status_t::RUNNING);
}

TEST_CASE("a calibration that failed comes into force where a person answers for it alone") {
  const std::string failed = replaced(kContent, "passed", "failed");
  Cell cell;
  cell.write(with_id(failed));
  cell.run(0, 2);
  CHECK(cell.messages.empty());
  CHECK(cell.app->health().state == service_status_t::FAULT);
  CHECK_THAT(cell.app->health().last_error,
             Contains("failed its limits and is not put in force") && Contains("--force"));
  cell.write(with_id(kContent));
  cell.run(2, 3);
  REQUIRE(cell.messages.size() == 1);
  CHECK(cell.messages[0].passed == calibration_t::PASSED);
  cell.write(with_id(failed));
  cell.run(3, 4);
  CHECK(cell.messages.back().id == fingerprint(kContent));
  CHECK(cell.app->health().state == service_status_t::DEGRADED);
  CHECK_THAT(cell.app->health().last_error, Contains("stays in force"));
  const std::string forced = replaced(failed, "forced_by: \"\"", "forced_by: \"R. Meyer\"");
  cell.write(with_id(forced));
  cell.run(4, 5);
  CHECK(cell.messages.back().id == fingerprint(forced));
  CHECK(cell.messages.back().passed == calibration_t::FAILED);
  CHECK(cell.messages.back().forced_by == "R. Meyer");
  CHECK(cell.app->health().state == service_status_t::DEGRADED);
  CHECK_THAT(cell.app->health().last_error, Contains("forced into use by R. Meyer"));
  cell.write(with_id(kContent));
  cell.run(5, 6);
  CHECK(cell.app->health().state == service_status_t::RUNNING);
  CHECK(cell.app->health().last_error.empty());
}

TEST_CASE("a calibration without a verdict stays in force, degraded") {
  Cell cell;
  cell.write(with_id(replaced(kContent, kVerdict, "")));
  cell.run(0, 2);
  REQUIRE(cell.messages.size() == 2);
  CHECK(cell.messages[0].passed == calibration_t::NOT_JUDGED);
  CHECK(cell.app->health().state == service_status_t::DEGRADED);
  CHECK_THAT(cell.app->health().last_error, Contains("no verdict"));
}

TEST_CASE("without a file the service waits in fault, and takes it when it comes") {
  Cell cell;
  cell.run(0, 2);
  CHECK(cell.messages.empty());
  CHECK(cell.app->health().state == service_status_t::FAULT);
  CHECK_THAT(cell.app->health().last_error, Contains(cell.file) && Contains("cannot be read"));
  cell.write(replaced(with_id(kContent), "-0.02732", "0.02732"));
  cell.run(2, 4);
  CHECK(cell.messages.empty());
  CHECK(cell.app->health().state == service_status_t::FAULT);
  CHECK_THAT(cell.app->health().last_error, Contains("changed by hand"));
  cell.write(with_id(kContent));
  cell.run(4, 5);
  CHECK(cell.messages.size() == 1);
  CHECK(cell.app->health().state == service_status_t::RUNNING);
  CHECK(cell.app->health().last_error == "");
}

TEST_CASE("a bad file mended within one tick of the file system's clock is taken all the same") {
  Cell cell;
  const std::string sound = with_id(kContent);
  cell.write(replaced(sound, "60, 5", "61, 5"));  // of the same size
  cell.run(0, 1);
  CHECK(cell.app->health().state == service_status_t::FAULT);
  cell.writes = 0;
  cell.write(sound);
  cell.run(1, 2);
  CHECK(cell.messages.size() == 1);
}

TEST_CASE("a file that changes while the service runs is a new calibration, at once") {
  Cell cell;
  cell.write(with_id(kContent));
  cell.run(0, 1.5);
  REQUIRE(cell.messages.size() == 2);
  const std::string other = replaced(kContent, "-0.02732", "-0.030");
  cell.write(with_id(other));
  cell.run(1.5, 2.1);
  REQUIRE(cell.messages.size() == 3);
  CHECK(cell.messages[2].id == fingerprint(other));
  CHECK(cell.messages[2].time_offset == -0.03);
  cell.run(2.1, 5);
  CHECK(cell.messages.size() == 5);
}

TEST_CASE("a file that goes bad or away leaves the calibration in force, and is told") {
  Cell cell;
  cell.write(with_id(kContent));
  cell.run(0, 1);
  cell.write("id: 0\n");
  cell.run(1, 3);
  REQUIRE(cell.messages.size() == 3);
  CHECK(cell.messages[2].id == fingerprint(kContent));
  CHECK(cell.app->health().state == service_status_t::DEGRADED);
  CHECK_THAT(cell.app->health().last_error, Contains("is missing") && Contains("stays in force"));
  std::filesystem::remove(cell.file);
  cell.run(3, 5);
  CHECK(cell.messages.size() == 5);
  CHECK_THAT(cell.app->health().last_error, Contains("cannot be read"));
  cell.write(with_id(kContent));  // the same as before: no new calibration
  cell.run(5, 7);
  CHECK(cell.bytes.back() == cell.bytes.front());
  CHECK(cell.app->health().state == service_status_t::RUNNING);
}

TEST_CASE("the file put back with its old stamp is well again") {
  Cell cell;
  cell.write(with_id(kContent));
  cell.run(0, 1);
  cell.write("id: 0\n");
  cell.run(1, 2);
  REQUIRE(cell.app->health().state == service_status_t::DEGRADED);
  cell.writes = 0;
  cell.write(with_id(kContent));
  cell.run(2, 3);
  CHECK(cell.app->health().state == service_status_t::RUNNING);
}

TEST_CASE("a file of another sensor or robot is refused") {
  for (const auto& [old, by] : {std::pair("LASER0", "LASER1"), std::pair("ROBOT0", "ROBOT1")}) {
    Cell cell;
    cell.write(with_id(replaced(kContent, old, by)));
    cell.run(0, 2);
    CHECK(cell.messages.empty());
    CHECK(cell.app->health().state == service_status_t::FAULT);
    CHECK_THAT(cell.app->health().last_error, Contains(by) && Contains(old));
  }
}

TEST_CASE("it goes on when the host's clock is set back") {
  Cell cell;
  cell.write(with_id(kContent));
  cell.run(3600, 3602);
  CHECK(cell.messages.size() == 2);
  cell.run(0, 2);
  CHECK(cell.messages.size() == 4);
}
