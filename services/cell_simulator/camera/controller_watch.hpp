// Sees to it that no acquisition of the simulated camera outlives the client that started it.
#pragma once

#include <netinet/in.h>

#include <cstdint>

struct _ArvFakeCamera;

namespace arcstart::cell_simulator {

// As a real camera does that loses its controller: the laser is dark, and the next client finds it
// at rest. Aravis' own device side leaves both to its next control packet, and goes on sending to
// the old client's address once a new one is in control.
class ControllerWatch {
 public:
  explicit ControllerWatch(const sockaddr_in& control_port);
  ~ControllerWatch();
  ControllerWatch(const ControllerWatch&) = delete;
  ControllerWatch& operator=(const ControllerWatch&) = delete;

  // At least ten times a second, never from the camera's own thread. now: us.
  void tick(_ArvFakeCamera* device, std::int64_t now);

 private:
  void look(_ArvFakeCamera* device);
  void ask_for_heartbeat_check();

  sockaddr_in address_;
  int socket_;
  std::int64_t next_check_ = 0;
  bool acquired_ = false;  // at the last tick
};

}  // namespace arcstart::cell_simulator
