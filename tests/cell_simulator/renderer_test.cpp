#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>

#include "services/cell_simulator/image_renderer.hpp"

using namespace arcstart;

namespace {

// A flat square under the taught work, tilted about x and y by these slopes.
struct Floor {
  double slope_x, slope_y, height;
  Surface surface{0.4, 0, 1, 0, 0};
  double z(double x, double y) const { return height + slope_x * (x - 950) + slope_y * y; }
  SceneObject object() const {
    TriangleMesh mesh;
    for (const auto& [x, y] :
         {std::pair(550.0, -400.0), {1350.0, -400.0}, {1350.0, 400.0}, {550.0, 400.0}})
      mesh.corners.emplace_back(x, y, z(x, y));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return {"floor", mesh, surface};
  }
};

// What the sensor should show of a floor, by ways of its own: the line in which the laser's plane,
// moved by `offset` mm, cuts the floor, projected by OpenCV.
class Expected {
 public:
  Expected(const SensorSettings& settings, const TrueSensor& sensor,
           const RigidTransform& T_base_tool, const Floor& floor)
      : distortion_(settings.distortion),
        camera_matrix_(sensor.fx, 0, sensor.cx, 0, sensor.fy, sensor.cy, 0, 0, 1) {
    const RigidTransform T_base_camera = T_base_tool * sensor.T_tool_camera;
    T_camera_base_ = T_base_camera.inverse();
    laser_ = T_base_camera.linear() * sensor.laser_normal;
    laser_point_ = T_base_camera * Eigen::Vector3d(0, 0, settings.stand_off_mm);
    floor_ = Eigen::Vector3d(-floor.slope_x, -floor.slope_y, 1).normalized();
    floor_point_ = {950, 0, floor.height};
    projector_ = T_base_camera * sensor.projector;
  }
  // v at u = 0, 1, 2 ... of the stripe's middle.
  std::vector<double> columns(int width, double offset = 0) const {
    const Eigen::Vector3d along = laser_.cross(floor_).normalized();
    Eigen::Matrix<double, 3, 3> planes;
    planes << laser_.transpose(), floor_.transpose(), along.transpose();
    const Eigen::Vector3d middle =
        planes.inverse() * Eigen::Vector3d(laser_.dot(laser_point_) + offset,
                                           floor_.dot(floor_point_), along.dot(floor_point_));
    std::vector<cv::Point3d> points;
    for (double t = -250; t <= 250; t += 0.05) {
      const Eigen::Vector3d p = T_camera_base_ * (middle + t * along);
      points.emplace_back(p.x(), p.y(), p.z());
    }
    std::vector<cv::Point2d> pixels;
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), camera_matrix_, distortion_, pixels);
    if (pixels.front().x > pixels.back().x) std::reverse(pixels.begin(), pixels.end());
    std::vector<double> result;
    std::size_t at = 0;
    for (int u = 0; u < width; ++u) {
      while (pixels[at + 1].x < u) ++at;
      const double share = (u - pixels[at].x) / (pixels[at + 1].x - pixels[at].x);
      result.push_back(pixels[at].y + share * (pixels[at + 1].y - pixels[at].y));
    }
    return result;
  }
  const Eigen::Vector3d& floor_normal() const { return floor_; }
  const Eigen::Vector3d& projector() const { return projector_; }
  const Eigen::Vector3d& target() const { return laser_point_; }
  cv::Point2d pixel(const Eigen::Vector3d& base) const {
    const Eigen::Vector3d p = T_camera_base_ * base;
    std::vector<cv::Point2d> pixels;
    cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(), cv::Vec3d(),
                      camera_matrix_, distortion_, pixels);
    return pixels[0];
  }

 private:
  std::array<double, 5> distortion_;
  cv::Matx33d camera_matrix_;
  RigidTransform T_camera_base_;
  Eigen::Vector3d laser_, laser_point_, floor_, floor_point_, projector_;
};

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

      // Grey where the optical axis meets the laser plane at the stand-off: only the level floor
      // passes there.
      if (floor.slope_x == 0) {
        const cv::Point2d target = expected.pixel(expected.target());
        const int u = static_cast<int>(std::lround(target.x));
        const Moments seen = column(grey, width, u, settings.ambient_grey);
        const Eigen::Vector3d ray = (expected.target() - expected.projector()).normalized();
        const double incidence = std::abs(ray.dot(expected.floor_normal()));
        const double sheet_px = settings.sheet_sigma_mm * std::abs(ahead[u] - behind[u]) / 0.2;
        const double light = 320 * 0.4 * incidence * sheet_px * std::sqrt(2 * std::numbers::pi);
        CHECK(seen.sum == Approx(light).epsilon(0.01));
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
  int on_base = 0, on_upright = 0;
  for (const StripePoint& point : renderer.true_stripe(scene, T_base_tool, 1)) {
    if (!point.ghost) continue;
    on_base += scene.objects()[point.object].name == "base plate";
    on_upright += scene.objects()[point.object].name == "upright plate";
  }
  CHECK(on_base > 100);
  CHECK(on_upright > 100);
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
