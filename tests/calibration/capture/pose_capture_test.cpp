// The steps of a capture, and everything that must not become a pose.
#include "services/calibration/capture/pose_capture.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace arcstart;
using namespace arcstart::calibration;
using Catch::Matchers::Contains;

namespace {

constexpr std::int64_t kStart = 1'700'000'000'000'000, kPeriod = 20'000;  // us: 50 Hz
const Eigen::Vector3d kPlace(900, -40, 310);
const Eigen::Quaterniond kTurn(Eigen::AngleAxisd(2.8, Eigen::Vector3d(0.6, 0.64, 0.48)));

// A cell whose camera answers after 0.15 s, and whose robot is where `place` says.
struct PoseCell {
  PoseCapture capture{PoseCaptureSettings{}};
  std::int64_t now = kStart;
  std::function<Eigen::Vector3d(std::int64_t)> place = [](std::int64_t) { return kPlace; };
  bool positions = true, camera = true, laser_works = true, laser_off_works = true;
  int incomplete = 0;  // so many images come without pixels
  std::vector<WantedImage> asked;
  std::optional<WantedImage> due;
  std::int64_t due_at = 0;
  std::mt19937 engine{7};

  std::optional<PoseCapture::Outcome> run(double seconds) {
    std::normal_distribution<double> noise(0, 0.02);
    for (const std::int64_t end = now + static_cast<std::int64_t>(seconds * 1e6); now < end;
         now += kPeriod) {
      if (positions)
        capture.take_position(
            now,
            make_transform(
                place(now) + Eigen::Vector3d(noise(engine), noise(engine), noise(engine)), kTurn));
      if (due && now >= due_at) {
        const bool lit = due->laser_on ? laser_works : !laser_off_works;
        const bool whole = incomplete-- <= 0;
        const auto answered = *due;
        due.reset();
        capture.take_image(answered.command_id, now - 30'000, lit,
                           cv::Mat(4, 6, CV_8U, cv::Scalar(answered.laser_on ? 200 : 100)),
                           whole ? "" : "packets lost");
      }
      if (const auto wanted = capture.wanted(now)) {
        if (asked.empty() || asked.back().command_id != wanted->command_id) {
          asked.push_back(*wanted);
          due = wanted;
          due_at = now + 150'000;
          if (!camera) due.reset();
        }
      }
      if (auto outcome = capture.tick(now)) return outcome;
    }
    return {};
  }
};

}  // namespace

TEST_CASE("capture: the plate dark, the stripe lit, at the mean of the positions") {
  PoseCell cell;
  cell.run(0.3);
  CHECK_FALSE(cell.capture.is_running());
  cell.capture.begin(cell.now);
  const auto outcome = cell.run(5);
  REQUIRE(outcome);
  CHECK(outcome->failure.empty());
  REQUIRE(outcome->pose);
  CHECK(outcome->pose->grid.at<std::uint8_t>(0, 0) == 100);
  CHECK(outcome->pose->laser.at<std::uint8_t>(0, 0) == 200);
  // 0.02 mm of noise an axis, over a second at 50 Hz.
  CHECK((outcome->pose->T_base_tool.translation() - kPlace).norm() < 0.012);
  CHECK(kTurn.angularDistance(Eigen::Quaterniond(outcome->pose->T_base_tool.linear())) < 1e-9);
  REQUIRE(cell.asked.size() == 2);
  CHECK_FALSE(cell.asked[0].laser_on);
  CHECK(cell.asked[0].exposure_us == 20000);
  CHECK(cell.asked[1].laser_on);
  CHECK(cell.asked[1].exposure_us == 2000);
  CHECK(cell.asked[0].command_id != cell.asked[1].command_id);
  CHECK_FALSE(cell.capture.is_running());
}

TEST_CASE("capture: it waits until the robot has stood still for half a second") {
  PoseCell cell;
  const std::int64_t arrives = kStart + 2'000'000;
  cell.place = [&](std::int64_t now) -> Eigen::Vector3d {
    const double left = 0.05 * 1e-3 * static_cast<double>(std::max<std::int64_t>(0, arrives - now));
    return kPlace + Eigen::Vector3d(left, 0, 0);  // 50 mm/s
  };
  cell.capture.begin(cell.now);
  const auto outcome = cell.run(8);
  REQUIRE(outcome);
  REQUIRE(outcome->pose);
  CHECK(cell.asked.front().command_id >= arrives + 500'000);
  CHECK((outcome->pose->T_base_tool.translation() - kPlace).norm() < 0.02);
}

TEST_CASE("capture: what must not become a pose fails with what to do") {
  PoseCell cell;
  std::string expected;
  SECTION("the robot moves between the images") {
    cell.place = [](std::int64_t now) -> Eigen::Vector3d {
      return now < kStart + 800'000 ? kPlace : Eigen::Vector3d(kPlace.x() + 0.5, kPlace.y(), 310);
    };
    expected = "the robot moved";
  }
  SECTION("the robot moves just after the last image, whose stamp may be late") {
    cell.place = [&](std::int64_t now) -> Eigen::Vector3d {
      const bool both = cell.asked.size() == 2 && now > cell.due_at + 40'000;
      return both ? Eigen::Vector3d(kPlace.x(), kPlace.y() + 1, kPlace.z()) : kPlace;
    };
    expected = "the robot moved";
  }
  SECTION("the robot never stands still") {
    cell.place = [](std::int64_t now) -> Eigen::Vector3d {
      return kPlace + Eigen::Vector3d(0, 0, 1e-6 * static_cast<double>(now - kStart));
    };
    expected = "does not stand still";
  }
  SECTION("no positions") {
    cell.positions = false;
    expected = "no positions come";
  }
  SECTION("no camera") {
    cell.camera = false;
    expected = "no image came";
  }
  SECTION("the laser stays dark") {
    cell.laser_works = false;
    expected = "stayed dark";
  }
  SECTION("the laser cannot be switched off") {
    cell.laser_off_works = false;
    expected = "cannot be switched off";
  }
  cell.capture.begin(cell.now);
  const auto outcome = cell.run(25);
  REQUIRE(outcome);
  CHECK_FALSE(outcome->pose);
  CHECK_THAT(outcome->failure, Contains(expected));
  CHECK_FALSE(cell.capture.is_running());
}

TEST_CASE("capture: an image that came incomplete is asked for again, under another id") {
  PoseCell cell;
  cell.incomplete = 2;
  cell.capture.begin(cell.now);
  const auto outcome = cell.run(10);
  REQUIRE(outcome);
  REQUIRE(outcome->pose);
  REQUIRE(cell.asked.size() == 4);
  CHECK(cell.asked[1].command_id != cell.asked[0].command_id);
}

TEST_CASE("capture: a failed one leaves nothing behind for the next") {
  PoseCell cell;
  cell.camera = false;
  cell.capture.begin(cell.now);
  const auto failed = cell.run(25);
  REQUIRE(failed);
  cell.camera = true;
  cell.capture.begin(cell.now);
  const auto outcome = cell.run(10);
  REQUIRE(outcome);
  CHECK(outcome->failure.empty());
  CHECK(outcome->pose);
}
