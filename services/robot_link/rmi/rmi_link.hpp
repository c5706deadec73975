// A FANUC controller by RMI: one session, one request at a time. It never sends FRC_Initialize, so
// the motion group stays the pendant's and the robot's own program's.
#pragma once

#include <optional>
#include <string>

#include "common/tcp_connection.hpp"
#include "services/robot_link/controller_link.hpp"
#include "services/robot_link/rmi/rmi_text.hpp"

namespace arcstart::robot_link {

struct RmiLinkSettings {
  std::string address;
  int port = 16001;
  int first_number = 91;    // R[], the ten of Slot from here on
  int first_position = 91;  // PR[], the three of Place from here on
  int user_frame = 1;       // positions are in this frame; 0: World
  int tool = 1;
  XyzWpr frame_in_base{};   // what the controller must hold as UFRAME[user_frame]
  XyzWpr tool_in_flange{};  // likewise UTOOL[tool]
};

class RmiLink : public ControllerLink {
 public:
  explicit RmiLink(const RmiLinkSettings& settings) : settings_(settings) {}
  ~RmiLink() override;

  void connect() override;
  Reading carry_out(const Operation& operation) override;
  void end() override { connection_.end(); }
  std::string description() const override;

 private:
  void open(int port);
  RmiReply ask(const std::string& request, const std::string& name, int number = 0);
  std::string line(std::int64_t due, const std::string& owed);
  void check_frames();
  std::int32_t read_number(int number);

  RmiLinkSettings settings_;
  TcpConnection connection_;
  bool heard_ = false;              // anything on this connection
  std::string received_;            // not yet a line
  RmiConfiguration configuration_;  // of the positions of an answer: as the arm stood before it
};

}  // namespace arcstart::robot_link
