// What robot_link and the robot's own program tell each other, whatever the controller: ten whole
// numbers and three positions. A number has one writer.
#pragma once

#include <array>
#include <cstdint>

#include "common/geometry.hpp"

namespace arcstart::robot_link {

enum class Slot {
  // Written by the robot's program.
  kRequest,    // number of its question, one higher each time, above 0; written last
  kJob,        // number of the job
  kPart,       // number of the workpiece
  kTaken,      // the request whose answer it has taken, and is about to act on
  kDone,       // the same, when it no longer needs it
  kRobotBeat,  // changes at least twice a second while the program runs
  // Written by robot_link.
  kLinkBeat,  // changes at least twice a second while all is well
  kStatus,    // Status
  kVerdict,   // kValid, or why there is no position: a refusal number
  kAnswer,    // the request that verdict and positions belong to; 0: they must not be used
};
inline constexpr int kSlots = 10;

// Positions of the tool in the job's frame.
enum class Place { kApproach, kStart, kEnd };
inline constexpr std::array kPlaces = {Place::kApproach, Place::kStart, Place::kEnd};
// By Place; T_frame_tool, mm.
struct Positions : std::array<RigidTransform, kPlaces.size()> {
  Positions() { fill(RigidTransform::Identity()); }
};

enum class Status : std::int32_t {
  kNotReady = 0,
  kReady = 1,
  kBusy = 2,       // the question was read, a scan is being started
  kScanning = 3,   // the scan runs: the robot moves along its search
  kScanEnded = 4,  // the answer is being worked out
  kAnswered = 5,   // kAnswer and kVerdict hold it
};

inline constexpr std::int32_t kValid = 1;  // verdict of an answer with positions

// One access to the controller.
struct Operation {
  enum class Kind { kReadNumber, kWriteNumber, kReadPosition, kWritePosition };
  Kind kind = Kind::kReadNumber;
  Slot slot = Slot::kRequest;                            // of a number
  std::int32_t number = 0;                               // to be written
  Place place = Place::kApproach;                        // of a position
  RigidTransform position = RigidTransform::Identity();  // to be written; T_frame_tool, mm

  static Operation read(Slot slot) { return {Kind::kReadNumber, slot}; }
  static Operation write(Slot slot, std::int32_t number) {
    return {Kind::kWriteNumber, slot, number};
  }
  static Operation read(Place place) { return {Kind::kReadPosition, Slot::kRequest, 0, place}; }
  static Operation write(Place place, const RigidTransform& position) {
    return {Kind::kWritePosition, Slot::kRequest, 0, place, position};
  }
};

// What a reading gave.
struct Reading {
  std::int32_t number = 0;
  RigidTransform position = RigidTransform::Identity();
};

}  // namespace arcstart::robot_link
