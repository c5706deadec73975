// What a client has written into the simulated camera.
#pragma once

#include <cstdint>

#include "services/cell_simulator/image/image_renderer.hpp"

struct _ArvFakeCamera;

namespace arcstart::cell_simulator {

// Registers beside Aravis' own; camera_features.xml names them.
namespace camera_register {
constexpr std::uint32_t kLineMode = 0xa004;    // 0 input, 1 output
constexpr std::uint32_t kLineSource = 0xa008;  // 0 off, 1 ExposureActive, 2 UserOutput0
constexpr std::uint32_t kUserOutput = 0xa010;
constexpr std::uint32_t kOutput = 1, kExposureActive = 1, kUserOutput0 = 2;
}  // namespace camera_register

struct CameraRegisters {
  explicit CameraRegisters(_ArvFakeCamera* device);  // as they are now

  bool acquires;                      // a client is in control and has started it
  bool laser_output_lit_in_exposure;  // Line1 drives the laser
  bool laser_output_latched;
  std::int64_t period;  // of frames; us
  double exposure_us, gain_db;
  ImageRegion region;

  bool region_fits(int width, int height) const {
    return region.width > 0 && region.height > 0 && region.offset_x >= 0 && region.offset_y >= 0 &&
           region.width <= width - region.offset_x && region.height <= height - region.offset_y;
  }
};

}  // namespace arcstart::cell_simulator
