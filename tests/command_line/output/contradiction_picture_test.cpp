// What a picture of a contradicted seam shows, by its pixels.
#include "services/command_line/output/contradiction_picture.hpp"

#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/geometry.hpp"
#include "tests/command_line/support/synthetic_recording.hpp"
#include "tests/seam_finding/support/synthetic_scan.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::seam_finding;
using test::Folder;

namespace {

namespace colours = contradiction_colours;

constexpr double kMoved = 14;   // the start is claimed so much too early; mm
constexpr int kDotPixels = 13;  // of a place, a disc of radius 2

// A tee as it truly is, in a scan of it.
struct ScannedTee {
  synthetic::Scene scene = synthetic::make_scene({}, 321);
  ScanCloud cloud = synthetic::make_scan(scene, {}, 321).cloud;
  SeamResult truth;

  ScannedTee() {
    truth.verdict = SeamResult::Verdict::kFound;
    truth.joint_type = "tee";
    truth.start = scene.start, truth.end = scene.end;
    truth.direction = (scene.end - scene.start).normalized();
    for (int j = 0; j < 2; ++j) {
      const Eigen::Vector3d &own = scene.normals[j], &other = scene.normals[1 - j];
      truth.normals[j] = own;
      truth.faces[j].plane = {own, -own.dot(scene.start)};
      truth.faces[j].away = (other - other.dot(own) * own).normalized();
    }
    truth.start_visibility = truth.end_visibility = EndVisibility::kSeen;
  }
  double length() const { return (truth.end - truth.start).norm(); }
};

int count(const cv::Mat& image, const cv::Rect& where, const cv::Scalar& colour) {
  cv::Mat found;
  cv::inRange(image(where & cv::Rect({}, image.size())), colour, colour, found);
  return cv::countNonZero(found);
}

// Of a plate, between two places along the seam, from 2 to 30 mm away from it.
cv::Rect part(const ContradictionPicture& picture, int plate, double from, double to) {
  return {picture.pixel(plate, from, 2), picture.pixel(plate, to, 30)};
}

// Beside the seam on the other plate's side, where no plate is expected.
bool has(const ContradictionPicture& picture, int plate, double along, const cv::Scalar& colour) {
  const cv::Rect column(picture.pixel(plate, along, -4.5), cv::Size(1, 1));
  return count(picture.image(), column, colour) == 1;
}

}  // namespace

TEST_CASE("a picture of a start claimed too early shows the claim, the stripes and their bounds") {
  const ScannedTee tee;
  SeamResult claimed = tee.truth;
  claimed.start -= kMoved * claimed.direction;
  const ExaminedSeam seam = examined(tee.cloud, claimed);
  REQUIRE(seam.objections.size() == 1);
  CHECK(seam.objections[0].code == Reason::Code::kStartContradicted);

  const ContradictionPicture picture(seam);
  const cv::Mat& image = picture.image();
  for (const int plate : {0, 1}) {
    INFO("plate " << plate);
    // Claimed ends, whatever is drawn beside them.
    for (const double end : {0.0, tee.length() + kMoved}) {
      CHECK(has(picture, plate, end, colours::kClaim));
      CHECK_FALSE(has(picture, plate, end + 0.7, colours::kClaim));
    }
    // What was claimed too much is predicted and not seen: past the plate something else is.
    const cv::Rect too_much = part(picture, plate, 0.5, kMoved - 6);
    CHECK(count(image, too_much, colours::kOn) == 0);
    // The plate itself is there: a place every 2 mm or so on stripes 3.6 mm apart, each a dot.
    const cv::Rect there = part(picture, plate, kMoved + 20, kMoved + 40);
    const int on = count(image, there, colours::kOn);
    CHECK(on > 30 * kDotPixels);
    CHECK(on > 20 * count(image, there, colours::kThrough));
    // The bounds lie about the true start, and not about the claimed one.
    CHECK(has(picture, plate, kMoved, colours::kBounds));
    CHECK_FALSE(has(picture, plate, kMoved / 2, colours::kBounds));
    CHECK_FALSE(has(picture, plate, kMoved + tee.length() / 2, colours::kBounds));
  }
  const cv::Rect beside = part(picture, 0, 1, kMoved - 6) | part(picture, 1, 1, kMoved - 6);
  CHECK(count(image, beside, colours::kThrough) > 0);
}

TEST_CASE("a seam that the stripes bear out has nothing against it") {
  const ScannedTee tee;
  CHECK(examined(tee.cloud, tee.truth).objections.empty());
}

TEST_CASE("of a turned plate the picture is written, and named by its reason") {
  const ScannedTee tee;
  SeamResult turned = tee.truth;
  const Eigen::AngleAxisd turn(2 * kDegree, turned.direction);
  SeamPlate& face = turned.faces[0];
  turned.normals[0] = face.plane.normal = turn * face.plane.normal;
  face.plane.offset = -face.plane.normal.dot(turned.start);
  face.away = turn * face.away;
  const ExaminedSeam seam = examined(tee.cloud, turned);
  REQUIRE(seam.objections.size() == 1);
  CHECK(seam.objections[0].code == Reason::Code::kPlateTurned);
  CHECK(seam.ruled.verdict == SeamResult::Verdict::kRefused);

  const Folder folder;
  const ContradictionPicture picture(seam);
  picture.write(folder / "turned.png");
  const cv::Mat read = cv::imread(folder / "turned.png");
  REQUIRE(read.size() == picture.image().size());
  CHECK(cv::norm(read, picture.image(), cv::NORM_INF) == 0);
  CHECK_THROWS(picture.write(folder / "nowhere/turned.png"));
}

TEST_CASE("of the answers those are looked at again that the referee may have changed") {
  seam_t answer{};
  answer.verdict = seam_t::FOUND;
  answer.stripes_checked = 30;
  answer.usable = seam_t::USABLE;
  CHECK_FALSE(may_be_contradicted(answer));
  answer.usable = seam_t::START_UNSURE;
  CHECK(may_be_contradicted(answer));
  answer.verdict = seam_t::REFUSED;
  answer.usable = 0;
  CHECK(may_be_contradicted(answer));
  answer.stripes_checked = -1;  // refused before the referee saw it
  CHECK_FALSE(may_be_contradicted(answer));
}
