#include "services/cell_simulator/image/arc_light.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "services/cell_simulator/image/image_renderer.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

double sum_of(const StripeCanvas& canvas) {
  double sum = 0;
  for (int row = 0; row < canvas.height(); ++row)
    for (const float light : canvas.light(row)) sum += light;
  return sum;
}

}  // namespace

TEST_CASE("without an arc nothing is added") {
  StripeCanvas canvas(0.5);
  canvas.clear(320, 240);
  ArcLight(SensorSettings{}).add(canvas, 1, 7, 0, 0);
  CHECK(sum_of(canvas) == 0);
}

TEST_CASE("glare falls off from its place, flickers, and is cut out by a part of the sensor") {
  SensorSettings settings;
  settings.arc_grey = 400;
  settings.arc_place_share = {0.25, 0.5};
  const ArcLight arc(settings);
  StripeCanvas whole(0.5), again(0.5), part(0.5);
  whole.clear(1600, 1200), again.clear(1600, 1200), part.clear(200, 100);
  arc.add(whole, 1, 7, 0, 0);
  arc.add(again, 1, 8, 0, 0);
  arc.add(part, 1, 7, 300, 550);
  const float middle = whole.light(600)[400];
  // Core and halo with its rays, of a brightness that flickers by three tenths.
  CHECK(middle > 0.7 * 400 * 1.07);
  CHECK(middle < 1.3 * 400 * 1.25);
  // A sixteenth of the core and a little over half of the halo are left 250 px on.
  CHECK(whole.light(600)[650] / middle < 0.2);
  CHECK(whole.light(600)[650] / middle > 0.09);
  CHECK(whole.light(600)[650] / middle == Approx(again.light(600)[650] / again.light(600)[400]));
  CHECK(again.light(600)[400] != middle);
  CHECK(part.light(50)[100] == middle);
}

TEST_CASE("spatter falls anew in every frame, and brighter under a longer exposure") {
  SensorSettings settings;
  settings.spatter_streaks = 25;
  settings.glowing_drops = 14;
  const ArcLight arc(settings);
  StripeCanvas one(0.5), same(0.5), longer(0.5), other(0.5);
  for (StripeCanvas* canvas : {&one, &same, &longer, &other}) canvas->clear(1600, 1200);
  arc.add(one, 1, 7, 0, 0);
  arc.add(same, 1, 7, 0, 0);
  arc.add(longer, 2, 7, 0, 0);
  arc.add(other, 1, 8, 0, 0);
  int bright = 0, unlike = 0;
  for (int row = 0; row < 1200; ++row)
    for (int column = 0; column < 1600; ++column) {
      bright += one.light(row)[column] > 30;
      unlike += one.light(row)[column] != other.light(row)[column];
    }
  CHECK(bright > 2'000);
  CHECK(bright < 30'000);
  CHECK(unlike > 2'000);
  CHECK(sum_of(same) == sum_of(one));
  CHECK(sum_of(longer) == Approx(2 * sum_of(one)).epsilon(1e-4));
}

TEST_CASE("an arc shines with the laser off, too") {
  SensorSettings settings;
  settings.image_width_px = 320, settings.image_height_px = 240;
  settings.focal_length_px = 480;
  settings.principal_point_px = {160, 120};
  settings.arc_grey = 400;
  ImageRenderer renderer(settings);
  Exposure exposure;
  exposure.laser_on = false;
  std::vector<std::uint8_t> grey(320 * 240);
  renderer.render(make_scene(SceneSettings{}, SceneKind::background, 1), RigidTransform::Identity(),
                  exposure, 3, grey.data(), renderer.whole_image());
  CHECK(grey[10 * 320 + 160] == 255);
  CHECK(grey[239 * 320 + 5] < 60);
}
