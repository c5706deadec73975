// What a message must satisfy beyond its type: finite numbers, counts and sizes that agree, states
// that exist. Each returns why the message has no meaning, empty where it has.
#pragma once

#include <arcstart/calibration_capture_t.hpp>
#include <arcstart/calibration_command_t.hpp>
#include <arcstart/calibration_t.hpp>
#include <arcstart/camera_command_t.hpp>
#include <arcstart/cell_command_t.hpp>
#include <arcstart/clock_probe_t.hpp>
#include <arcstart/delivery_t.hpp>
#include <arcstart/image_t.hpp>
#include <arcstart/profile_t.hpp>
#include <arcstart/robot_pose_t.hpp>
#include <arcstart/scan_command_t.hpp>
#include <arcstart/scan_t.hpp>
#include <arcstart/seam_t.hpp>
#include <arcstart/service_status_t.hpp>
#include <arcstart/stripe_t.hpp>
#include <arcstart/truth_t.hpp>
#include <string>

namespace arcstart {

std::string meaning_error(const image_t& message);
std::string meaning_error(const robot_pose_t& message);
std::string meaning_error(const stripe_t& message);
std::string meaning_error(const profile_t& message);
std::string meaning_error(const scan_t& message);
std::string meaning_error(const scan_command_t& message);
std::string meaning_error(const camera_command_t& message);
std::string meaning_error(const calibration_t& message);
std::string meaning_error(const calibration_command_t& message);
std::string meaning_error(const calibration_capture_t& message);
std::string meaning_error(const seam_t& message);
std::string meaning_error(const service_status_t& message);
std::string meaning_error(const cell_command_t& message);
std::string meaning_error(const clock_probe_t& message);
std::string meaning_error(const delivery_t& message);
std::string meaning_error(const truth_t& message);

}  // namespace arcstart
