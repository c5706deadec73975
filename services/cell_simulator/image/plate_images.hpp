// The simulated sensor's images of a calibration plate: its print by daylight, and the stripe on
// it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "services/cell_simulator/image/image_renderer.hpp"

namespace arcstart::cell_simulator {

// Dark dots on white. Plate frame: origin in the first dot, x along a row, y from row to row, z
// into the plate; mm.
struct PrintedPlate {
  int columns = 5, rows = 9;
  double pitch_mm = 12;   // between rows; between columns too where not staggered, else half
  bool staggered = true;  // odd rows moved by one pitch
  double dot_radius_mm = 4;
  double margin_mm = 20;  // white about the outermost dots' middles
  double bend_mm = 0;     // a bulge along x, the middle this much nearer than the ends
};

// Middles of the dots, row by row, on the bent plate; mm.
std::vector<Eigen::Vector3d> dots(const PrintedPlate& plate);

// A lamp's reflection: saturated within a circle of the image.
struct Glare {
  Eigen::Vector2d centre = {0, 0};
  double radius_px = 0;
};

class PlateImages {
 public:
  PlateImages(const SensorSettings& settings, const PrintedPlate& plate);
  ~PlateImages();

  const TrueSensor& sensor() const { return renderer_.sensor(); }

  // Whether all dots, with a margin, and a stripe across the plate are in the image.
  bool shows_all(const RigidTransform& T_camera_plate) const;

  // What an exposure should be: paper light, but not white; the stripe likewise. us
  static constexpr double grid_exposure_us = 20000, laser_exposure_us = 1000;

  // width * height grey values, row by row. The same arguments give the same bytes.
  std::vector<std::uint8_t> grid(const RigidTransform& T_camera_plate, std::uint64_t seed,
                                 const Glare& glare = {},
                                 double exposure_us = grid_exposure_us) const;
  std::vector<std::uint8_t> laser(const RigidTransform& T_camera_plate, std::uint64_t seed,
                                  double exposure_us = laser_exposure_us);

 private:
  // Share of ink, 0 to 1, over each pixel; below 0 beside the plate.
  std::vector<float> ink(const RigidTransform& T_camera_plate) const;
  double height(double x) const;

  PrintedPlate plate_;
  SensorSettings settings_;
  ImageRenderer renderer_;
  Scene scene_;
  std::vector<Eigen::Vector2f> rays_;  // x, y on z = 1 that each pixel sees
};

}  // namespace arcstart::cell_simulator
