#include "services/calibration/files/calibration_file.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <random>

#include "common/bus/calibration_message.hpp"
#include "tests/calibration/support/sample_file.hpp"

using namespace arcstart;
using namespace arcstart::calibration;
using namespace arcstart::test;
using Catch::Matchers::Contains;

namespace {

// What parse_calibration says of a file, empty where it takes it.
std::string error_of(const std::string& text) {
  try {
    parse_calibration(text, "cal.yaml");
    return "";
  } catch (const CalibrationFileError& error) {
    return error.what();
  }
}

// A file with another content and the id that fits it.
std::string error_of_content(const std::string& old, const std::string& by) {
  return error_of(with_id(replaced(kContent, old, by)));
}

}  // namespace

TEST_CASE("a sound file is read to the last number") {
  const Calibration calibration = parse_calibration(with_id(kContent), "cal.yaml");
  CHECK(calibration.id == fingerprint(kContent));
  CHECK(calibration.sensor == "LASER0");
  CHECK(calibration.robot == "ROBOT0");
  CHECK(calibration.tool == "TCP1");
  CHECK(calibration.made == 1750000000000000);
  CHECK(calibration.origin == "simulator's truth");
  const SensorModel& model = calibration.sensor_model;
  CHECK(model.width == 1600);
  CHECK(model.height == 1200);
  CHECK(model.fx == 2400);
  CHECK(model.fy == 2401.5);
  CHECK(model.cx == 799.5);
  CHECK(model.cy == 599.5);
  CHECK(model.distortion == std::array<double, 5>{-0.1, 0.02, 0.0001, -0.0002, 0});
  CHECK(model.laser_plane.normal == Eigen::Vector3d(0, 0.928, -0.3725801927102405));
  CHECK(model.laser_plane.offset == 111.77405781307215);
  // w x y z = 1 -1 1 1 halves: 120 degrees about (-1, 1, 1) takes x to -z, y to -x, z to y.
  Eigen::Matrix3d rotation;
  rotation << 0, -1, 0, 0, 0, 1, -1, 0, 0;
  CHECK(calibration.T_tool_camera.linear().isApprox(rotation, 1e-12));
  CHECK(calibration.T_tool_camera.translation() == Eigen::Vector3d(60, 5, 40));
  CHECK(calibration.time_offset == -0.02732);
  CHECK(calibration.camera_residual == -1);
  CHECK(calibration.laser_plane_residual == 0.1);
  CHECK(calibration.hand_eye_residual == -1);
}

TEST_CASE("how a set was judged is read, and goes on to the bus and into the next file") {
  const std::string forced = replaced(replaced(kContent, "passed", "failed"), "forced_by: \"\"",
                                      "forced_by: \"R. Meyer\"");
  const Calibration calibration = parse_calibration(with_id(forced), "cal.yaml");
  const calibration_t sent = to_message(calibration);
  CHECK(sent.passed == calibration_t::FAILED);
  CHECK(sent.camera_limit == 1);
  CHECK(sent.laser_plane_limit == 0.15);
  CHECK(sent.leave_one_out_limit == 0.5);
  CHECK(sent.predicted_limit == 0.4);
  CHECK(sent.robot_position_limit == 1.5);
  CHECK(sent.robot_orientation_limit == 0.0035);
  CHECK(sent.poses == 20);
  CHECK(sent.forced_by == "R. Meyer");
  CHECK_THAT(distrust(calibration.verdict), Contains("failed") && Contains("R. Meyer"));
  const calibration_t again = to_message(
      parse_calibration(calibration_file_text(calibration_from_message(sent)), "again.yaml"));
  CHECK(again.passed == sent.passed);
  CHECK(again.robot_orientation_limit == sent.robot_orientation_limit);
  CHECK(again.predicted_limit == sent.predicted_limit);
  CHECK(again.poses == sent.poses);
  CHECK(again.forced_by == sent.forced_by);
  CHECK(distrust(parse_calibration(with_id(kContent), "cal.yaml").verdict).empty());

  CHECK_THAT(error_of_content("verdict: passed", "verdict: none"), Contains("passed or failed"));
  CHECK_THAT(error_of_content("forced_by: \"\"", "forced_by: \"R\""),
             Contains("only one that failed can be forced"));
  CHECK_THAT(error_of_content("0.15", "-0.15"), Contains("limit must not be below 0"));
  CHECK_THAT(error_of_content("poses: 20", "poses: -2"), Contains("number of poses"));
}

TEST_CASE("a file of before, without a verdict, is read as not judged") {
  const Calibration calibration =
      parse_calibration(with_id(replaced(kContent, kVerdict, "")), "cal.yaml");
  const calibration_t sent = to_message(calibration);
  CHECK(sent.passed == calibration_t::NOT_JUDGED);
  CHECK(sent.predicted_limit == -1);
  CHECK(sent.poses == -1);
  CHECK_THAT(distrust(calibration.verdict), Contains("no verdict"));
  CHECK(calibration_file_text(calibration).find("verdict") == std::string::npos);
}

TEST_CASE("any part changed by hand is told by the id") {
  const std::string sound = with_id(kContent);
  const std::pair<const char*, const char*> changes[] = {
      {"2400,", "2401,"},
      {"-0.1,", "-0.11,"},
      {"0.928", "0.9280"},
      {"60, 5", "60.1, 5"},
      {"-0.02732", "0.02732"},
      {"width: 1600", "width: 1601"},
      {"simulator's", "some one's"},
      {"TCP1", "TCP2"},
      {"hand_eye_residual: -1\n", "hand_eye_residual: -1\n\n"},
      {"verdict: passed", "verdict: failed"},
      {"forced_by: \"\"", "forced_by: \"R\""},
  };
  for (const auto& [old, by] : changes)
    CHECK_THAT(error_of(replaced(sound, old, by)),
               Contains("cal.yaml") && Contains("parts of it were changed by hand") &&
                   Contains("one set"));
  CHECK_THAT(error_of(replaced(sound, fingerprint(kContent), "0123456789abcdef")),
             Contains("changed by hand"));
  std::string windows;
  for (const char c : sound) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  CHECK(error_of(windows) != "");
}

TEST_CASE("nothing but comments stands before the id") {
  const std::string line = "id: " + fingerprint(kContent) + "\n";
  CHECK(error_of(line + kContent) == "");
  CHECK(error_of("# one\n\n# two\n" + line + kContent) == "");
  CHECK_THAT(error_of("time_offset: 0\n" + line + kContent), Contains("must be the first key"));
  CHECK_THAT(error_of(kContent), Contains("must be the first key"));
  CHECK_THAT(error_of(""), Contains("must be the first key"));
  CHECK_THAT(error_of("# only this"), Contains("must be the first key"));
  CHECK(error_of("id:") != "");
}

TEST_CASE("a key that is missing, unknown, twice there or of a wrong type is named with its line") {
  for (const char* key : {"sensor",
                          "robot",
                          "tool",
                          "made",
                          "origin",
                          "width",
                          "height",
                          "camera_matrix",
                          "distortion",
                          "laser_plane",
                          "camera_position",
                          "camera_quaternion",
                          "time_offset",
                          "camera_residual",
                          "laser_plane_residual",
                          "hand_eye_residual",
                          "verdict",
                          "limits",
                          "poses",
                          "forced_by"}) {
    const std::size_t begin = ("\n" + kContent).find(std::string("\n") + key + ":");
    std::string content = kContent;
    content.erase(begin, content.find('\n', begin) + 1 - begin);
    CHECK_THAT(error_of(with_id(content)), Contains(std::string(key) + ": is missing"));
    // Twice: the second hides in the same content.
    CHECK_THAT(error_of(with_id(kContent + key + ": 0\n")), Contains(key) && Contains("twice"));
  }
  CHECK_THAT(error_of(with_id(kContent + "colour: red\n")),
             Contains("cal.yaml:23: calibration.colour: unknown key"));
  CHECK_THAT(error_of_content("width: 1600", "width: wide"),
             Contains("cal.yaml:8: calibration.width: must be a whole number"));
  CHECK_THAT(error_of_content("width: 1600", "width: 1600.5"), Contains("whole number"));
  CHECK_THAT(error_of_content("made: 1750000000000000", "made: yesterday"),
             Contains("made: must be a time"));
  CHECK_THAT(error_of_content("made: 1750000000000000", "made: 99999999999999999999"),
             Contains("made: must be a time"));
  CHECK_THAT(error_of_content("made: 1750000000000000", "made: -5"), Contains("when it was made"));
  CHECK_THAT(error_of_content("[2400, 2401.5, 799.5, 599.5]", "[2400, 2401.5, 799.5]"),
             Contains("camera_matrix: must be a list of 4 numbers"));
  CHECK_THAT(error_of_content("[-0.1, 0.02, 0.0001, -0.0002, 0]", "[-0.1, 0.02, 0.0001, -0.0002]"),
             Contains("distortion: must be a list of 5 numbers"));
  CHECK_THAT(error_of_content("[60, 5, 40]", "60"),
             Contains("camera_position: must be a list of numbers"));
  CHECK_THAT(error_of_content("[60, 5, 40]", "[60, five, 40]"), Contains("camera_position"));
  CHECK_THAT(error_of_content("tool: TCP1", "tool: [TCP1]"), Contains("tool: must be a text"));
}

TEST_CASE("impossible numbers are refused though the id fits") {
  CHECK_THAT(error_of_content("2400,", ".nan,"), Contains("camera_matrix"));
  CHECK_THAT(error_of_content("2400,", ".inf,"), Contains("camera_matrix"));
  CHECK_THAT(error_of_content("2400,", "-2400,"), Contains("focal length"));
  CHECK_THAT(error_of_content("[-0.1,", "[-9,"), Contains("distortion folds the image"));
  CHECK_THAT(error_of_content("0.928", "0.929"), Contains("length 1"));
  CHECK_THAT(error_of_content("111.77405781307215", "0"), Contains("camera centre"));
  CHECK_THAT(error_of_content("[0.5, -0.5, 0.5, 0.5]", "[0.5, -0.5, 0.5, 0.51]"),
             Contains("camera_quaternion: must have length 1"));
  CHECK_THAT(error_of_content("[0.5, -0.5, 0.5, 0.5]", "[0, 0, 0, 0]"),
             Contains("camera_quaternion: must have length 1"));
  CHECK_THAT(error_of_content("[60, 5, 40]", "[60, 5, 4e9]"), Contains("camera's place"));
  CHECK_THAT(error_of_content("-0.02732", "-27.32"), Contains("time offset"));
  CHECK_THAT(error_of_content("laser_plane_residual: 0.1", "laser_plane_residual: -0.1"),
             Contains("residual"));
  CHECK_THAT(error_of_content("width: 1600", "width: 0"), Contains("image size"));
}

TEST_CASE("what is no YAML, or no map, is told in one line") {
  CHECK_THAT(error_of(with_id("sensor: [LASER0\n")), Contains("cal.yaml:") && Contains("not YAML"));
  CHECK_THAT(error_of(with_id("sensor: LASER0\n\trobot: x\n")), Contains("not YAML"));
  CHECK_THAT(error_of(std::string(100'000, '#')), Contains("longer than"));
  CHECK_THAT(error_of(with_id(std::string(5000, '['))), Contains("cal.yaml"));
  CHECK(error_of(std::string("id: \0\0", 6)) != "");
  for (const std::string& error :
       {error_of(with_id("sensor: [LASER0\n")), error_of(""), error_of(kContent)})
    CHECK(error.find('\n') == std::string::npos);
}

TEST_CASE("no damage of single bytes is taken, and none throws anything else") {
  const std::string sound = with_id(kContent);
  std::mt19937 random(1);
  for (int n = 0; n < 3000; ++n) {
    std::string damaged = sound;
    const std::size_t at = random() % damaged.size();
    const char byte = static_cast<char>(random() % 256);
    if (n % 3 == 0) damaged.erase(at, 1 + random() % 20);
    if (n % 3 == 1) damaged.insert(at, 1, byte);
    if (n % 3 == 2) damaged[at] = byte;
    const bool in_comment =
        std::mismatch(damaged.rbegin(), damaged.rend(), sound.rbegin(), sound.rend()).second -
            sound.rbegin() >=
        static_cast<long>(sound.size() - 23);
    if (damaged == sound || in_comment) continue;
    INFO(damaged);
    CHECK(error_of(damaged) != "");
  }
}

TEST_CASE("a file is read from disk, and one that is not there is told") {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / "arcstart_calibration_file_test.yaml";
  std::ofstream(path) << with_id(kContent);
  CHECK(read_calibration_file(path).id == fingerprint(kContent));
  std::ofstream(path) << "";
  CHECK_THROWS_WITH(read_calibration_file(path), Contains("must be the first key"));
  std::filesystem::remove(path);
  CHECK_THROWS_WITH(read_calibration_file(path), Contains(path.string()) &&
                                                     Contains("cannot be read") &&
                                                     Contains("calibration.file"));
  CHECK_THROWS_AS(read_calibration_file(std::filesystem::temp_directory_path()),
                  CalibrationFileError);
}

TEST_CASE("what is written is read again, covariance and all") {
  Calibration calibration = parse_calibration(with_id(kContent), "cal.yaml");
  constexpr int n = Calibration::kParameters;
  calibration.covariance.assign(n * n, 0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      calibration.covariance[static_cast<std::size_t>(i * n + j)] =
          (i == j ? 1.0 : 0.3) * (i + 1) * (j + 1) * 1e-3;
  calibration.origin = "a \"quoted\": origin # of\nlines";
  const Calibration again = parse_calibration(calibration_file_text(calibration), "new.yaml");
  CHECK(again.covariance == calibration.covariance);
  CHECK(again.origin == calibration.origin);
  CHECK(again.made == calibration.made);
  CHECK(again.sensor_model.fy == calibration.sensor_model.fy);
  CHECK(again.sensor_model.distortion == calibration.sensor_model.distortion);
  CHECK(again.T_tool_camera.isApprox(calibration.T_tool_camera, 1e-15));
  CHECK(again.id != calibration.id);

  // As the bus carries it.
  const calibration_t message = to_message(again);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, message.getEncodedSize());
  calibration_t received{};
  REQUIRE(received.decode(bytes.data(), 0, message.getEncodedSize()) > 0);
  CHECK(received.covariance_size == n);
  CHECK(received.covariance[2][5] == calibration.covariance[2 * n + 5]);
  CHECK(calibration_from_message(received).covariance == calibration.covariance);

  calibration.covariance[1] = 1;
  CHECK_THROWS_WITH(parse_calibration(calibration_file_text(calibration), "new.yaml"),
                    Contains("symmetric"));
  calibration.covariance.resize(18);
  CHECK_THROWS_WITH(parse_calibration(calibration_file_text(calibration), "new.yaml"),
                    Contains("19 rows"));
}
