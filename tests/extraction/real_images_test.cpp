// Stripes of a real sensor: 9 to 25 px wide, saturated, running down the image.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "paths.hpp"
#include "services/extraction/files/image_file.hpp"
#include "services/extraction/image/laser_light.hpp"
#include "services/extraction/stripe_extractor.hpp"
#include "tests/extraction/support/real_stripes.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

// Empty, after saying so, where the data are not there.
std::filesystem::path data_folder(const std::string& name) {
  const std::filesystem::path folder = real_data(name, ARCSTART_SOURCE);
  if (folder.empty()) WARN("skipped: no folder " << name << "; set ARCSTART_DATA");
  return folder;
}

struct Found {
  double share = 0;  // of the rows that show the stripe
  double rms = 0;    // px
  double sigma = 0;
};

Found find(const std::filesystem::path& path) {
  const cv::Mat grey = read_grey_image(path.string());
  ExtractionSettings settings;
  settings.smooth_course = false;
  const Stripe stripe = StripeExtractor(settings).extract(view_of(grey));
  const RowCentres centres = row_centres(stripe, grey.rows);
  const int margin = static_cast<int>(std::ceil(2 * stripe.sigma)) + 1;
  return {share_found(centres, grey, margin), line_rms(centres), stripe.sigma};
}

}  // namespace

TEST_CASE("etna_calib4: the stripe in nearly every row, straight to a twentieth of a pixel") {
  const auto folder = data_folder("etna_calib4");
  if (folder.empty()) return;
  const auto images = images_in(folder);
  REQUIRE(images.size() == 9);
  for (const auto& path : images) {
    const Found found = find(path);
    INFO(path.filename().string() << " share " << found.share << " rms " << found.rms
                                  << " px, sigma " << found.sigma);
    CHECK(found.share >= 0.995);
    CHECK(found.rms >= 0);
    CHECK(found.rms <= 0.06);
    CHECK(found.sigma > 4);
    CHECK(found.sigma < 8);
  }
  CHECK(find(folder / "frame0003.png").rms <= 0.05);
}

TEST_CASE("etna_calib3: the stripe in nearly every row") {
  const auto folder = data_folder("etna_calib3");
  if (folder.empty()) return;
  const auto images = images_in(folder);
  REQUIRE(images.size() == 16);
  for (const auto& path : images) {
    const Found found = find(path);
    INFO(path.filename().string() << " share " << found.share << " rms " << found.rms
                                  << " px, sigma " << found.sigma);
    CHECK(found.share >= 0.995);
    CHECK(found.rms <= 0.10);
  }
}

TEST_CASE("stripe_on_off: with the laser-off image subtracted, one stripe down the bust") {
  const auto folder = data_folder("stripe_on_off");
  if (folder.empty()) return;
  CHECK_THROWS_AS(read_grey_image((folder / "scene_laser_on.png").string()), ImageFileError);
  const cv::Mat on = read_grey_image((folder / "scene_laser_on.png").string(), "r");
  const cv::Mat off = read_grey_image((folder / "scene_laser_off.png").string(), "r");
  std::vector<std::uint8_t> light;
  const GreyImage difference = laser_light(view_of(on), view_of(off), light);
  StripeExtractor extractor(ExtractionSettings{});
  int chosen = 0, on_bust = 0;
  for (const StripeCentre& c : extractor.extract(difference).centres) {
    chosen += c.chosen;
    on_bust += c.chosen && c.u > 480 && c.u < 600 && c.v > 40 && c.v < 1130;
  }
  CHECK(on_bust > 950);
  CHECK(chosen - on_bust < 60);  // and the line on the plinth's side
}

TEST_CASE("a bright plate: the clipped channel's centres lie where an unclipped one's do") {
  const auto folder = data_folder("cases/outside/on_off_bright_plate");
  if (folder.empty()) return;
  const auto stripe_in = [&](const char* channel) {
    const cv::Mat on = read_grey_image((folder / "light0.jpg").string(), channel),
                  off = read_grey_image((folder / "calib0.jpg").string(), channel);
    std::vector<std::uint8_t> light;
    return StripeExtractor(ExtractionSettings{})
        .extract(laser_light(view_of(on), view_of(off), light));
  };
  const Stripe red = stripe_in("r"), green = stripe_in("g");
  CHECK(red.saturated_share > 0.3);
  CHECK(green.saturated_share < red.saturated_share / 2);
  std::vector<double> differences;
  for (const StripeCentre& a : green.centres)
    for (const StripeCentre& b : red.centres)
      if (a.chosen && b.chosen && std::lround(a.u) == std::lround(b.u))
        differences.push_back(std::abs(a.v - b.v));
  REQUIRE(differences.size() > 600);
  const auto middle = differences.begin() + std::ssize(differences) / 2;
  std::nth_element(differences.begin(), middle, differences.end());
  CHECK(*middle <= 0.3);
}
