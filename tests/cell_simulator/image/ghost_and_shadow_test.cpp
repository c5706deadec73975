#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "services/cell_simulator/image/image_renderer.hpp"
#include "tests/cell_simulator/image/expected_stripe.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;
using arcstart::test::Expected, arcstart::test::Floor;

TEST_CASE("what stands between camera and stripe hides it, and only it") {
  // A board over the floor in the camera's way, outside the laser's: the laser comes from ahead.
  const SensorSettings settings;
  ImageRenderer renderer(settings);
  const RigidTransform T_base_tool = taught_tool_pose(settings, {}, 0);
  const Floor floor{0, 0, 0};
  const Eigen::Vector3d low(935, -60, 100), high(960, -10, 102);
  const Scene scene({floor.object(), {"board", make_box(low, high), {0, 0, 1, 0, 0}}});  // black
  const std::vector<float> grey =
      renderer.render_without_noise(scene, T_base_tool, {}, renderer.whole_image());
  const Expected expected(settings, renderer.sensor(), T_base_tool, floor);
  const Eigen::Vector3d camera = (T_base_tool * renderer.sensor().T_tool_camera).translation();
  int hidden = 0, seen = 0, edges = 0;
  bool was_behind = false;
  for (const StripePoint& point : renderer.true_stripe(scene, T_base_tool, 1)) {
    if (point.object != 0 || point.pixel.x() < 20 || point.pixel.x() > 1580) continue;
    // Slabs: where the way from the point to the camera is within the board's bounds in each axis.
    const auto behind = [&](const Eigen::Vector3d& p) {
      double enter = 0, leave = 1;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (low[axis] - p[axis]) / (camera[axis] - p[axis]);
        const double b = (high[axis] - p[axis]) / (camera[axis] - p[axis]);
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      return enter < leave;
    };
    CHECK(point.visible == !behind(point.base));
    edges += behind(point.base) != was_behind;
    was_behind = behind(point.base);
    // In the image, away from the edges of sight: the sheet has a thickness.
    bool near_edge = false;
    for (const Eigen::Vector3d& aside : {Eigen::Vector3d(1.2, 0, 0), Eigen::Vector3d(0, 1.2, 0)})
      near_edge = near_edge || behind(point.base + aside) != behind(point.base) ||
                  behind(point.base - aside) != behind(point.base);
    if (near_edge) continue;
    const auto u = static_cast<int>(std::lround(point.pixel.x())),
               v = static_cast<int>(std::lround(point.pixel.y()));
    const double light = grey[v * 1600 + u] - settings.ambient_grey;
    if (behind(point.base)) {
      CHECK(light < 0.01);
      ++hidden;
    } else {
      CHECK(light > 20);
      ++seen;
    }
  }
  CHECK(edges >= 2);
  CHECK(hidden > 100);
  CHECK(seen > 500);
}

TEST_CASE("a sheet that is lit from behind is not seen, one that is lit from before is") {
  // A thin board through the point where the optical axis meets the laser; the projector stands
  // ahead (+x) of the camera.
  const SensorSettings settings;
  ImageRenderer renderer(settings);
  const RigidTransform T_base_tool = taught_tool_pose(settings, {}, 0);
  for (const bool lit_from_behind : {false, true}) {
    // Leaning so that camera and projector look at unlike sides, or at the same.
    const double lean = lit_from_behind ? 10 : 150;
    const TriangleMesh board{{{950 - lean, -60, -40},
                              {950 - lean, 60, -40},
                              {950 + lean, 60, 60},
                              {950 + lean, -60, 60}},
                             {{0, 1, 2}, {0, 2, 3}}};
    const Scene scene({{"board", board, {0.4, 0, 1, 0, 0}}});
    int visible = 0, all = 0;
    for (const StripePoint& point : renderer.true_stripe(scene, T_base_tool, 1)) {
      ++all;
      visible += point.visible;
    }
    double brightest = 0;
    for (const float grey :
         renderer.render_without_noise(scene, T_base_tool, {}, renderer.whole_image()))
      brightest = std::max<double>(brightest, grey);
    CHECK(all > 300);
    CHECK(visible == (lit_from_behind ? 0 : all));
    CHECK((brightest > 10) == !lit_from_behind);
  }
}

TEST_CASE(
    "the ghost of a glossy joint appears at the mirrored place, at its share of the brightness") {
  SensorSettings settings;
  SceneSettings scene_settings;
  scene_settings.yaw_range_deg = scene_settings.tilt_range_deg = scene_settings.place_range_mm = 0;
  scene_settings.size_range_share = 0;
  scene_settings.tool_lying_about = false;
  ImageRenderer renderer(settings);
  const RigidTransform T_base_tool = taught_tool_pose(settings, scene_settings, 0);
  const RigidTransform T_base_camera = T_base_tool * renderer.sensor().T_tool_camera;
  const Eigen::Vector3d normal = T_base_camera.linear() * renderer.sensor().laser_normal;
  const Eigen::Vector3d source = T_base_camera * renderer.sensor().projector;
  const Expected expected(settings, renderer.sensor(), T_base_tool, {0, 0, 10});

  const auto grey_at = [&](double specular_share, const cv::Point2d& pixel) {
    scene_settings.plate_specular_share = specular_share;
    const Scene scene = make_scene(scene_settings, SceneKind::workpiece, 3);
    const std::vector<float> grey =
        renderer.render_without_noise(scene, T_base_tool, {}, renderer.whole_image());
    return grey[std::lround(pixel.y) * 1600 + std::lround(pixel.x)] - settings.ambient_grey;
  };
  // The wall is y = 0, the base plate z = 10: the source's image under it is 20 - z. In the wall at
  // height h.
  for (const double h : {18.0, 25.0, 32.0}) {
    const Eigen::Vector3d image_normal(normal.x(), normal.y(), -normal.z());
    const Eigen::Vector3d image_source(source.x(), source.y(), 20 - source.z());
    Eigen::Vector3d ghost(0, 0, h), direct(0, 0, h);
    ghost.x() = image_source.x() - (image_normal.y() * (0 - image_source.y()) +
                                    image_normal.z() * (h - image_source.z())) /
                                       image_normal.x();
    direct.x() =
        source.x() - (normal.y() * (0 - source.y()) + normal.z() * (h - source.z())) / normal.x();
    CHECK((ghost - direct).norm() > 4);
    const cv::Point2d at_ghost = expected.pixel(ghost), at_direct = expected.pixel(direct);
    CAPTURE(h, at_ghost.x, at_ghost.y);
    const double share = grey_at(0.35, at_ghost) / grey_at(0.35, at_direct);
    CHECK(share > 0.08);
    CHECK(share < 0.36);
    CHECK(grey_at(0, at_ghost) < 0.01);
    CHECK(grey_at(0.35, at_ghost + cv::Point2d(0, 25)) < 0.01);
    CHECK(grey_at(0.35, at_ghost - cv::Point2d(0, 25)) < 0.01);
  }
  scene_settings.plate_specular_share = 0.35;
  const Scene scene = make_scene(scene_settings, SceneKind::workpiece, 3);
  // Its width: the sheet's and the gloss' 6 mrad over the way from plate to plate.
  {
    const double h = 30;
    const Eigen::Vector3d image_normal(normal.x(), normal.y(), -normal.z());
    const Eigen::Vector3d image_source(source.x(), source.y(), 20 - source.z());
    const auto ghost_at = [&](double height, double offset) {
      const double rest =
          image_normal.y() * image_source.y() - image_normal.z() * (height - image_source.z());
      return Eigen::Vector3d(image_source.x() + (rest + offset) / image_normal.x(), 0, height);
    };
    const Eigen::Vector3d ghost = ghost_at(h, 0);
    const Eigen::Vector3d mirrored_at =
        image_source + (ghost - image_source) * (10 - image_source.z()) / (h - image_source.z());
    const double sigma = std::hypot(0.2, 0.006 * (ghost - mirrored_at).norm());
    const cv::Point2d at = expected.pixel(ghost);
    const cv::Point2d along =
        expected.pixel(ghost_at(h + 1, 0)) - expected.pixel(ghost_at(h - 1, 0));
    const cv::Point2d across =
        (expected.pixel(ghost_at(h, 0.1)) - expected.pixel(ghost_at(h, -0.1))) * (1 / 0.2);
    // In a column: the sheet's width cut along v, and the blur on a line of this slope.
    const double slope = along.y / along.x;
    const double sheet = sigma * std::abs(across.y - across.x * slope);
    const double width = std::sqrt(sheet * sheet + (0.25 + 1.0 / 12) * (1 + slope * slope));
    const std::vector<float> grey =
        renderer.render_without_noise(scene, T_base_tool, {}, renderer.whole_image());
    double sum = 0, mean = 0, square = 0;
    const int u = static_cast<int>(std::lround(at.x)), v = static_cast<int>(std::lround(at.y));
    for (int dv = -20; dv <= 20; ++dv) {
      const double light = grey[(v + dv) * 1600 + u] - settings.ambient_grey;
      sum += light, mean += light * dv, square += light * dv * dv;
    }
    mean /= sum;
    CHECK(std::sqrt(square / sum - mean * mean) == Approx(width).epsilon(0.01));
    CHECK(v + mean == Approx(at.y + (u - at.x) * slope).margin(0.02));
  }
  int on_base = 0, on_upright = 0;
  for (const StripePoint& point : renderer.true_stripe(scene, T_base_tool, 1)) {
    if (!point.ghost) continue;
    on_base += scene.objects()[point.object].name == "base plate";
    on_upright += scene.objects()[point.object].name == "upright plate";
  }
  CHECK(on_base > 100);
  CHECK(on_upright > 100);
}
