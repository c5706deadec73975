// A robot's controller, as the interface that every protocol stands behind: it carries out one
// access to a register or position at a time. Knows no LCM, and moves nothing.
#pragma once

#include <stdexcept>
#include <string>

#include "services/robot_link/handshake/registers.hpp"

namespace arcstart::robot_link {

// Why the controller cannot be spoken to: one line with what to look at.
class LinkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Used by one thread, but for end().
class ControllerLink {
 public:
  virtual ~ControllerLink() = default;

  // Connects anew, and holds the controller's frame and tool against the settings'. Throws
  // LinkError.
  virtual void connect() = 0;

  // Throws LinkError: then it is not known whether it was carried out, and connect() comes next.
  virtual Reading carry_out(const Operation& operation) = 0;

  // From any thread, for good: what waits ends with a LinkError.
  virtual void end() = 0;

  // For people: "RMI at 192.168.1.10:16001".
  virtual std::string description() const = 0;
};

}  // namespace arcstart::robot_link
