#include "services/reconstruction/scan_calibration.hpp"

#include <catch2/catch.hpp>

using namespace arcstart;
using namespace arcstart::reconstruction;

namespace {

std::shared_ptr<const Calibration> named(const std::string& id) {
  auto calibration = std::make_shared<Calibration>();
  calibration->id = id;
  return calibration;
}

std::string id_of(const ScanCalibration::Answer& answer) {
  return answer.calibration ? answer.calibration->id : "none: " + to_words(answer.none);
}

}  // namespace

TEST_CASE("before any calibration has come the answer is open") {
  ScanCalibration calibrations;
  CHECK(id_of(calibrations.of(7)) == "none: ");
  CHECK(id_of(calibrations.of(0)) == "none: ");
  calibrations.take(named("a"));
  CHECK(id_of(calibrations.of(7)) == "a");
  CHECK(id_of(calibrations.of(0)) == "a");
}

TEST_CASE("a scan keeps the calibration of its first stripe; a change leaves the rest without") {
  ScanCalibration calibrations;
  calibrations.take(named("a"));
  CHECK(id_of(calibrations.of(7)) == "a");
  calibrations.take(named("a"));
  CHECK(id_of(calibrations.of(7)) == "a");
  calibrations.take(named("b"));
  CHECK(id_of(calibrations.of(7)) == "none: calibration changed within the scan");
  calibrations.take(named("a"));  // back again: still changed
  CHECK(id_of(calibrations.of(7)) == "none: calibration changed within the scan");
  CHECK(id_of(calibrations.of(0)) == "a");
  CHECK(id_of(calibrations.of(8)) == "a");
}

TEST_CASE("a change between two scans holds for the second") {
  ScanCalibration calibrations;
  calibrations.take(named("a"));
  calibrations.of(7);
  calibrations.take(named("b"));
  CHECK(id_of(calibrations.of(8)) == "b");
  CHECK(id_of(calibrations.of(8)) == "b");
}

TEST_CASE("a scan given up stays without, the next does not") {
  ScanCalibration calibrations;
  calibrations.of(7);
  calibrations.give_up(7);
  calibrations.take(named("a"));
  CHECK(id_of(calibrations.of(7)) == "none: no calibration");
  CHECK(id_of(calibrations.of(8)) == "a");
  calibrations.give_up(8);  // it has one: nothing to give up
  CHECK(id_of(calibrations.of(8)) == "a");
}
