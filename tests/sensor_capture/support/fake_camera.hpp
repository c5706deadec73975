// Aravis' own fake GigE Vision camera on 127.0.0.1, with a laser on a digital output and a clock of
// its own. Only inside a private network: it takes port 3956.
#pragma once

#include <arv.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>

#include "services/sensor_capture/frames/frame_source.hpp"
#include "services/sensor_capture/sensor_capture_settings.hpp"

namespace arcstart::test {

using namespace sensor_capture;

constexpr guint32 kLineMode = 0xa004, kLineSource = 0xa008;
constexpr guint32 kSourceOff = 0, kSourceExposureActive = 2;
constexpr std::uint8_t kLit = 200, kDark = 10;

class FakeCamera {
 public:
  // Its clock shows host time + clock_ahead_ns.
  static constexpr std::int64_t kClockAhead = 7'000'000'000'000;

  explicit FakeCamera(bool with_laser = true, const char* serial = "ARC01")
      : xml_("/tmp/arcstart_fake_camera_" + std::to_string(getpid()) + ".xml") {
    std::ofstream(xml_) << features(with_laser);
    camera_ = arv_gv_fake_camera_new_full("127.0.0.1", serial, xml_.c_str());
    if (!arv_gv_fake_camera_is_running(camera_))
      throw std::runtime_error("the fake camera does not run: is this a private network?");
    fake_ = arv_gv_fake_camera_get_fake_camera(camera_);
    write(ARV_FAKE_CAMERA_REGISTER_SENSOR_WIDTH, 320);
    write(ARV_FAKE_CAMERA_REGISTER_SENSOR_HEIGHT, 240);
    write(kLineSource, kSourceExposureActive);  // left on by somebody
    arv_fake_camera_set_fill_pattern(fake_, expose, this);
  }
  ~FakeCamera() {
    arv_fake_camera_set_fill_pattern(fake_, nullptr, nullptr);
    g_object_unref(camera_);
    unlink(xml_.c_str());
  }
  guint32 read(guint32 address) const {
    guint32 value = 0;
    arv_fake_camera_read_register(fake_, address, &value);
    return value;
  }
  void write(guint32 address, guint32 value) {
    arv_fake_camera_write_register(fake_, address, value);
  }
  void take_control_away() { arv_fake_camera_set_control_channel_privilege(fake_, 0); }
  void lose_packets(double share) { g_object_set(camera_, "gvsp-lost-ratio", share, nullptr); }
  std::atomic<int> frames{0};

 private:
  // Grey value: lit or dark. The first 8 bytes: when the exposure began, ns, UTC.
  static void expose(ArvBuffer* buffer, void* self, guint32, guint32, ArvPixelFormat) {
    auto& camera = *static_cast<FakeCamera*>(self);
    const std::int64_t now = std::chrono::duration_cast<std::chrono::nanoseconds>(
                                 std::chrono::system_clock::now().time_since_epoch())
                                 .count();
    std::size_t size = 0;
    auto* pixels =
        static_cast<std::uint8_t*>(const_cast<void*>(arv_buffer_get_data(buffer, &size)));
    size = static_cast<std::size_t>(camera.read(ARV_FAKE_CAMERA_REGISTER_WIDTH)) *
           camera.read(ARV_FAKE_CAMERA_REGISTER_HEIGHT);
    const bool lit = camera.read(kLineSource) == kSourceExposureActive;
    std::memset(pixels, lit ? kLit : kDark, size);
    std::memcpy(pixels, &now, sizeof now);
    arv_buffer_set_timestamp(buffer, static_cast<guint64>(now + kClockAhead));
    ++camera.frames;
  }

  static std::string features(bool with_laser) {
    ArvFakeCamera* stock = arv_fake_camera_new("stock");
    std::size_t size = 0;
    const char* text = arv_fake_camera_get_genicam_xml(stock, &size);
    std::string xml(text, size);
    g_object_unref(stock);
    if (!with_laser) return xml;
    const std::string laser = R"(
      <Category Name="DigitalIOControl" NameSpace="Standard">
        <pFeature>LineSelector</pFeature><pFeature>LineMode</pFeature><pFeature>LineSource</pFeature>
      </Category>
      <Enumeration Name="LineSelector" NameSpace="Standard">
        <EnumEntry Name="Line1" NameSpace="Standard"><Value>1</Value></EnumEntry>
        <pValue>LineSelectorRegister</pValue>
      </Enumeration>
      <IntReg Name="LineSelectorRegister" NameSpace="Custom">
        <Address>0xa000</Address><Length>4</Length><AccessMode>RW</AccessMode>
        <pPort>Device</pPort><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
      </IntReg>
      <Enumeration Name="LineMode" NameSpace="Standard">
        <EnumEntry Name="Input" NameSpace="Standard"><Value>0</Value></EnumEntry>
        <EnumEntry Name="Output" NameSpace="Standard"><Value>1</Value></EnumEntry>
        <pValue>LineModeRegister</pValue>
      </Enumeration>
      <IntReg Name="LineModeRegister" NameSpace="Custom">
        <Address>0xa004</Address><Length>4</Length><AccessMode>RW</AccessMode>
        <pPort>Device</pPort><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
      </IntReg>
      <Enumeration Name="LineSource" NameSpace="Standard">
        <EnumEntry Name="Off" NameSpace="Standard"><Value>0</Value></EnumEntry>
        <EnumEntry Name="UserOutput0" NameSpace="Standard"><Value>1</Value></EnumEntry>
        <EnumEntry Name="ExposureActive" NameSpace="Standard"><Value>2</Value></EnumEntry>
        <pValue>LineSourceRegister</pValue>
      </Enumeration>
      <IntReg Name="LineSourceRegister" NameSpace="Custom">
        <Address>0xa008</Address><Length>4</Length><AccessMode>RW</AccessMode>
        <pPort>Device</pPort><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess>
      </IntReg>)";
    const auto root = xml.find("<pFeature>TransportLayerControl</pFeature>");
    xml.insert(root, "<pFeature>DigitalIOControl</pFeature>\n");
    const auto port = xml.find("<Port Name=\"Device\"");
    xml.insert(port, laser);
    return xml;
  }

  std::string xml_;
  ArvGvFakeCamera* camera_;
  ArvFakeCamera* fake_;
};

// A part of the fake's sensor, at 25 frames a second.
inline SensorCaptureSettings settings_of_test() {
  SensorCaptureSettings settings;
  settings.frame_rate_hz = 25;
  settings.exposure_us = 5'000;
  settings.region_offset_u_px = 16;
  settings.region_offset_v_px = 8;
  settings.region_width_px = 160;
  settings.region_height_px = 120;
  return settings;
}

// When the fake says that the exposure began; ns, UTC.
inline std::int64_t exposure_begin(const Frame& frame) {
  std::int64_t begin;
  std::memcpy(&begin, frame.pixels.data(), sizeof begin);
  return begin;
}

inline std::uint8_t grey(const Frame& frame) { return frame.pixels.back(); }

}  // namespace arcstart::test
