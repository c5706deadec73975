#include "tests/command_line/support/case_truth.hpp"

#include <yaml-cpp/yaml.h>

#include <vector>

namespace arcstart::test {
namespace {

using Numbers = std::vector<double>;

Eigen::Vector3d vector_of(const YAML::Node& node) {
  return Eigen::Vector3d(node.as<Numbers>().at(0), node.as<Numbers>().at(1),
                         node.as<Numbers>().at(2));
}

}  // namespace

CaseTruth read_case_truth(const std::string& path) {
  const YAML::Node root = YAML::LoadFile(path);
  CaseTruth truth;
  Calibration& calibration = truth.calibration;
  calibration.sensor = "LASER0";
  calibration.robot = "ROBOT0";
  calibration.tool = "TCP1";
  calibration.made = 1'699'999'000'000'000;  // us, before the scans
  calibration.origin = "truth of a rendered case";
  SensorModel& sensor = calibration.sensor_model;
  sensor.width = root["image"]["width"].as<int>();
  sensor.height = root["image"]["height"].as<int>();
  const YAML::Node camera = root["camera"];
  sensor.fx = camera["fx"].as<double>();
  sensor.fy = camera["fy"].as<double>();
  sensor.cx = camera["cx"].as<double>();
  sensor.cy = camera["cy"].as<double>();
  const auto distortion = camera["distortion_k1k2p1p2k3"].as<Numbers>();
  for (std::size_t i = 0; i < sensor.distortion.size(); ++i)
    sensor.distortion[i] = distortion.at(i);
  // Written with ten digits.
  const YAML::Node plane = root["laser_plane_in_camera"];
  const double length = vector_of(plane).norm();
  sensor.laser_plane = {vector_of(plane) / length, plane.as<Numbers>().at(3) / length};
  const YAML::Node hand_eye = root["hand_eye_camera_to_tool"];
  const auto q = hand_eye["quaternion_wxyz"].as<Numbers>();
  calibration.T_tool_camera = make_transform(
      vector_of(hand_eye["translation"]), Eigen::Quaterniond(q.at(0), q.at(1), q.at(2), q.at(3)));
  calibration.time_offset = -1e-6 * root["image"]["delay_us"].as<double>();
  if (root["joint"]) {
    truth.joint = root["joint"]["kind"].as<std::string>();
    truth.a = vector_of(root["seam"]["a"]);
    truth.b = vector_of(root["seam"]["b"]);
  }
  return truth;
}

}  // namespace arcstart::test
