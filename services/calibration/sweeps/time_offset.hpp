// How much the images' stamps are late against the positions': from sweeps to and fro over flat
// faces, at two speeds. A face seen on the way there and on the way back lies in one place only if
// each stripe is carried by the position of its own instant. Speed tells time from place: a robot's
// play shifts what it sees by the same length at every speed, a time offset by a length that grows
// with it.
#pragma once

#include <string>
#include <vector>

#include "services/calibration/sweeps/flat_faces.hpp"
#include "services/calibration/sweeps/sweep_profiles.hpp"

namespace arcstart::calibration {

// One steady run over the faces.
struct SweepFinding {
  std::int64_t scan_id = 0;
  double speed_mm_s = 0;     // of the sensor
  double approach_mm_s = 0;  // of it, towards the face it tells most of; below 0 away from it
  int stripes = 0;
  double offset_s = 0, deviation_s = 0;  // as this sweep alone has it, faces as all have them
};

struct TimeOffset {
  std::string refused;                // why there is none, and what is missing
  std::vector<std::string> warnings;  // a line each
  double offset_s = 0;     // added to an image's time to look up the position: late images, below 0
  double deviation_s = 0;  // standard, with the robot's play not known better than 0.1 mm
  double play_mm = 0, play_deviation_mm = 0;  // by which what is seen is shifted along the motion
  double residual_mm = 0;  // RMS distance of the stripes' straight parts from the faces
  double unmended_mm = 0;  // the same with the offset of the calibration given
  double approach = 0;     // largest share of the motion that runs across a face
  std::vector<FlatFace> faces;
  std::vector<SweepFinding> sweeps;
  int stripes = 0;
};

// calibration: camera, laser plane and hand-eye as they are; the offset is looked for within 0.15 s
// of its own.
TimeOffset find_time_offset(const SweepData& record, const Calibration& calibration);

// The set with the offset found and its variance, without an id.
Calibration with_time_offset(const Calibration& calibration, const TimeOffset& found);

}  // namespace arcstart::calibration
