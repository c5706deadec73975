// Rendered calibration sets, small enough for tests: the simulated sensor's field of view with 800
// x 600 pixels.
#pragma once

#include "services/calibration/solve/calibrate.hpp"
#include "tests/bench/calibration/simulated_plate.hpp"

namespace arcstart::test {

using namespace calibration;
using namespace cell_simulator;

inline cell_simulator::SensorSettings small_sensor() {
  cell_simulator::SensorSettings settings;
  settings.image_width_px = 800;
  settings.image_height_px = 600;
  return settings;
}

struct SimulatedSet {
  explicit SimulatedSet(const cell_simulator::PrintedPlate& plate = {}, int count = 20,
                        std::uint64_t seed = 501, const PoseRange& range = {})
      : printed(plate),
        images(small_sensor(), plate),
        poses(draw_poses(images, plate, range, count, seed)),
        views(rendered_views(images, plate, poses, seed)) {}

  // With what an erring robot says.
  std::vector<View> said(double error_mm, double error_deg, std::uint64_t seed = 501) const {
    std::vector<View> result = views;
    for (View& view : result)
      view.T_base_tool = said_pose(view.T_base_tool, error_mm, error_deg, seed, view.index);
    return result;
  }

  Target plate() const { return plate_of(printed); }

  // RMS over the laser points at 270 to 330 mm, pixel to tool; mm.
  double end_to_end(const CalibrationRun& run) const {
    return test::end_to_end(run.adjustment.state.model, run.adjustment.state.T_tool_camera,
                            probe_points(images.sensor()));
  }

  cell_simulator::PrintedPlate printed;
  cell_simulator::PlateImages images;
  std::vector<RigidTransform> poses;
  std::vector<View> views;
};

// Made once: 20 poses spread as the advice asks.
inline const SimulatedSet& well_spread_set() {
  static const SimulatedSet set;
  return set;
}

inline CalibrationRun calibrated(const SimulatedSet& set, const std::vector<View>& views,
                                 bool leave_one_out = false) {
  CalibrateOptions options;
  options.leave_one_out = leave_one_out;
  return calibrate(set.plate(), views, set.images.sensor().width, set.images.sensor().height,
                   options);
}

}  // namespace arcstart::test
