#include "services/cell_simulator/gige_camera.hpp"

#include <arpa/inet.h>
#include <arv.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "camera_features.hpp"
#include "common/time.hpp"
#include "services/cell_simulator/temporary_file.hpp"

namespace arcstart {
namespace {

constexpr std::uint16_t kControlPort = 3956;
constexpr std::int64_t kSend =
    1'000;  // slot to the first packet's sending: the copying is over by then; us
constexpr std::int64_t kOffGrid =
    20'000;  // a frame asked for later is not the slot's (the first of a stream); us
constexpr std::int64_t kCheckPeriod = 100'000;  // us

// Registers beside Aravis' own; camera_features.xml names them.
constexpr std::uint32_t kLineMode = 0xa004, kLineSource = 0xa008, kUserOutput = 0xa010;
constexpr std::uint32_t kOutput = 1, kExposureActive = 1, kUserOutput0 = 2;

void sleep_until(std::int64_t utime) {
  const timespec when{utime / 1'000'000, utime % 1'000'000 * 1000};
  while (clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &when, nullptr) == EINTR) {
  }
}

sockaddr_in address_of(const std::string& interface_address, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  if (inet_pton(AF_INET, interface_address.c_str(), &address.sin_addr) != 1)
    throw CameraError(interface_address +
                      ": not an IPv4 address: give camera_interface as in 127.0.0.1");
  return address;
}

// Aravis does not tell when it could not have the port.
void check_port(const std::string& interface_address) {
  const sockaddr_in address = address_of(interface_address, kControlPort);
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool free = bind(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  const std::string why = free ? "" : std::strerror(errno);
  ::close(probe);
  if (!free)
    throw CameraError(
        interface_address + ":3956: " + why +
        ": is another camera simulated there, or is this no address of this machine?");
}

}  // namespace

// What the client has set, at one instant.
struct GigeCamera::Registers {
  bool acquires, laser_output_lit_in_exposure, laser_output_latched;
  std::int64_t period;
  double exposure_us, gain_db;
  ImageRegion region;

  explicit Registers(ArvFakeCamera* device) {
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

  bool region_fits(int width, int height) const {
    return region.width > 0 && region.height > 0 && region.offset_x >= 0 && region.offset_y >= 0 &&
           region.width <= width - region.offset_x && region.height <= height - region.offset_y;
  }
};

GigeCamera::GigeCamera(const GigeCameraSettings& settings, Render render, Lose lose)
    : settings_(settings),
      lose_(std::move(lose)),
      check_socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)),
      renderer_(std::move(render), [this](std::int64_t now) { return upcoming(now); }) {
  const timeval longest{0, 100'000};
  setsockopt(check_socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
}

GigeCamera::~GigeCamera() {
  close();
  ::close(check_socket_);
}

void GigeCamera::open() {
  const std::lock_guard control(control_mutex_);
  if (is_open()) return;
  check_port(settings_.interface_address);
  const TemporaryFile features("arcstart-camera-", kCameraFeatures);
  ArvGvFakeCamera* camera = arv_gv_fake_camera_new_full(
      settings_.interface_address.c_str(), settings_.serial.c_str(), features.path().c_str());
  if (!arv_gv_fake_camera_is_running(camera)) {
    g_object_unref(camera);
    throw CameraError(settings_.interface_address +
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
  write(kLineMode, kOutput);
#if ARAVIS_CHECK_VERSION(0, 9, 0)
  arv_fake_camera_set_fill_pattern(device, &GigeCamera::fill, this, nullptr);
#else
  arv_fake_camera_set_fill_pattern(device, &GigeCamera::fill, this);
#endif
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

std::optional<GigeCamera::Registers> GigeCamera::registers() const {
  const std::lock_guard lock(mutex_);
  return device_ ? std::optional<Registers>(device_) : std::nullopt;
}

Frame GigeCamera::frame_of(std::int64_t slot, const Registers& registers) const {
  Frame frame;
  frame.slot = slot;
  frame.start =
      slot + kSend + seconds_to_us(settings_.transport) - seconds_to_us(settings_.image_delay);
  frame.exposure = {registers.exposure_us, registers.gain_db,
                    registers.laser_output_lit_in_exposure || registers.laser_output_latched};
  frame.region = registers.region;
  return frame;
}

std::optional<Frame> GigeCamera::upcoming(std::int64_t now) const {
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
  std::optional<Registers> set;
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
  Frame frame = frame_of(slot, *set);
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
  if (!device_) return;
  if (now >= next_check_ || now < next_check_ - kCheckPeriod) {
    ask_for_heartbeat_check();
    next_check_ = now + kCheckPeriod;
  }
  watch_controller(device_);
}

// As a real camera does that loses its controller: the next one finds it at rest. Aravis would go
// on sending to the old one's address as soon as a new one is there. Both registers are marked once
// seen, in bits that neither side minds: so a new controller and a new start are told from the old
// ones, whenever they come.
void GigeCamera::watch_controller(ArvFakeCamera* device) {
  constexpr std::uint32_t kSeen = 0x10000;
  const std::uint32_t controller = arv_fake_camera_get_control_channel_privilege(device);
  std::uint32_t acquisition = arv_fake_camera_get_acquisition_status(device);
  const auto set_acquisition = [&](std::uint32_t value) {
    acquisition = value;
    arv_fake_camera_write_register(device, ARV_FAKE_CAMERA_REGISTER_ACQUISITION, value);
  };
  if (controller == 0) {
    if (acquisition != 0) set_acquisition(0);
  } else if (!(controller & kSeen)) {
    if (acquisition & kSeen) {
      set_acquisition(0);
    } else if (acquisition != 0 && acquired_) {
      set_acquisition(0);
      ask_for_heartbeat_check();  // any packet lets Aravis notice, and forget the old address
      set_acquisition(1);
    }
    arv_fake_camera_set_control_channel_privilege(device, controller | kSeen);
  }
  acquired_ = acquisition != 0;
  if (acquired_ && !(acquisition & kSeen)) set_acquisition(acquisition | kSeen);
}

// Aravis looks for a controller's heartbeat only when a control packet comes: without one a killed
// client would have frames sent to it for ever. So one is sent: read a register (GVCP READREG_CMD)
// that nobody needs. Returns when it has been answered.
void GigeCamera::ask_for_heartbeat_check() {
  constexpr std::array<std::uint8_t, 12> kReadRegister = {0x42, 0x01, 0x00, 0x80, 0x00, 0x04,
                                                          0x00, 0x01, 0x00, 0x00, 0xa0, 0x00};
  const sockaddr_in address = address_of(settings_.interface_address, kControlPort);
  std::array<std::uint8_t, 64> answer;
  while (recv(check_socket_, answer.data(), answer.size(), MSG_DONTWAIT) > 0) {  // late answers
  }
  sendto(check_socket_, kReadRegister.data(), kReadRegister.size(), 0,
         reinterpret_cast<const sockaddr*>(&address), sizeof address);
  recv(check_socket_, answer.data(), answer.size(), 0);
}

bool GigeCamera::laser_on() const {
  const auto set = registers();
  return set && (set->laser_output_latched || (set->laser_output_lit_in_exposure && set->acquires));
}

std::int64_t GigeCamera::frame_period() const {
  const auto set = registers();
  return set ? set->period : seconds_to_us(1 / settings_.frame_rate);
}

}  // namespace arcstart
