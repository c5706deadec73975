// What a FANUC controller holds: numeric and position registers, frames, tools.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>

#include "services/cell_simulator/robot/fanuc_m20ia.hpp"

namespace arcstart::cell_simulator {

// Which way the arm reaches a position: FUT and no turns, as the simulated arm always does.
struct ArmConfiguration {
  int front = 1, up = 1, left = 0, flip = 1, turn4 = 0, turn5 = 0, turn6 = 0;
};

// A position register holds numbers alone: they are in the frame and tool that are active when an
// instruction reads them.
struct PositionRegister {
  XyzWpr position{};
  ArmConfiguration configuration{};
  int user_frame = 0, tool = 1;  // as they were written
};

struct ControllerMemory {
  static constexpr int kNumbers = 200, kPositions = 100, kFrames = 9, kTools = 10;
  mutable std::mutex mutex;                    // of all below
  std::array<double, kNumbers + 1> numbers{};  // from 1
  std::array<PositionRegister, kPositions + 1> positions{};
  std::array<XyzWpr, kFrames + 1> frames{};  // 0: World
  std::array<XyzWpr, kTools + 1> tools{};
};

}  // namespace arcstart::cell_simulator
