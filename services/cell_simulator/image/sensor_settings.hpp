// The simulated laser-stripe sensor as it was built: camera, lens, laser and how it is mounted.
#pragma once

#include <array>

#include "common/configuration.hpp"

namespace arcstart::cell_simulator {

// The keys are a part of section `cell_simulator` of cell.yaml. Focal length and principal point
// are those of the 1600 x 1200 sensor: a smaller image has larger pixels and the same field of
// view.
struct SensorSettings {
  int image_width_px = 1600;
  int image_height_px = 1200;
  double focal_length_px = 2400;
  std::array<double, 2> principal_point_px{807.3, 594.6};  // pixel centres at integers
  std::array<double, 5> distortion{-0.1, 0, 0, 0, 0};      // k1, k2, p1, p2, k3 (Brown)

  double stand_off_mm = 300;  // along the optical axis to where the laser plane cuts it
  double lean_deg =
      38;  // optical axis from the vertical, over the joint's open side, in the taught poses
  double laser_angle_deg = 22;  // between the laser plane and the optical axis
  double laser_roll_deg =
      0.6;  // of the laser plane about the optical axis: no projector sits quite straight
  double fan_angle_deg = 46;    // the fan's full opening
  double sheet_sigma_mm = 0.2;  // thickness of the laser sheet

  // T_tool_camera, the true hand-eye: position and turns about the tool's fixed x, y, z in this
  // order.
  std::array<double, 3> camera_in_tool_mm{61.3, 118.7, -93.4};
  std::array<double, 3> camera_in_tool_deg{4.2, 31.5, -83.1};

  double reference_exposure_us = 2000;  // at which the grey levels below hold, with 0 dB of gain
  double stripe_grey = 320;             // peak on a white surface hit squarely at the stand-off
  double ambient_grey = 4;              // with the laser off
  double optics_blur_px = 0.5;          // sigma of the lens's point spread
  double speckle_contrast = 0.15;       // standard deviation over mean, within the stripe
  double electrons_per_grey = 39;       // shot noise, at 0 dB
  double read_noise_grey = 2;           // at 0 dB

  // An arc that burns close by, with the laser on or off.
  double arc_grey = 0;  // of its glare in the middle, where it saturates; 0: no arc
  std::array<double, 2> arc_place_share{0.5, 0.04};  // of the image's width and height
  int spatter_streaks = 0;  // of spatter in flight, in each frame, anywhere
  int glowing_drops = 0;    // of spatter that has come down, likewise

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("image_width_px", image_width_px, between(64, 4096));
    visitor("image_height_px", image_height_px, between(64, 4096));
    visitor("focal_length_px", focal_length_px, between(100, 100000));
    visitor("principal_point_px", principal_point_px);
    visitor("distortion", distortion);
    visitor("stand_off_mm", stand_off_mm, between(20, 3000));
    visitor("lean_deg", lean_deg, between(-80, 80));
    visitor("laser_angle_deg", laser_angle_deg, between(2, 80));
    visitor("laser_roll_deg", laser_roll_deg, between(-45, 45));
    visitor("fan_angle_deg", fan_angle_deg, between(1, 150));
    visitor("sheet_sigma_mm", sheet_sigma_mm, between(0.01, 5));
    visitor("camera_in_tool_mm", camera_in_tool_mm);
    visitor("camera_in_tool_deg", camera_in_tool_deg);
    visitor("reference_exposure_us", reference_exposure_us, positive());
    visitor("stripe_grey", stripe_grey, not_negative());
    visitor("ambient_grey", ambient_grey, not_negative());
    visitor("optics_blur_px", optics_blur_px, between(0, 20));
    visitor("speckle_contrast", speckle_contrast, between(0, 1));
    visitor("electrons_per_grey", electrons_per_grey, positive());
    visitor("read_noise_grey", read_noise_grey, between(0, 50));
    visitor("arc_grey", arc_grey, between(0, 10000));
    visitor("arc_place_share", arc_place_share);
    visitor("spatter_streaks", spatter_streaks, between(0, 1000));
    visitor("glowing_drops", glowing_drops, between(0, 1000));
  }
};

}  // namespace arcstart::cell_simulator
