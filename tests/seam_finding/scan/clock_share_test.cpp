// What a scan owes to clocks that differ. Its tool moves at 3.6 mm in 71 ms.
#include "services/seam_finding/scan/clock_share.hpp"

#include <arcstart/seam_t.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "services/seam_finding/scan/scan_answer.hpp"
#include "tests/seam_finding/scan/answered_scans.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;

namespace {

constexpr double kSpeed = 3.6 / 0.071;  // mm/s
constexpr double kAllowed = 0.1;        // mm, of the settings by default

void set_clocks(CollectedScan& scan, double difference, double bound) {
  scan.state.clock_difference = difference;
  scan.state.clock_bound = bound;
}

}  // namespace

TEST_CASE("clocks that surely differ refuse a scan of either kind, with the cure") {
  AnsweredScans scans;
  CHECK(speed_of(scans.work) == Approx(kSpeed).epsilon(0.01));
  for (const double difference : {0.05, -0.05, -2.0}) {
    set_clocks(scans.work, difference, 0.0005);
    set_clocks(scans.empty, difference, 0.0005);
    for (const ScanRefusal& refusal :
         {clock_refusal(scans.work, kAllowed), background_error(scans.empty, {})}) {
      CHECK(refusal.code == seam_t::CLOCKS_DIFFER);
      CHECK_THAT(refusal.words, Catch::Contains("chrony or PTP"));
    }
    const seam_t seam = scans.answer();
    CHECK(seam.verdict == seam_t::REFUSED);
    CHECK(seam.refusal == seam_t::CLOCKS_DIFFER);
  }
  set_clocks(scans.work, 0.05, 0.0005);
  CHECK_THAT(scans.answer().reason, Catch::Contains("2.6 mm at 51 mm/s"));
}

TEST_CASE("clocks that may agree refuse nothing, but those of which nothing is certain do") {
  AnsweredScans scans;
  const auto is_refused = [&](double difference, double bound, double allowed = kAllowed) {
    set_clocks(scans.work, difference, bound);
    return !clock_refusal(scans.work, allowed).empty();
  };
  CHECK_FALSE(is_refused(0, -1));  // not measured
  CHECK_FALSE(is_refused(0, 0.0002));
  CHECK_FALSE(is_refused(0.0021, 0.0002));  // 1.9 ms are 0.096 mm
  CHECK(is_refused(0.0023, 0.0002));        // 2.1 ms are 0.106 mm
  CHECK_FALSE(is_refused(0.006, 0.006));
  CHECK(is_refused(0.025, 0.025));  // a clock was set by 50 ms, before or within the scan
  // The cell's own limit.
  CHECK_FALSE(is_refused(0.0063, 0.0002, 0.4));
  CHECK_FALSE(is_refused(0.025, 0.025, 0.4));
  CHECK(is_refused(0.0012, 0.0002, 0.04));
  CHECK(is_refused(0.006, 0.006, 0.04));
}

TEST_CASE("a seam that the clocks may displace by more than the cell allows is not usable") {
  AnsweredScans scans;
  SeamFindingSettings settings;
  const auto usable = [&](double difference, double bound) {
    set_clocks(scans.work, difference, bound);
    const seam_t seam = scans.answer(settings);
    REQUIRE(seam.verdict == seam_t::FOUND);
    const bool told = seam.remark.find("clocks that stamp images and positions") < 100;
    CHECK(told == (seam.usable == seam_t::CLOCKS_APART));
    return seam.usable;
  };
  CHECK(usable(0, 0.0019) == seam_t::USABLE);        // 0.096 mm
  CHECK(usable(0, 0.0021) == seam_t::CLOCKS_APART);  // 0.106 mm
  CHECK(usable(-0.0015, 0.001) == seam_t::CLOCKS_APART);
  CHECK(usable(0, -1) == seam_t::CLOCKS_APART);  // not compared
  settings.clock_displacement_max_mm = 0.2;
  CHECK(usable(-0.0015, 0.001) == seam_t::USABLE);
  CHECK(usable(0, -1) == seam_t::CLOCKS_APART);
  set_clocks(scans.work, 0.0063, 0.0002);  // surely by 0.31 mm
  CHECK(scans.answer(settings).refusal == seam_t::CLOCKS_DIFFER);
  settings.clock_displacement_max_mm = 0.4;
  CHECK(usable(0.0063, 0.0002) == seam_t::USABLE);
}

TEST_CASE("clocks are named before an end that was not seen, of found seams alone") {
  AnsweredScans scans;
  // A scan that ends on the seam.
  scans.work.profiles.resize(scans.work.profiles.size() * 6 / 10);
  scans.work.state.images = static_cast<int>(scans.work.profiles.size());
  scans.work.state.last_seq = scans.work.profiles.back().seq;
  REQUIRE(scans.answer().verdict == seam_t::FOUND);
  REQUIRE(scans.answer().usable == seam_t::END_NOT_SEEN);
  set_clocks(scans.work, 0, -1);
  CHECK(scans.answer().usable == seam_t::CLOCKS_APART);
  scans.work.profiles.clear();
  CHECK(scans.answer().verdict == seam_t::REFUSED);
  CHECK(scans.answer().usable == seam_t::USABLE);
}

TEST_CASE("the deviation holds what the clocks may displace") {
  AnsweredScans scans;
  const StoredBackground background(scans.empty, {});
  Calibration calibration;
  calibration.id = ScanIdentity{}.calibration_id;
  calibration.sensor_model = {1600, 1200, 2400, 2400, 800, 600, {}, {{0, 0.4, -0.9165}, 275}};
  calibration.covariance.assign(Calibration::kParameters * Calibration::kParameters, 0);
  const auto along = [&](double difference, double bound) {
    set_clocks(scans.work, difference, bound);
    const seam_t seam = answer_workpiece(scans.work, &background, {}, &calibration);
    REQUIRE(seam.verdict == seam_t::FOUND);
    CHECK(seam.start_systematic[1][1] == Approx(0).margin(1e-4));  // across the motion nothing
    return std::sqrt(seam.start_systematic[0][0]);
  };
  CHECK(along(0, 0) == Approx(0).margin(1e-6));
  CHECK(along(-0.001, 0.0005) == Approx(0.0015 * kSpeed).epsilon(0.03));
}
