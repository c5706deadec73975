// The cell's calibration file:
//
//     # arcstart calibration
//     id: 0123456789abcdef          fingerprint() of every byte after this line
//     sensor: LASER0
//     robot: ROBOT0
//     tool: TCP1
//     made: 1750000000000000        us, UTC
//     origin: "how it was made"
//     width: 1600                   full sensor; px
//     height: 1200
//     camera_matrix: [fx, fy, cx, cy]
//     distortion: [k1, k2, p1, p2, k3]
//     laser_plane: [nx, ny, nz, d]  in camera; d in mm
//     camera_position: [x, y, z]    in tool; mm
//     camera_quaternion: [w, x, y, z]
//     time_offset: -0.02732         s
//     camera_residual: -1           px, -1 where not known
//     laser_plane_residual: -1      mm
//     hand_eye_residual: -1         mm
//     verdict: passed               passed or failed
//     limits: [c, l, o, e, p, r]    that it was judged by, -1 for none: camera (px), laser plane,
//                                   leave-one-out, predicted, robot's positions (mm), orientations
//                                   (rad)
//     poses: 20                     that were used, -1 where not known
//     forced_by: "name"             who put a failed one into use, empty: nobody
//     covariance: [...]             19 rows of 19, row by row, as calibration_t orders them; may be
//                                   left out
//
// The four keys from verdict on stand together or not at all, as in files made before there were
// any: such a set is not judged.
// Camera, laser plane and hand-eye are one set: the id tells when a part of it was exchanged by
// hand.
#pragma once

#include <string>

#include "common/calibration.hpp"
#include "common/input_error.hpp"

namespace arcstart::calibration {

// "calibration.yaml:9: calibration.camera_matrix: must be a list of 4 numbers".
class CalibrationFileError : public InputError {
 public:
  using InputError::InputError;
};

// The calibration that a file's whole text says; name stands in errors. Every key but the
// verdict's four and the covariance must be there, once, of its type and possible, and the id must
// fit. Throws CalibrationFileError and nothing else, whatever the bytes.
Calibration parse_calibration(const std::string& text, const std::string& name);

// Reads and parses. Throws CalibrationFileError.
Calibration read_calibration_file(const std::string& path);

// The whole text of a calibration's file; its id is made here, that of `calibration` ignored.
std::string calibration_file_text(const Calibration& calibration);

}  // namespace arcstart::calibration
