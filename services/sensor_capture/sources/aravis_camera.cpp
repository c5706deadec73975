#include "services/sensor_capture/sources/aravis_camera.hpp"

#include <arv.h>
#include <fmt/core.h>

#include <chrono>

namespace arcstart::sensor_capture {
namespace {

constexpr std::uint32_t kHeartbeatRegister = 0x938;  // GigE Vision: timeout in ms
constexpr std::uint32_t kPrivilegeRegister = 0xa00;  // GigE Vision: who controls the camera

// Takes the error of a call of Aravis' and throws it.
class Call {
 public:
  explicit Call(std::string what) : what_(std::move(what)) {}
  ~Call() { g_clear_error(&error_); }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;
  operator GError**() { return &error_; }
  bool failed() const { return error_ != nullptr; }
  void check() const {
    if (error_) throw CameraError(fmt::format("{}: {}", what_, error_->message));
  }

 private:
  std::string what_;
  GError* error_ = nullptr;
};

// The device id of the camera that is meant by its address, serial number or id; empty for any.
std::string device_id(const std::string& wanted) {
  static std::once_flag gige_alone;
  std::call_once(gige_alone, [] {
    for (unsigned int i = 0; i < arv_get_n_interfaces(); ++i)
      if (std::string id = arv_get_interface_id(i); id != "GigEVision")
        arv_disable_interface(id.c_str());
  });
  arv_update_device_list();
  const auto matches = [&](const char* text) { return text != nullptr && wanted == text; };
  for (unsigned int i = 0; i < arv_get_n_devices(); ++i)
    if (wanted.empty() || matches(arv_get_device_address(i)) ||
        matches(arv_get_device_serial_nbr(i)) || matches(arv_get_device_id(i)))
      return arv_get_device_id(i);
  throw CameraError(
      fmt::format("{} found: check its power, its cable and network, and sensor_capture.camera",
                  wanted.empty() ? "no GigE Vision camera" : "camera '" + wanted + "' not"));
}

std::string text_of(const char* text) { return text ? text : ""; }

}  // namespace

AravisCamera::AravisCamera(const SensorCaptureSettings& settings, std::function<void()> notify)
    : settings_(settings),
      notify_(std::move(notify)),
      camera_(nullptr, g_object_unref),
      stream_(nullptr, g_object_unref) {
  connect();
  set_up();
  set_up_laser();
  start();
  heartbeat_ = std::thread([this] { keep_alive(); });
}

AravisCamera::~AravisCamera() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ended_.notify_all();
  if (heartbeat_.joinable()) heartbeat_.join();
  arv_stream_set_emit_signals(stream_.get(), FALSE);
  g_signal_handlers_disconnect_by_data(arv_camera_get_device(camera_.get()), this);
  g_signal_handlers_disconnect_by_data(stream_.get(), this);
  if (!trouble().empty()) return;
  try {
    switch_laser(false);
    arv_camera_stop_acquisition(camera_.get(), nullptr);
  } catch (const CameraError&) {  // unheard it stops exposing, and the laser with it
  }
}

void AravisCamera::connect() {
  const std::string id = device_id(settings_.camera);
  Call open("cannot open camera " + id);
  camera_.reset(arv_camera_new(id.c_str(), open));
  open.check();
  ArvCamera* camera = camera_.get();
  ArvDevice* device = arv_camera_get_device(camera);
  if (!arv_camera_is_gv_device(camera)) throw CameraError(id + " is not a GigE Vision camera");
  if (!arv_gv_device_is_controller(ARV_GV_DEVICE(device)))
    throw CameraError("another program controls camera " + id + ": end it");
  Call heartbeat("cannot set the heartbeat timeout of camera " + id);
  arv_device_write_register(device, kHeartbeatRegister,
                            static_cast<guint32>(settings_.heartbeat_ms), heartbeat);
  heartbeat.check();
  g_signal_connect_swapped(device, "control-lost", G_CALLBACK(+[](AravisCamera* self) {
                             self->give_up("control of the camera was lost");
                           }),
                           this);
  found_.description = fmt::format("{} at {}", id, [&] {
    auto* address = G_INET_SOCKET_ADDRESS(arv_gv_device_get_device_address(ARV_GV_DEVICE(device)));
    char* text = g_inet_address_to_string(g_inet_socket_address_get_address(address));
    std::string copy = text_of(text);
    g_free(text);
    return copy;
  }());
}

void AravisCamera::set_up() {
  ArvCamera* camera = camera_.get();
  const auto set = [&](const char* what, auto function, auto... values) {
    Call call(fmt::format("camera {}: {}", found_.description, what));
    function(camera, values..., call);
    call.check();
  };
  arv_camera_gv_set_stream_options(camera, settings_.packet_socket
                                               ? ARV_GV_STREAM_OPTION_NONE
                                               : ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
  arv_camera_gv_set_packet_size_adjustment(camera, ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
  set("packet size", arv_camera_gv_set_packet_size, settings_.packet_size_bytes);
  arv_camera_stop_acquisition(camera, nullptr);  // of whoever had it before
  set("pixel format", arv_camera_set_pixel_format, ARV_PIXEL_FORMAT_MONO_8);
  set("sensor size", arv_camera_get_sensor_size, &sensor_width_, &sensor_height_);
  const int width = settings_.region_width_px ? settings_.region_width_px : sensor_width_;
  const int height = settings_.region_height_px ? settings_.region_height_px : sensor_height_;
  if (settings_.region_offset_u_px + width > sensor_width_ ||
      settings_.region_offset_v_px + height > sensor_height_)
    throw CameraError(fmt::format("camera {}: the region does not lie on its sensor of {} x {}",
                                  found_.description, sensor_width_, sensor_height_));
  set("region", arv_camera_set_region, settings_.region_offset_u_px, settings_.region_offset_v_px,
      width, height);
  arv_camera_clear_triggers(camera, nullptr);
  arv_camera_set_acquisition_mode(camera, ARV_ACQUISITION_MODE_CONTINUOUS, nullptr);
  arv_camera_set_exposure_time_auto(camera, ARV_AUTO_OFF, nullptr);
  arv_camera_set_gain_auto(camera, ARV_AUTO_OFF, nullptr);
  set("frame rate", arv_camera_set_frame_rate, settings_.frame_rate_hz);
  Call rate("frame rate");
  const double frame_rate = arv_camera_get_frame_rate(camera, rate);
  if (!rate.failed() && frame_rate > 0)
    found_.shortest_period_us = static_cast<std::int64_t>(0.95e6 / frame_rate);
}

void AravisCamera::set_up_laser() {
  found_.wired_laser = settings_.laser_line.empty();
  if (!found_.wired_laser) {
    const auto available = [&](const char* feature) {
      return arv_camera_is_feature_available(camera_.get(), feature, nullptr);
    };
    if (!available("LineSelector") || !available("LineSource"))
      throw CameraError(fmt::format(
          "camera {} has no digital output with a source: where the laser follows its exposure by "
          "wire, set sensor_capture.laser_line to ''",
          found_.description));
    Call call(fmt::format("camera {}: LineSelector {}", found_.description, settings_.laser_line));
    arv_camera_set_string(camera_.get(), "LineSelector", settings_.laser_line.c_str(), call);
    call.check();
    switch_laser(false);
    if (available("LineMode")) {
      Call mode(fmt::format("camera {}: LineMode Output", found_.description));
      arv_camera_set_string(camera_.get(), "LineMode", "Output", mode);
      mode.check();
    }
  }
  in_force_ = {-1, -1, false};
  in_force_ = apply({settings_.exposure_us, settings_.gain_db, false});
  found_.settings = in_force_;
}

void AravisCamera::start() {
  ArvCamera* camera = camera_.get();
  Call create("cannot receive from camera " + found_.description);
  stream_.reset(arv_camera_create_stream(camera, nullptr, nullptr, create));
  create.check();
  g_object_set(stream_.get(), "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED,
               "socket-buffer-size", settings_.socket_buffer_bytes, nullptr);
  Call size("payload of camera " + found_.description);
  const guint payload = arv_camera_get_payload(camera, size);
  size.check();
  for (int i = 0; i < settings_.buffers; ++i)
    arv_stream_push_buffer(stream_.get(), arv_buffer_new_allocate(payload));
  g_signal_connect_swapped(stream_.get(), "new-buffer",
                           G_CALLBACK(+[](AravisCamera* self) { self->notify_(); }), this);
  arv_stream_set_emit_signals(stream_.get(), TRUE);
  Call begin("cannot start camera " + found_.description);
  arv_camera_start_acquisition(camera, begin);
  begin.check();
}

CameraSettings AravisCamera::apply(const CameraSettings& settings) {
  ArvCamera* camera = camera_.get();
  const bool new_exposure = settings.exposure_us != in_force_.exposure_us;
  const bool new_gain = settings.gain_db != in_force_.gain_db;
  Call call("camera " + found_.description);
  const auto refuse_outside = [&](auto bounds, double value, const char* what, const char* unit) {
    double low = 0, high = 0;
    bounds(camera, &low, &high, call);
    call.check();
    if (value < low || value > high)
      throw CameraRefusal(fmt::format("{} of {} {}: camera {} can do {} to {} {}", what, value,
                                      unit, found_.description, low, high, unit));
  };
  if (new_exposure)
    refuse_outside(arv_camera_get_exposure_time_bounds, settings.exposure_us, "exposure", "us");
  if (new_gain) refuse_outside(arv_camera_get_gain_bounds, settings.gain_db, "gain", "dB");

  // Dark first, lit last: never lit under settings that were not asked for.
  if (!settings.laser_on && in_force_.laser_on) switch_laser(false);
  if (new_exposure) {
    arv_camera_set_exposure_time(camera, settings.exposure_us, call);
    call.check();
    in_force_.exposure_us = arv_camera_get_exposure_time(camera, call);
    call.check();
  }
  if (new_gain) {
    arv_camera_set_gain(camera, settings.gain_db, call);
    call.check();
    in_force_.gain_db = arv_camera_get_gain(camera, call);
    call.check();
  }
  if (settings.laser_on && !in_force_.laser_on) switch_laser(true);
  return in_force_;
}

void AravisCamera::switch_laser(bool on) {
  if (!found_.wired_laser) {
    const std::string& source = on ? settings_.laser_on_source : settings_.laser_off_source;
    Call call(fmt::format("camera {}: LineSource {}", found_.description, source));
    arv_camera_set_string(camera_.get(), "LineSource", source.c_str(), call);
    call.check();
  }
  in_force_.laser_on = on;
}

// Aravis' own heartbeat comes once a second, too seldom for a timeout that keeps the laser dark.
void AravisCamera::keep_alive() {
  const auto interval = std::chrono::milliseconds(settings_.heartbeat_ms / 10);
  ArvDevice* device = arv_camera_get_device(camera_.get());
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, interval, [this] { return ending_ || !trouble_.empty(); })) {
    lock.unlock();
    guint32 privilege = 0;
    Call call("the camera does not answer");
    arv_device_read_register(device, kPrivilegeRegister, &privilege, call);
    if (call.failed()) give_up("the camera does not answer");
    lock.lock();
  }
}

std::string AravisCamera::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

void AravisCamera::give_up(const std::string& why) {
  {
    const std::lock_guard lock(mutex_);
    if (trouble_.empty()) trouble_ = why;
  }
  ended_.notify_all();
  notify_();
}

}  // namespace arcstart::sensor_capture
