// The calibration file: any bytes, as they are and under an id that fits them, give a calibration
// or a CalibrationFileError.
#include <cmath>
#include <cstdlib>
#include <string>

#include "common/configuration.hpp"
#include "services/calibration/files/calibration_file.hpp"

namespace {

void parse(const std::string& text) try {
  const arcstart::Calibration calibration =
      arcstart::calibration::parse_calibration(text, "fuzz.yaml");
  if (!calibration_error(calibration).empty()) std::abort();
} catch (const arcstart::calibration::CalibrationFileError&) {
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  parse(text);
  parse("id: " + arcstart::fingerprint(text) + "\n" + text);
  // A sound file, of which a part is foreign.
  const std::string half =
      "sensor: LASER0\nrobot: ROBOT0\ntool: TCP1\nmade: 1750000000000000\norigin: x\nwidth: "
      "1600\nheight: 1200\n"
      "camera_matrix: [2400, 2400, 800, 600]\nlaser_plane: [0, 0.6, -0.8, 240]\ncamera_position: "
      "[60, 5, 40]\n"
      "camera_quaternion: [0.5, 0.5, 0.5, 0.5]\ncamera_residual: -1\nlaser_plane_residual: -1\n"
      "hand_eye_residual: -1\ntime_offset: 0\ndistortion: " +
      text;
  parse("id: " + arcstart::fingerprint(half) + "\n" + half);
  return 0;
}
