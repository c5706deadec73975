#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "common/sensor_model.hpp"
#include "services/cell_simulator/image/image_renderer.hpp"
#include "tests/cell_simulator/image/expected_stripe.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;
using arcstart::test::Expected, arcstart::test::Floor;

namespace {

struct Moments {
  double sum, mean, deviation, peak;
};
Moments column(const std::vector<float>& grey, int width, int u, double ambient) {
  Moments result{0, 0, 0, 0};
  const int height = static_cast<int>(grey.size()) / width;
  double square = 0;
  for (int v = 0; v < height; ++v) {
    const double light = grey[v * width + u] - ambient;
    result.sum += light;
    result.mean += v * light;
    result.peak = std::max(result.peak, light);
  }
  result.mean /= result.sum;
  for (int v = 0; v < height; ++v)
    square += (v - result.mean) * (v - result.mean) * (grey[v * width + u] - ambient);
  result.deviation = std::sqrt(square / result.sum);
  return result;
}

}  // namespace

TEST_CASE(
    "the stripe on a flat floor lies where line and plane meet, as wide and as bright as it must "
    "be") {
  for (const int width : {1600, 400}) {
    for (const Floor& floor : {Floor{0, 0, 10}, Floor{0.2, -0.1, 5}, Floor{-0.15, 0.5, 20}}) {
      SensorSettings settings;
      settings.image_width_px = width;
      settings.image_height_px = width * 3 / 4;
      settings.distortion = {-0.1, 0.05, 0.001, -0.0015, 0.01};
      ImageRenderer renderer(settings);
      const RigidTransform T_base_tool = taught_tool_pose(settings, {}, 3.7);
      const Scene scene({floor.object()});
      const std::vector<float> grey =
          renderer.render_without_noise(scene, T_base_tool, {}, renderer.whole_image());
      const Expected expected(settings, renderer.sensor(), T_base_tool, floor);
      const std::vector<double> middle = expected.columns(width),
                                ahead = expected.columns(width, 0.1),
                                behind = expected.columns(width, -0.1);
      double worst = 0, worst_width = 0;
      for (int u = 2; u < width - 2; ++u) {
        const Moments seen = column(grey, width, u, settings.ambient_grey);
        worst = std::max(worst, std::abs(seen.mean - middle[u]));
        // Sheet, optics and pixel, measured along the column.
        const double slope = (middle[u + 1] - middle[u - 1]) / 2;
        const double sheet = settings.sheet_sigma_mm * std::abs(ahead[u] - behind[u]) / 0.2;
        const double blur = (0.5 * 0.5 + 1.0 / 12) * (1 + slope * slope);
        worst_width =
            std::max(worst_width, std::abs(seen.deviation / std::sqrt(sheet * sheet + blur) - 1));
      }
      CAPTURE(width, floor.slope_x, floor.slope_y);
      CHECK(worst < 0.02);
      CHECK(worst_width < 0.02);

      // How much light a column gets, on the level floor: by incidence, and as the fan spreads with
      // the distance.
      if (floor.slope_x != 0) continue;
      for (const int percent : {5, 30, 50, 70, 95}) {
        const int u = width * percent / 100;
        const Eigen::Vector3d lit = expected.floor_point(u, middle[u]);
        const Eigen::Vector3d ray = lit - expected.projector();
        const double incidence = std::abs(ray.normalized().dot(expected.floor_normal()));
        const double spread = (expected.target() - expected.projector()).norm() / ray.norm();
        const double sheet_px = settings.sheet_sigma_mm * std::abs(ahead[u] - behind[u]) / 0.2;
        const double light =
            320 * 0.4 * incidence * spread * sheet_px * std::sqrt(2 * std::numbers::pi);
        CHECK(column(grey, width, u, settings.ambient_grey).sum == Approx(light).epsilon(0.005));
      }
    }
  }
}

TEST_CASE("the true stripe is the image's") {
  const SensorSettings settings;
  ImageRenderer renderer(settings);
  const RigidTransform T_base_tool = taught_tool_pose(settings, {}, -20);
  const Floor floor{0.05, 0.1, 0};
  const Scene scene({floor.object()});
  const std::vector<double> middle =
      Expected(settings, renderer.sensor(), T_base_tool, floor).columns(1600);
  int inside = 0;
  for (const StripePoint& point : renderer.true_stripe(scene, T_base_tool, 1)) {
    CHECK(point.visible);
    CHECK_FALSE(point.ghost);
    CHECK(point.base.z() == Approx(floor.z(point.base.x(), point.base.y())).margin(1e-9));
    if (point.pixel.x() < 0 || point.pixel.x() > 1598) continue;
    ++inside;
    const int u = static_cast<int>(point.pixel.x());
    const double expected = middle[u] + (point.pixel.x() - u) * (middle[u + 1] - middle[u]);
    CHECK(point.pixel.y() == Approx(expected).margin(1e-3));
  }
  CHECK(inside > 1500);
}

TEST_CASE("light goes with exposure and gain, and the laser can be off") {
  const SensorSettings settings;
  ImageRenderer renderer(settings);
  const Scene scene({Floor{0, 0, 0}.object()});
  const RigidTransform T_base_tool = taught_tool_pose(settings, {}, 0);
  const ImageRegion all = renderer.whole_image();
  const auto normal = renderer.render_without_noise(scene, T_base_tool, {2000, 0, true}, all);
  const auto half = renderer.render_without_noise(scene, T_base_tool, {1000, 0, true}, all);
  const auto double_gain =
      renderer.render_without_noise(scene, T_base_tool, {2000, 20 * std::log10(2.0), true}, all);
  const auto off = renderer.render_without_noise(scene, T_base_tool, {2000, 0, false}, all);
  double worst = 0, brightest = 0;
  for (std::size_t i = 0; i < normal.size(); ++i) {
    worst = std::max<double>(worst, std::abs(half[i] - normal[i] / 2));
    worst = std::max<double>(worst, std::abs(double_gain[i] - 2 * normal[i]));
    worst = std::max<double>(worst, std::abs(off[i] - 4));
    brightest = std::max<double>(brightest, normal[i]);
  }
  CHECK(worst < 1e-3);
  CHECK(brightest > 60);
}

TEST_CASE("a region is a part of the whole image") {
  const SensorSettings settings;
  ImageRenderer renderer(settings);
  const Scene scene = make_scene({}, SceneKind::workpiece, 2);
  const RigidTransform T_base_tool = taught_tool_pose(settings, {}, 0);
  std::vector<std::uint8_t> whole(1600 * 1200), again(1600 * 1200), other(1600 * 1200);
  renderer.render(scene, T_base_tool, {}, 99, whole.data(), renderer.whole_image());
  const ImageRegion region{203, 401, 777, 350};
  std::vector<std::uint8_t> part(777 * 350);
  renderer.render(scene, T_base_tool, {}, 99, part.data(), region);
  int unlike = 0;
  for (int row = 0; row < 350; ++row)
    for (int column = 0; column < 777; ++column)
      unlike += std::abs(part[row * 777 + column] - whole[(row + 401) * 1600 + column + 203]) > 1;
  CHECK(unlike == 0);
  // The same arguments give the same bytes, whatever was rendered between; another frame has other
  // noise.
  ImageRenderer another(settings);
  another.render(scene, T_base_tool, {}, 99, again.data(), another.whole_image());
  CHECK(whole == again);
  renderer.render(scene, T_base_tool, {}, 99, again.data(), renderer.whole_image());
  CHECK(whole == again);
  renderer.render(scene, T_base_tool, {}, 100, other.data(), renderer.whole_image());
  int differing = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) differing += whole[i] != other[i];
  CHECK(differing > 1600 * 1200 / 2);

  for (const ImageRegion& bad : {ImageRegion{0, 0, 1601, 1200},
                                 {1, 0, 1600, 1200},
                                 {-1, 0, 10, 10},
                                 {0, 1200, 10, 1},
                                 {0, 0, 0, 5}})
    CHECK_THROWS_AS(renderer.render(scene, T_base_tool, {}, 1, whole.data(), bad),
                    std::invalid_argument);
}

TEST_CASE(
    "the pipeline's sensor model, given the true numbers, takes the stripe's pixels back to its "
    "points") {
  SensorSettings settings;
  settings.distortion = {-0.1, 0.05, 0.001, -0.0015, 0.01};
  const ImageRenderer renderer(settings);
  const TrueSensor& truth = renderer.sensor();
  const SensorModel model{
      truth.width, truth.height, truth.fx,         truth.fy,
      truth.cx,    truth.cy,     truth.distortion, {truth.laser_normal, truth.laser_offset}};
  REQUIRE(sensor_model_error(model).empty());
  const RigidTransform T_base_tool = taught_tool_pose(settings, {}, 12);
  int inside = 0;
  for (const StripePoint& point :
       renderer.true_stripe(make_scene({}, SceneKind::workpiece, 4), T_base_tool, 5)) {
    const Eigen::Vector2d& pixel = point.pixel;
    if (point.ghost || pixel.x() < 0 || pixel.x() > 1599 || pixel.y() < 0 || pixel.y() > 1199)
      continue;
    ++inside;
    const auto camera = camera_point(model, pixel.x(), pixel.y());
    REQUIRE(camera);
    CHECK((T_base_tool * truth.T_tool_camera * *camera - point.base).norm() < 1e-6);
  }
  CHECK(inside > 200);
}
