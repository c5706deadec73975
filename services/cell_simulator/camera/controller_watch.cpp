#include "services/cell_simulator/camera/controller_watch.hpp"

#include <arv.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace arcstart::cell_simulator {
namespace {

constexpr std::int64_t kCheckPeriod = 100'000;  // us

}  // namespace

ControllerWatch::ControllerWatch(const sockaddr_in& control_port)
    : address_(control_port), socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  const timeval longest{0, 100'000};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
}

ControllerWatch::~ControllerWatch() { close(socket_); }

void ControllerWatch::tick(ArvFakeCamera* device, std::int64_t now) {
  if (now >= next_check_ || now < next_check_ - kCheckPeriod) {
    ask_for_heartbeat_check();
    next_check_ = now + kCheckPeriod;
  }
  look(device);
}

// Both registers are marked once seen, in bits that neither side minds: so a new controller and a
// new start are told from the old ones, whenever they come.
void ControllerWatch::look(ArvFakeCamera* device) {
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
void ControllerWatch::ask_for_heartbeat_check() {
  constexpr std::array<std::uint8_t, 12> kReadRegister = {0x42, 0x01, 0x00, 0x80, 0x00, 0x04,
                                                          0x00, 0x01, 0x00, 0x00, 0xa0, 0x00};
  std::array<std::uint8_t, 64> answer;
  while (recv(socket_, answer.data(), answer.size(), MSG_DONTWAIT) > 0) {  // late answers
  }
  sendto(socket_, kReadRegister.data(), kReadRegister.size(), 0,
         reinterpret_cast<const sockaddr*>(&address_), sizeof address_);
  recv(socket_, answer.data(), answer.size(), 0);
}

}  // namespace arcstart::cell_simulator
