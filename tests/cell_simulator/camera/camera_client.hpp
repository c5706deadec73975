// A GigE Vision client for tests: Aravis, set up for the loopback.
#pragma once

#include <arv.h>

#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <vector>

namespace arcstart::cell_simulator {

struct ReceivedFrame {
  std::uint64_t id;
  std::int64_t device_ns;      // leader's stamp
  std::int64_t arrival_utime;  // first packet; us
  int offset_x, offset_y, width, height;
  std::vector<std::uint8_t> grey;
};

class CameraClient {
 public:
  CameraClient() { reconnect(); }
  void reconnect() {
    camera_ = arv_camera_new("127.0.0.1", nullptr);
    if (!camera_) return;
    arv_camera_gv_set_stream_options(camera_, ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
    arv_camera_gv_set_packet_size_adjustment(camera_, ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
    arv_camera_gv_set_packet_size(camera_, 8192, nullptr);
  }
  ~CameraClient() {
    if (stream_) stop();
    g_clear_object(&camera_);
  }
  CameraClient(const CameraClient&) = delete;
  CameraClient& operator=(const CameraClient&) = delete;

  ArvCamera* get() const { return camera_; }  // null where there was none to be had

  void set(const char* feature, const char* value) const {
    GError* error = nullptr;
    arv_camera_set_string(camera_, feature, value, &error);
    INFO(feature);
    REQUIRE(error == nullptr);
  }
  void light_the_laser() const {
    set("LineSelector", "Line1");
    set("LineMode", "Output");
    set("LineSource", "ExposureActive");
  }

  void start() {
    stream_ = arv_camera_create_stream(camera_, nullptr, nullptr, nullptr);
    REQUIRE(stream_);
    g_object_set(stream_, "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED, "socket-buffer-size",
                 4 << 20, "packet-resend", ARV_GV_STREAM_PACKET_RESEND_NEVER, nullptr);
    const auto size = static_cast<std::size_t>(arv_camera_get_payload(camera_, nullptr));
    for (int i = 0; i < 8; ++i) arv_stream_push_buffer(stream_, arv_buffer_new(size, nullptr));
    arv_camera_start_acquisition(camera_, nullptr);
  }
  void stop() {
    arv_camera_stop_acquisition(camera_, nullptr);
    g_clear_object(&stream_);
  }

  // The next complete frame; the first after a start may lack packets, like on a real line.
  ReceivedFrame next() const {
    for (int tries = 0; tries < 100; ++tries) {
      ArvBuffer* buffer = arv_stream_timeout_pop_buffer(stream_, 10'000'000);
      REQUIRE(buffer);
      const bool complete = arv_buffer_get_status(buffer) == ARV_BUFFER_STATUS_SUCCESS;
      ReceivedFrame frame{};
      if (complete) {
        std::size_t size = 0;
        const auto* grey = static_cast<const std::uint8_t*>(arv_buffer_get_data(buffer, &size));
        frame = {arv_buffer_get_frame_id(buffer),
                 static_cast<std::int64_t>(arv_buffer_get_timestamp(buffer)),
                 static_cast<std::int64_t>(arv_buffer_get_system_timestamp(buffer) / 1000),
                 arv_buffer_get_image_x(buffer),
                 arv_buffer_get_image_y(buffer),
                 arv_buffer_get_image_width(buffer),
                 arv_buffer_get_image_height(buffer),
                 {grey, grey + size}};
      }
      arv_stream_push_buffer(stream_, buffer);
      if (complete) return frame;
    }
    FAIL("no complete frame");
    return {};
  }

 private:
  ArvCamera* camera_ = nullptr;
  ArvStream* stream_ = nullptr;
};

}  // namespace arcstart::cell_simulator
