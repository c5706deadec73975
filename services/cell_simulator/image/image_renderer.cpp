#include "services/cell_simulator/image/image_renderer.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <stdexcept>

#include "services/cell_simulator/image/arc_light.hpp"
#include "services/cell_simulator/image/scene_view.hpp"
#include "services/cell_simulator/image/sensor_noise.hpp"
#include "services/cell_simulator/image/stripe_canvas.hpp"

namespace arcstart::cell_simulator {
namespace {

// A stripe's image is drawn in strokes no longer than this share of the image's width, each of one
// brightness and width: 6 px in 1600.
constexpr double longest_stroke = 6.0 / 1600;
constexpr double least_ghost_share = 0.02;

// The sheet is as thick as its Gaussian: it is cast as thin layers, so that a stripe that runs off
// an edge or into a corner thins out from one side as a real one does. Layers `spacing` sigmas
// apart, each 0.6 of that thick, sum to the sheet's Gaussian within 0.2 %.
constexpr int layers = 5;
constexpr double spacing = 0.9, layer_sigma = 0.6 * spacing;

struct Layer {
  double offset;  // along the sheet's normal; sigmas
  double sigma;   // sigmas
  double weight;
};

std::array<Layer, layers> make_layers() {
  std::array<Layer, layers> result;
  double sum = 0;
  for (int i = 0; i < layers; ++i) {
    const double offset = (i - (layers - 1) / 2) * spacing;
    const double weight = std::exp(-offset * offset / (2 * (1 - layer_sigma * layer_sigma)));
    result[i] = {offset, layer_sigma, weight};
    sum += weight * layer_sigma;
  }
  for (Layer& layer : result) layer.weight /= sum;  // together they carry the sheet's light
  return result;
}

// Factor on the settings' grey levels.
double brightness(const SensorSettings& settings, const Exposure& exposure) {
  return exposure.exposure_us / settings.reference_exposure_us *
         std::pow(10, exposure.gain_db / 20);
}

// Patches of lighter and darker metal: values at the corners of 5 mm cells, blended; -1 to 1.
double mottle(const Eigen::Vector3d& p) {
  constexpr double cell_mm = 5;
  const Eigen::Array3d scaled = p.array() / cell_mm, corner = scaled.floor(), t = scaled - corner;
  const auto value = [&](int dx, int dy, int dz) {
    const auto n = [](double x) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
    };
    std::uint64_t h = n(corner.x() + dx) * 0x9e3779b97f4a7c15ull ^
                      n(corner.y() + dy) * 0xc2b2ae3d27d4eb4full ^
                      n(corner.z() + dz) * 0x165667b19e3779f9ull;
    h = (h ^ (h >> 31)) * 0xbf58476d1ce4e5b9ull;
    return static_cast<double>(h >> 40) * 0x1p-23 - 1;
  };
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    const int dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
    sum += (dx ? t.x() : 1 - t.x()) * (dy ? t.y() : 1 - t.y()) * (dz ? t.z() : 1 - t.z()) *
           value(dx, dy, dz);
  }
  return sum;
}

}  // namespace

struct ImageRenderer::Buffers {
  explicit Buffers(const SensorSettings& settings)
      : canvas(settings.optics_blur_px), arc(settings), noise(settings) {}
  StripeCanvas canvas;
  ArcLight arc;
  SensorNoise noise;
};

ImageRenderer::ImageRenderer(const SensorSettings& settings)
    : settings_(settings),
      sensor_(make_true_sensor(settings)),
      full_light_distance_(
          (Eigen::Vector3d(0, 0, settings.stand_off_mm) - sensor_.projector).norm()),
      buffers_(std::make_unique<Buffers>(settings)) {}

ImageRenderer::~ImageRenderer() = default;

void ImageRenderer::render(const Scene& scene, const RigidTransform& T_base_tool,
                           const Exposure& exposure, std::uint64_t frame_seed, std::uint8_t* grey,
                           const ImageRegion& region) {
  draw(scene, T_base_tool, exposure, region);
  buffers_->arc.add(buffers_->canvas, brightness(settings_, exposure), frame_seed, region.offset_x,
                    region.offset_y);
  buffers_->noise.read_out(
      buffers_->canvas, settings_.ambient_grey * brightness(settings_, exposure),
      std::pow(10, exposure.gain_db / 20), frame_seed, region.offset_x, region.offset_y, grey);
}

std::vector<float> ImageRenderer::render_without_noise(const Scene& scene,
                                                       const RigidTransform& T_base_tool,
                                                       const Exposure& exposure,
                                                       const ImageRegion& region) {
  draw(scene, T_base_tool, exposure, region);
  const auto ambient = static_cast<float>(settings_.ambient_grey * brightness(settings_, exposure));
  std::vector<float> grey;
  for (int row = 0; row < region.height; ++row)
    for (const float light : buffers_->canvas.light(row)) grey.push_back(light + ambient);
  return grey;
}

std::vector<StripePoint> ImageRenderer::true_stripe(const Scene& scene,
                                                    const RigidTransform& T_base_tool,
                                                    double step_px) const {
  const SceneView view(scene, sensor_, T_base_tool);
  std::vector<LitLine> lines = cast(scene, view.sheet(0));
  const std::vector<LitLine> ghosts = cast_mirrored(scene, lines, least_ghost_share);
  lines.insert(lines.end(), ghosts.begin(), ghosts.end());
  std::vector<StripePoint> points;
  for (const LitLine& line : lines)
    for (const SceneView::Point& point : view.follow(line, step_px))
      points.push_back({point.base, point.pixel, point.visible, line.ghost,
                        scene.triangles().object_of(line.triangle)});
  return points;
}

void ImageRenderer::draw(const Scene& scene, const RigidTransform& T_base_tool,
                         const Exposure& exposure, const ImageRegion& region) {
  if (region.offset_x < 0 || region.offset_y < 0 || region.width < 1 || region.height < 1 ||
      region.width > sensor_.width - region.offset_x ||
      region.height > sensor_.height - region.offset_y)
    throw std::invalid_argument("image region does not lie in the sensor");
  buffers_->canvas.clear(region.width, region.height);
  if (!exposure.laser_on) return;
  const SceneView view(scene, sensor_, T_base_tool);
  const Eigen::Vector2d corner(region.offset_x, region.offset_y);
  const double white = settings_.stripe_grey * brightness(settings_, exposure);
  const double sheet_sigma = settings_.sheet_sigma_mm;

  // A lit line with its light's share and the sheet's sigma along it, in strokes.
  const auto draw_line = [&](const LitLine& line, double weight, double sigma) {
    const std::vector<SceneView::Point> points = view.follow(line, longest_stroke * sensor_.width);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      SceneView::Point begin = points[i], end = points[i + 1];
      if (!begin.visible && !end.visible) continue;
      if (begin.visible != end.visible) {
        const SceneView::Point edge = view.edge_of_sight(begin, end, line);
        (begin.visible ? end : begin) = edge;
      }
      const Eigen::Vector3d middle = (begin.base + end.base) / 2;
      const Triangle& triangle = scene.triangles().triangle(line.triangle);
      const double slant = line.sheet_normal.dot(triangle.normal);
      if (1 - slant * slant < 1e-3) continue;  // the sheet lies in the surface
      // One mm across the sheet leads this far along the surface, and so far in the image.
      const Eigen::Vector3d across =
          (line.sheet_normal - slant * triangle.normal) / (1 - slant * slant);
      const auto ahead = view.pixel(middle + 0.1 * across),
                 behind = view.pixel(middle - 0.1 * across);
      if (!ahead || !behind) continue;
      const Eigen::Vector2d px_per_mm = (*ahead - *behind) / 0.2, way = end.pixel - begin.pixel;
      const double across_px_per_mm =
          std::abs(px_per_mm.x() * way.y() - px_per_mm.y() * way.x()) / way.norm();

      const double along = (middle - line.begin).norm() / (line.end - line.begin).norm();
      const double spread = line.spread_begin + along * (line.spread_end - line.spread_begin);
      const double widened = std::hypot(sigma, spread);
      const Surface& surface = scene.surface_at(line.triangle, middle);
      const Eigen::Vector3d to_source = line.source - middle;
      const double distance = to_source.norm();
      const double incidence = std::abs(triangle.normal.dot(to_source)) / distance;
      const double albedo =
          surface.albedo * (surface.mottling > 0 ? 1 + surface.mottling * mottle(middle) : 1);
      const double peak = white * albedo * incidence * (full_light_distance_ / distance) *
                          line.share * weight * sigma / widened;
      buffers_->canvas.add({begin.pixel - corner, end.pixel - corner, widened * across_px_per_mm,
                            peak, surface.speckle * settings_.speckle_contrast});
    }
  };
  static const std::array<Layer, layers> sheet_layers = make_layers();
  for (const Layer& layer : sheet_layers) {
    const std::vector<LitLine> direct = cast(scene, view.sheet(layer.offset * sheet_sigma));
    for (const LitLine& line : direct) draw_line(line, layer.weight, layer.sigma * sheet_sigma);
    if (layer.offset != 0) continue;
    // Ghosts are weak and wide: one layer does.
    for (const LitLine& line : cast_mirrored(scene, direct, least_ghost_share))
      draw_line(line, 1, sheet_sigma);
  }
}

}  // namespace arcstart::cell_simulator
