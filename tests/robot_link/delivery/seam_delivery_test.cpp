#include "services/robot_link/delivery/seam_delivery.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace arcstart;
using namespace arcstart::robot_link;

namespace {

constexpr std::int64_t kNow = 1'700'000'100'000'000;

void diagonal(double (&covariance)[3][3], double variance) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) covariance[i][j] = i == j ? variance : 0;
}

seam_t good() {
  seam_t seam{};
  seam.verdict = seam_t::FOUND;
  seam.usable = seam_t::USABLE;
  seam.utime = kNow - 5'000'000;
  seam.torch_determined = 1;
  const double start[3] = {910, -1, 13}, end[3] = {1010, 4, 13.5}, approach[3] = {905, -60, 80};
  std::copy(start, start + 3, seam.start);
  std::copy(start, start + 3, seam.torch_position);
  std::copy(end, end + 3, seam.end);
  std::copy(approach, approach + 3, seam.approach_position);
  seam.torch_quaternion[1] = 1;  // half a turn about x: W 180
  diagonal(seam.start_covariance, 0.01);
  diagonal(seam.end_covariance, 0.01);
  diagonal(seam.start_systematic, -1);
  diagonal(seam.end_systematic, -1);
  return seam;
}

DeliveryLimits limits() {
  DeliveryLimits limits;
  limits.box_low = {800, -100, -10};
  limits.box_high = {1100, 100, 200};
  return limits;
}

}  // namespace

TEST_CASE("Delivery: a usable seam within the limits, in the job's frame") {
  DeliveryLimits in_frame = limits();
  // A frame at (800, 50, 10), turned by 90 deg about z: its x is base y, its y is -base x.
  in_frame.T_base_frame.translation() << 800, 50, 10;
  in_frame.T_base_frame.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const SeamDelivery found = deliver(good(), in_frame, kNow);
  REQUIRE(found.verdict == kValid);
  CHECK(found.positions[1].translation().isApprox(Eigen::Vector3d(-51, -110, 3)));
  CHECK(found.positions[2].translation().isApprox(Eigen::Vector3d(-46, -210, 3.5)));
  CHECK(found.positions[0].translation().isApprox(Eigen::Vector3d(-110, -105, 70)));
  // The wire points down in both frames.
  for (const RigidTransform& position : found.positions)
    CHECK(position.linear().col(2).isApprox(Eigen::Vector3d(0, 0, -1)));
}

TEST_CASE("Delivery: what is not found, usable or within the limits is refused by its number") {
  seam_t seam = good();
  DeliveryLimits within = limits();
  std::int32_t number = 0;
  SECTION("refused") {
    seam.verdict = seam_t::REFUSED;
    number = seam.refusal = seam_t::NO_WORKPIECE;
  }
  SECTION("ambiguous") {
    seam.verdict = seam_t::AMBIGUOUS;
    number = seam.refusal = seam_t::SEVERAL_SEAMS;
  }
  SECTION("refused without a number, or with that of a valid one") {
    seam.verdict = seam_t::REFUSED;
    seam.refusal = 1;
    number = seam_t::NO_SEAM;
  }
  SECTION("a background") {
    seam.verdict = seam_t::BACKGROUND_STORED;
    number = kForeign;
  }
  SECTION("start not seen") {
    seam.usable = seam_t::START_NOT_SEEN;
    number = 161;
  }
  SECTION("calibration failed") {
    seam.usable = seam_t::CALIBRATION_FAILED;
    number = 366;
  }
  SECTION("stale") {
    seam.utime = kNow - 61'000'000;
    number = kTooOld;
  }
  SECTION("no torch pose") {
    seam.torch_determined = 0;
    number = kNoTorch;
  }
  SECTION("start uncertain in one direction") {
    seam.start_covariance[1][1] = 0.26;  // 0.51 mm
    number = kTooUncertain;
  }
  SECTION("end uncertain by its systematic part") {
    diagonal(seam.end_systematic, 4);
    number = kTooUncertain;
  }
  SECTION("end's deviation not determined") {
    for (auto& row : seam.end_covariance)
      for (double& value : row) value = -1;
    number = kTooUncertain;
  }
  SECTION("start outside the box") {
    seam.torch_position[2] = -11;
    number = kOutOfBox;
  }
  SECTION("end outside the box") {
    seam.end[0] = 1101;
    number = kOutOfBox;
  }
  SECTION("approach outside the box") {
    seam.approach_position[2] = 201;
    number = kOutOfBox;
  }
  SECTION("a box that nobody set") {
    within.box_low = within.box_high = {};
    number = kOutOfBox;
  }
  const SeamDelivery found = deliver(seam, within, kNow);
  CHECK(found.verdict == number);
  CHECK(found.verdict != kValid);
}

TEST_CASE("Delivery: of 200 seams that are not to be acted on none is valid") {
  std::mt19937 random(3);
  const auto draw = [&](int below) {
    return static_cast<int>(random() % static_cast<unsigned>(below));
  };
  for (int round = 0; round < 200; ++round) {
    seam_t seam = good();
    switch (draw(7)) {
      case 0:
        seam.verdict = static_cast<std::int8_t>(1 + draw(3));
        seam.refusal = static_cast<std::int16_t>(draw(430));
        break;
      case 1:
        seam.usable = static_cast<std::int16_t>(1 + draw(7));
        break;
      case 2:
        seam.utime -= 56'000'000 + 1'000'000ll * draw(100000);
        break;
      case 3:
        seam.torch_position[draw(3)] += draw(2) ? 500 : -500;
        break;
      case 4:
        seam.end[draw(3)] += draw(2) ? 500 : -500;
        break;
      case 5:
        diagonal(seam.start_covariance, 0.2501 + draw(100));
        break;
      default:
        diagonal(seam.end_covariance, std::nan(""));
        break;
    }
    REQUIRE(deliver(seam, limits(), kNow).verdict > kValid);
  }
}
