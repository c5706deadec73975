// Refusal numbers that robot_link adds to those of seam_t, in the same hundreds by what helps: 1xx
// ask again, 3xx call whoever sets up, 4xx a device failed. Those of seam_t end at 149, 349, 449.
#pragma once

#include <cstdint>

namespace arcstart::robot_link {

inline constexpr std::int32_t kAskAgain = 151;      // robot_link was started anew meanwhile
inline constexpr std::int32_t kRobotSilent = 152;   // the robot's beat stood still
inline constexpr std::int32_t kNoScan = 153;        // the scan did not begin
inline constexpr std::int32_t kTooOld = 154;        // the answer was not taken in time
inline constexpr std::int32_t kSuperseded = 155;    // a later workpiece scan began
inline constexpr std::int32_t kNoAnswer = 156;      // no SEAM came after the scan's end
inline constexpr std::int32_t kTooUncertain = 157;  // its deviation is over the job's limit
inline constexpr std::int32_t kNoTorch = 158;       // no torch pose was determined
// 160 + n: found, and not usable for the reason n of seam_t.usable, START_NOT_SEEN .. CONTRADICTED
inline constexpr std::int32_t kNotUsable = 160;
inline constexpr std::int32_t kUnknownJob = 351;  // no job of that number
inline constexpr std::int32_t kOutOfBox = 352;    // a position lies outside the job's box
// 360 + n: likewise for CALIBRATION_FAILED, CLOCKS_APART
inline constexpr std::int32_t kNotUsableCall = 360;
inline constexpr std::int32_t kForeign = 371;   // an answer under this number of another question
inline constexpr std::int32_t kReadBack = 451;  // the controller holds other values than written
inline constexpr std::int32_t kCellNotReady = 452;  // a service that a scan needs is missing

}  // namespace arcstart::robot_link
