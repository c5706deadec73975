#include "services/cell_simulator/camera/gige_camera.hpp"

#include <arpa/inet.h>
#include <arv.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "camera_features.hpp"
#include "common/time.hpp"
#include "services/cell_simulator/camera/temporary_file.hpp"

namespace arcstart::cell_simulator {
namespace {

constexpr std::uint16_t kControlPort = 3956;
// Slot to the first packet's sending, us: the copying is over by then.
constexpr std::int64_t kSend = 1'000;
// A frame asked for later than this after its slot, us, is none of a slot: the first of a stream.
constexpr std::int64_t kOffGrid = 20'000;

void sleep_until(std::int64_t utime) {
  const timespec when{utime / 1'000'000, utime % 1'000'000 * 1000};
  while (clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &when, nullptr) == EINTR) {
  }
}

sockaddr_in control_port_of(const std::string& interface_address) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(kControlPort);
  if (inet_pton(AF_INET, interface_address.c_str(), &address.sin_addr) != 1)
    throw GigeCameraError(interface_address +
                          ": not an IPv4 address: give camera_interface as in 127.0.0.1");
  return address;
}

// Aravis does not tell when it could not have the port.
void check_port(const sockaddr_in& address, const std::string& interface_address) {
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool free = bind(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  const std::string why = free ? "" : std::strerror(errno);
  ::close(probe);
  if (!free)
    throw GigeCameraError(
        interface_address + ":3956: " + why +
        ": is another camera simulated there, or is this no address of this machine?");
}

}  // namespace

GigeCamera::GigeCamera(const GigeCameraSettings& settings, Render render, Lose lose)
    : settings_(settings),
      lose_(std::move(lose)),
      renderer_(std::move(render), [this](std::int64_t now) { return upcoming(now); }) {}

GigeCamera::~GigeCamera() { close(); }

void GigeCamera::open() {
  const std::lock_guard control(control_mutex_);
  if (is_open()) return;
  const sockaddr_in control_port = control_port_of(settings_.interface_address);
  check_port(control_port, settings_.interface_address);
  const TemporaryFile features("arcstart-camera-", kCameraFeatures);
  ArvGvFakeCamera* camera = arv_gv_fake_camera_new_full(
      settings_.interface_address.c_str(), settings_.serial.c_str(), features.path().c_str());
  if (!arv_gv_fake_camera_is_running(camera)) {
    g_object_unref(camera);
    throw GigeCameraError(settings_.interface_address +
                          ": no network interface has this address: set camera_interface");
  }
  ArvFakeCamera* device = arv_gv_fake_camera_get_fake_camera(camera);
  const auto write = [device](std::uint32_t address, std::uint32_t value) {
    arv_fake_camera_write_register(device, address, value);
  };
  const auto width = static_cast<std::uint32_t>(settings_.width),
             height = static_cast<std::uint32_t>(settings_.height);
  write(ARV_FAKE_CAMERA_REGISTER_SENSOR_WIDTH, width);
  write(ARV_FAKE_CAMERA_REGISTER_SENSOR_HEIGHT, height);
  write(ARV_FAKE_CAMERA_REGISTER_WIDTH, width);
  write(ARV_FAKE_CAMERA_REGISTER_HEIGHT, height);
  write(ARV_FAKE_CAMERA_REGISTER_ACQUISITION_FRAME_PERIOD_US,
        static_cast<std::uint32_t>(1e6 / settings_.frame_rate));
  write(ARV_FAKE_CAMERA_REGISTER_EXPOSURE_TIME_US,
        static_cast<std::uint32_t>(Exposure().exposure_us));
  write(camera_register::kLineMode, camera_register::kOutput);
#if ARAVIS_CHECK_VERSION(0, 9, 0)
  arv_fake_camera_set_fill_pattern(device, &GigeCamera::fill, this, nullptr);
#else
  arv_fake_camera_set_fill_pattern(device, &GigeCamera::fill, this);
#endif
  watch_ = std::make_unique<ControllerWatch>(control_port);
  const std::lock_guard lock(mutex_);
  camera_ = camera;
  device_ = device;
}

void GigeCamera::close() {
  const std::lock_guard control(control_mutex_);
  ArvGvFakeCamera* camera = nullptr;
  ArvFakeCamera* device = nullptr;
  {
    const std::lock_guard lock(mutex_);
    std::swap(camera, camera_);
    std::swap(device, device_);
  }
  if (!camera) return;
  // Its thread runs until the last reference goes. Nothing may leave it any more: send() gives it
  // no image.
  g_object_set(camera, "gvsp-lost-ratio", 1.0, nullptr);
  arv_fake_camera_write_register(device, ARV_FAKE_CAMERA_REGISTER_ACQUISITION, 0);
  g_object_unref(camera);
}

bool GigeCamera::is_open() const {
  const std::lock_guard lock(mutex_);
  return camera_ != nullptr;
}

std::optional<CameraRegisters> GigeCamera::registers() const {
  const std::lock_guard lock(mutex_);
  return device_ ? std::optional<CameraRegisters>(device_) : std::nullopt;
}

SimulatedFrame GigeCamera::frame_of(std::int64_t slot, const CameraRegisters& registers) const {
  SimulatedFrame frame;
  frame.slot = slot;
  frame.start =
      slot + kSend + seconds_to_us(settings_.transport) - seconds_to_us(settings_.image_delay);
  frame.exposure = {registers.exposure_us, registers.gain_db,
                    registers.laser_output_lit_in_exposure || registers.laser_output_latched};
  frame.region = registers.region;
  return frame;
}

std::optional<SimulatedFrame> GigeCamera::upcoming(std::int64_t now) const {
  const auto set = registers();
  if (!set || !set->acquires || !set->region_fits(settings_.width, settings_.height))
    return std::nullopt;
  return frame_of((now / set->period + 1) * set->period, *set);
}

void GigeCamera::fill(ArvBuffer* buffer, void* self, std::uint32_t, std::uint32_t, std::uint32_t) {
  static_cast<GigeCamera*>(self)->send(buffer);
}

// On Aravis' camera thread, which sends the packets as soon as this returns.
void GigeCamera::send(ArvBuffer* buffer) {
  const std::int64_t asked = utime_now();
  ArvGvFakeCamera* camera = nullptr;
  std::optional<CameraRegisters> set;
  {
    const std::lock_guard lock(mutex_);
    if (!camera_) return;  // it is being closed
    camera = camera_;
    set.emplace(device_);
  }
  prctl(PR_SET_TIMERSLACK, 1000ul);  // ns; the frame's release is to be exact
  std::int64_t slot = asked - asked % set->period;
  if (asked - slot > kOffGrid) slot = asked;
  // The size as Aravis took it from the registers when it filled in the buffer's head; get_data's
  // size is 0 the first time.
  std::size_t size = 0;
  auto* grey = static_cast<std::uint8_t*>(const_cast<void*>(arv_buffer_get_data(buffer, &size)));
  SimulatedFrame frame = frame_of(slot, *set);
  if (set->region_fits(settings_.width, settings_.height) &&
      frame.region.width == arv_buffer_get_image_width(buffer) &&
      frame.region.height == arv_buffer_get_image_height(buffer))
    frame = renderer_.take(frame, grey);
  sleep_until(frame.slot + kSend);
  arv_buffer_set_timestamp(buffer, static_cast<guint64>(settings_.clock.nanoseconds(frame.start)));
  const bool lost = lose_ && lose_(frame);
  g_object_set(camera, "gvsp-lost-ratio", lost ? 1.0 : 0.0, nullptr);
  ++frames_;
}

void GigeCamera::tick(std::int64_t now) {
  const std::lock_guard control(control_mutex_);
  if (device_) watch_->tick(device_, now);
}

bool GigeCamera::laser_on() const {
  const auto set = registers();
  return set && (set->laser_output_latched || (set->laser_output_lit_in_exposure && set->acquires));
}

std::int64_t GigeCamera::frame_period() const {
  const auto set = registers();
  return set ? set->period : seconds_to_us(1 / settings_.frame_rate);
}

}  // namespace arcstart::cell_simulator
