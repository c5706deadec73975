// A calibration plate in the simulated cell: where it lies, from where to look at it, and what the
// sensor then sees.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "services/cell_simulator/image/plate_images.hpp"
#include "services/cell_simulator/scene/scene_settings.hpp"

namespace arcstart::cell_simulator {

class PlateView {
 public:
  // The plate lies where the taught work does, square to the sensor there but for a few degrees
  // and mm that follow from the seed.
  PlateView(const SensorSettings& sensor, const SceneSettings& scene, std::uint64_t seed);

  // T_base_tool of the n-th pose, n = 1, 2 ...: tilted 20 to 40 deg to all sides, rolled by up to
  // 90 deg, at 0.8 to 1.2 of the stand-off, all dots and the stripe in the image. Nothing where no
  // such pose can be reached.
  std::optional<RigidTransform> pose(
      int number, const std::function<bool(const RigidTransform& T_base_tool)>& reaches) const;

  // The image from there, of a part of the sensor; the plate alone, all else is dark. A new pose,
  // exposure or laser takes some tenths of a second; the image of before stands for those of a
  // moving arm, which nobody can use.
  void render(const RigidTransform& T_base_tool, bool moving, const Exposure& exposure,
              const ImageRegion& region, std::uint8_t* grey);

 private:
  SensorSettings settings_;
  PrintedPlate plate_;
  PlateImages images_;
  std::uint64_t seed_;
  RigidTransform T_base_plate_;

  std::vector<std::uint8_t> last_;  // whole image, of:
  RigidTransform last_pose_ = RigidTransform::Identity();
  Exposure last_exposure_;
  std::uint64_t taken_ = 0;
};

}  // namespace arcstart::cell_simulator
