// The image that the sensor takes of a scene: the laser's stripe with its ghosts, speckle and
// noise.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "services/cell_simulator/image/laser_fan.hpp"
#include "services/cell_simulator/image/sensor_camera.hpp"
#include "services/cell_simulator/scene/scene.hpp"

namespace arcstart::cell_simulator {

struct Exposure {
  double exposure_us = 2000;
  double gain_db = 0;
  bool laser_on = true;
};

// A part of the full sensor; px.
struct ImageRegion {
  int offset_x = 0, offset_y = 0, width = 0, height = 0;
};

// One point of the stripe's middle, without noise.
struct StripePoint {
  Eigen::Vector3d base;   // mm
  Eigen::Vector2d pixel;  // distorted, as seen
  bool visible;           // not hidden from the camera, whether inside the image or not
  bool ghost;             // second reflection
  int object;             // index in Scene::objects()
};

// Not for two threads at once; one renderer a thread.
class ImageRenderer {
 public:
  explicit ImageRenderer(const SensorSettings& settings);
  ~ImageRenderer();

  const TrueSensor& sensor() const { return sensor_; }
  ImageRegion whole_image() const { return {0, 0, sensor_.width, sensor_.height}; }

  // The image at the middle of the exposure. grey: region.width * region.height bytes, row by row.
  // The same arguments give the same bytes; the frame seed chooses speckle, noise and spatter.
  // Motion blur is left out: the stripe stands still in an image whose laser moves with the camera.
  // Throws std::invalid_argument where the region does not lie in the sensor.
  void render(const Scene& scene, const RigidTransform& T_base_tool, const Exposure& exposure,
              std::uint64_t frame_seed, std::uint8_t* grey, const ImageRegion& region);

  // The same before speckle, noise, saturation and rounding; ambient light included.
  std::vector<float> render_without_noise(const Scene& scene, const RigidTransform& T_base_tool,
                                          const Exposure& exposure, const ImageRegion& region);

  // The middle of the stripe and of its ghosts, about every `step_px`, whatever the camera sees of
  // it.
  std::vector<StripePoint> true_stripe(const Scene& scene, const RigidTransform& T_base_tool,
                                       double step_px) const;

 private:
  struct Buffers;
  void draw(const Scene& scene, const RigidTransform& T_base_tool, const Exposure& exposure,
            const ImageRegion& region);

  SensorSettings settings_;
  TrueSensor sensor_;
  double full_light_distance_;  // from the projector to where stripe_grey holds; mm
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace arcstart::cell_simulator
