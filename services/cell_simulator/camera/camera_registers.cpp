#include "services/cell_simulator/camera/camera_registers.hpp"

#include <arv.h>

#include <algorithm>

namespace arcstart::cell_simulator {

CameraRegisters::CameraRegisters(ArvFakeCamera* device) {
  using namespace camera_register;
  const auto read = [device](std::uint32_t address) {
    std::uint32_t value = 0;
    arv_fake_camera_read_register(device, address, &value);
    return value;
  };
  acquires = arv_fake_camera_get_control_channel_privilege(device) != 0 &&
             arv_fake_camera_get_acquisition_status(device) != 0;
  const bool output = read(kLineMode) == kOutput;
  laser_output_lit_in_exposure = output && read(kLineSource) == kExposureActive;
  laser_output_latched = output && read(kLineSource) == kUserOutput0 && read(kUserOutput) != 0;
  period =
      std::max<std::uint32_t>(read(ARV_FAKE_CAMERA_REGISTER_ACQUISITION_FRAME_PERIOD_US), 1000);
  exposure_us = read(ARV_FAKE_CAMERA_REGISTER_EXPOSURE_TIME_US);
  gain_db = read(ARV_FAKE_CAMERA_REGISTER_GAIN_RAW) / 100.0;
  region.width = static_cast<int>(read(ARV_FAKE_CAMERA_REGISTER_WIDTH));
  region.height = static_cast<int>(read(ARV_FAKE_CAMERA_REGISTER_HEIGHT));
  region.offset_x = static_cast<int>(read(ARV_FAKE_CAMERA_REGISTER_X_OFFSET));
  region.offset_y = static_cast<int>(read(ARV_FAKE_CAMERA_REGISTER_Y_OFFSET));
}

}  // namespace arcstart::cell_simulator
