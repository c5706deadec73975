#include "services/cell_simulator/image/plate_images.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "services/cell_simulator/base/random_stream.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr double paper_grey = 190, ink_grey = 25, beyond_grey = 55;
constexpr double shade = 0.12;        // the lamp's fall from one side of the image to the other
constexpr double paper_albedo = 0.8;  // to the laser
constexpr double ink_share = 0.35;    // of the paper's light that ink sends back, to the laser
constexpr double thickness_mm = 3;

double extent_x(const PrintedPlate& plate) {
  return plate.pitch_mm * (plate.staggered ? 2 * plate.columns - 1 : plate.columns - 1);
}
double extent_y(const PrintedPlate& plate) { return plate.pitch_mm * (plate.rows - 1); }

double bulge(const PrintedPlate& plate, double x) {
  const double share = 2 * x / extent_x(plate) - 1;
  return -plate.bend_mm * (1 - share * share);
}

// A slab whose face follows the bulge in strips.
SceneObject make_object(const PrintedPlate& plate) {
  const int strips = plate.bend_mm == 0 ? 1 : 64;
  const double left = -plate.margin_mm, right = extent_x(plate) + plate.margin_mm;
  const double top = -plate.margin_mm, bottom = extent_y(plate) + plate.margin_mm;
  TriangleMesh mesh;
  for (int i = 0; i <= strips; ++i) {
    const double x = left + (right - left) * i / strips;
    for (const double y : {top, bottom}) {
      mesh.corners.push_back({x, y, bulge(plate, x)});
      mesh.corners.push_back({x, y, thickness_mm});
    }
    if (i == 0) continue;
    // Corners of a strip: face and back at the top and at the bottom, before and here.
    const int a = 4 * (i - 1), b = 4 * i;
    for (const auto& t : {std::array{a, b + 2, b}, std::array{a, a + 2, b + 2},
                          std::array{a + 1, b + 1, b + 3}, std::array{a + 1, b + 3, a + 3}})
      mesh.triangles.push_back(t);
  }
  return {"calibration plate", std::move(mesh), {paper_albedo, 0.05, 1, 0, 0}};
}

std::uint8_t grey_level(double grey) {
  return static_cast<std::uint8_t>(std::clamp(grey, 0.0, 255.0) + 0.5);
}

}  // namespace

std::vector<Eigen::Vector3d> dots(const PrintedPlate& plate) {
  std::vector<Eigen::Vector3d> result;
  for (int row = 0; row < plate.rows; ++row)
    for (int column = 0; column < plate.columns; ++column) {
      const double x = plate.pitch_mm * (plate.staggered ? 2 * column + (row & 1) : column);
      result.push_back({x, plate.pitch_mm * row, bulge(plate, x)});
    }
  return result;
}

PlateImages::PlateImages(const SensorSettings& settings, const PrintedPlate& plate)
    : plate_(plate), settings_(settings), renderer_(settings), scene_({make_object(plate)}) {
  // The lens' inverse by fixed-point iteration on the radial factor.
  const TrueSensor& s = sensor();
  const auto& [k1, k2, p1, p2, k3] = s.distortion;
  rays_.reserve(std::size_t(s.width) * s.height);
  for (int v = 0; v < s.height; ++v)
    for (int u = 0; u < s.width; ++u) {
      const double xd = (u - s.cx) / s.fx, yd = (v - s.cy) / s.fy;
      double x = xd, y = yd;
      for (int i = 0; i < 12; ++i) {
        const double r2 = x * x + y * y, radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
        const double dx = 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                     dy = p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
        x = (xd - dx) / radial;
        y = (yd - dy) / radial;
      }
      rays_.push_back({static_cast<float>(x), static_cast<float>(y)});
    }
}

PlateImages::~PlateImages() = default;

double PlateImages::height(double x) const { return bulge(plate_, x); }

bool PlateImages::shows_all(const RigidTransform& T_camera_plate) const {
  constexpr double border = 12;  // px
  const TrueSensor& s = sensor();
  for (const Eigen::Vector3d& dot : dots(plate_))
    for (int i = 0; i < 4; ++i) {
      const double angle = i * EIGEN_PI / 2, reach = plate_.dot_radius_mm;
      const auto seen = see(
          s, T_camera_plate * (dot + reach * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)));
      if (!seen || seen->x() < border || seen->y() < border || seen->x() > s.width - border ||
          seen->y() > s.height - border)
        return false;
    }
  int lit = 0;
  for (const StripePoint& point :
       renderer_.true_stripe(scene_, T_camera_plate.inverse() * s.T_tool_camera.inverse(), 10))
    lit += point.visible && point.pixel.x() > 0 && point.pixel.y() > 0 &&
           point.pixel.x() < s.width && point.pixel.y() < s.height;
  return lit > 30;
}

std::vector<float> PlateImages::ink(const RigidTransform& T_camera_plate) const {
  const TrueSensor& s = sensor();
  const RigidTransform T_plate_camera = T_camera_plate.inverse();
  const Eigen::Vector3d eye = T_plate_camera.translation();
  const auto on_plate = [&](std::size_t pixel) -> Eigen::Vector2d {
    const Eigen::Vector3d way =
        T_plate_camera.linear() * Eigen::Vector3d(rays_[pixel].x(), rays_[pixel].y(), 1);
    double z = 0;
    Eigen::Vector2d at;
    for (int i = 0; i < (plate_.bend_mm == 0 ? 1 : 4); ++i) {
      at = eye.head<2>() + (z - eye.z()) / way.z() * way.head<2>();
      z = height(at.x());
    }
    return at;
  };
  const double blur = std::sqrt(settings_.optics_blur_px * settings_.optics_blur_px + 1.0 / 12);
  const double pitch = plate_.pitch_mm, margin = plate_.margin_mm;
  std::vector<float> result(rays_.size(), -1);
  std::vector<Eigen::Vector2d> above(static_cast<std::size_t>(s.width));
  for (int v = 0; v < s.height; ++v) {
    Eigen::Vector2d before = Eigen::Vector2d::Zero();
    for (int u = 0; u < s.width; ++u) {
      const std::size_t number = std::size_t(v) * s.width + u;
      const Eigen::Vector2d at = on_plate(number);
      Eigen::Matrix2d per_pixel;  // mm on the plate
      per_pixel.col(0) = at - before;
      per_pixel.col(1) = at - above[static_cast<std::size_t>(u)];
      before = above[static_cast<std::size_t>(u)] = at;
      if (at.x() < -margin || at.y() < -margin || at.x() > extent_x(plate_) + margin ||
          at.y() > extent_y(plate_) + margin)
        continue;
      // The nearest dot: of the row above and the row below, each its nearest.
      Eigen::Vector2d nearest(1e9, 1e9);
      for (int i = 0; i < 2; ++i) {
        const int row =
            std::clamp(static_cast<int>(std::floor(at.y() / pitch)) + i, 0, plate_.rows - 1);
        const double step = plate_.staggered ? 2 * pitch : pitch;
        const double first = plate_.staggered && (row & 1) ? pitch : 0;
        const int column = std::clamp(static_cast<int>(std::lround((at.x() - first) / step)), 0,
                                      plate_.columns - 1);
        const Eigen::Vector2d from = at - Eigen::Vector2d(first + column * step, row * pitch);
        if (from.squaredNorm() < nearest.squaredNorm()) nearest = from;
      }
      const double distance = nearest.norm() - plate_.dot_radius_mm;
      float share = distance < 0 ? 1 : 0;
      if (u > 0 && v > 0 && nearest.norm() > 0) {
        const double mm_per_px = (per_pixel.transpose() * nearest.normalized()).norm();
        const double edge = distance / mm_per_px / blur;  // blurs outside the dot
        if (std::abs(edge) < 5) share = static_cast<float>(0.5 * std::erfc(edge / std::sqrt(2.0)));
      }
      result[number] = share;
    }
  }
  return result;
}

std::vector<std::uint8_t> PlateImages::grid(const RigidTransform& T_camera_plate,
                                            std::uint64_t seed, const Glare& glare,
                                            double exposure_us) const {
  const TrueSensor& s = sensor();
  const std::vector<float> print = ink(T_camera_plate);
  static const std::vector<float> normals = [] {
    RandomStream random(0x706c617465ull);
    std::vector<float> result(1u << 20);
    for (float& value : result) value = static_cast<float>(random.normal());
    return result;
  }();
  std::vector<std::uint8_t> grey(print.size());
  RandomStream places(seed, 7);
  for (int v = 0; v < s.height; ++v) {
    const std::size_t place = places.next() % (normals.size() - static_cast<std::size_t>(s.width));
    for (int u = 0; u < s.width; ++u) {
      const std::size_t i = std::size_t(v) * s.width + u;
      const double lamp =
          exposure_us / grid_exposure_us * (1 + shade * (double(u) / s.width - 0.5));
      double level =
          lamp * (print[i] < 0 ? beyond_grey : paper_grey + (ink_grey - paper_grey) * print[i]);
      if ((Eigen::Vector2d(u, v) - glare.centre).norm() < glare.radius_px) level = 300;
      const double noise = std::sqrt(settings_.read_noise_grey * settings_.read_noise_grey +
                                     level / settings_.electrons_per_grey);
      grey[i] = grey_level(level + noise * normals[place + static_cast<std::size_t>(u)]);
    }
  }
  return grey;
}

std::vector<std::uint8_t> PlateImages::laser(const RigidTransform& T_camera_plate,
                                             std::uint64_t seed, double exposure_us) {
  const TrueSensor& s = sensor();
  const std::vector<float> print = ink(T_camera_plate);
  std::vector<std::uint8_t> grey(print.size());
  const Exposure exposure{exposure_us, 0, true};
  renderer_.render(scene_, T_camera_plate.inverse() * s.T_tool_camera.inverse(), exposure, seed,
                   grey.data(), renderer_.whole_image());
  const double ambient = settings_.ambient_grey * exposure_us / settings_.reference_exposure_us;
  for (std::size_t i = 0; i < grey.size(); ++i)
    if (print[i] > 0 && grey[i] > ambient)
      grey[i] = grey_level(ambient + (grey[i] - ambient) * (1 + (ink_share - 1) * print[i]));
  return grey;
}

}  // namespace arcstart::cell_simulator
