#include "services/calibration/capture/capture_dataset.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "services/calibration/capture/image_quality.hpp"
#include "services/calibration/files/target_file.hpp"
#include "services/calibration/files/view_detection.hpp"
#include "services/calibration/report/calibration_report.hpp"
#include "services/calibration/solve/calibration_result.hpp"

namespace arcstart::calibration {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kFewestToLocate = 3;

std::string image_path(const std::string& folder, const char* kind, int index) {
  return fmt::format("{}/{}/{:04}.png", folder, kind, index);
}

void write_image(const std::string& path, const cv::Mat& grey) {
  bool written = false;
  try {
    written = cv::imwrite(path, grey);
  } catch (const cv::Exception&) {
  }
  if (!written) throw CalibrationSetError(path + ": cannot be written: is the disk full?");
}

// Images of a pose that was never written down, for the service was killed in between, are put
// aside.
void set_aside_images_without_pose(const std::string& folder,
                                   const std::map<int, RigidTransform>& poses) {
  for (const char* kind : {"grid", "laser"})
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / kind)) {
      const std::string stem = entry.path().stem().string();
      const bool known = std::any_of(poses.begin(), poses.end(), [&](const auto& pose) {
        return stem == fmt::format("{:04}", pose.first);
      });
      if (!known && entry.path().extension() == ".png")
        fs::rename(entry.path(), entry.path().string() + ".without_pose");
    }
}

}  // namespace

CaptureDataset::CaptureDataset(const std::string& folder, const std::string& plate_file)
    : folder_(folder), plate_(read_target_file(plate_file)) {
  std::error_code error;
  fs::create_directories(fs::path(folder) / "grid", error);
  if (!error) fs::create_directories(fs::path(folder) / "laser", error);
  const fs::path copy = fs::path(folder) / "plate.yaml";
  if (!error && !fs::equivalent(plate_file, copy, error)) {
    error.clear();
    fs::copy_file(plate_file, copy, fs::copy_options::overwrite_existing, error);
  }
  if (error)
    throw CalibrationSetError(folder + ": cannot be written: " + error.message() +
                              ": give another folder in calibration.folder");
  const std::string poses_file = folder + "/poses.csv";
  const bool begun = fs::exists(poses_file);
  set_aside_images_without_pose(
      folder, begun ? read_poses_file(poses_file) : std::map<int, RigidTransform>{});
  if (!begun) return;
  for (const CalibrationPose& pose : read_calibration_set(folder).poses)
    look(pose, cv::imread(pose.grid, cv::IMREAD_GRAYSCALE),
         cv::imread(pose.laser, cv::IMREAD_GRAYSCALE));
  locate();
}

void CaptureDataset::add(const CapturedPose& captured) {
  const int index = poses_.empty() ? 1 : poses_.back().view.index + 1;
  const CalibrationPose pose{index, image_path(folder_, "grid", index),
                             image_path(folder_, "laser", index), captured.T_base_tool};
  write_image(pose.grid, captured.grid);
  write_image(pose.laser, captured.laser);
  look(pose, captured.grid, captured.laser);
  write_poses();
  locate();
}

bool CaptureDataset::discard(int index) {
  const auto chosen = [&](const KeptPose& pose) { return index == -1 || pose.view.index == index; };
  std::vector<int> gone;
  for (const KeptPose& pose : poses_)
    if (chosen(pose)) gone.push_back(pose.view.index);
  if (gone.empty()) return index == -1;
  std::erase_if(poses_, chosen);
  write_poses();  // first: an image without a pose is found by who reads the folder, and told
  for (const int i : gone)
    for (const char* kind : {"grid", "laser"}) fs::remove(image_path(folder_, kind, i));
  locate();
  return true;
}

void CaptureDataset::look(const CalibrationPose& pose, const cv::Mat& grid, const cv::Mat& laser) {
  KeptPose kept;
  if (grid.empty() || laser.empty() || grid.size() != laser.size() ||
      (!size_.empty() && grid.size() != size_)) {
    kept.view.index = pose.index;
    kept.view.T_base_tool = pose.T_base_tool;
    kept.view.unusable = "its images cannot be read, or are of another size than the first";
  } else {
    size_ = grid.size();
    kept.view = detect_view(pose, plate_, grid, laser);
    kept.view.unusable = image_trouble(kept.view, grid, laser);
  }
  poses_.push_back(std::move(kept));
}

// Written beside and renamed: a cut-off file would lose what is there.
void CaptureDataset::write_poses() const {
  const std::string path = folder_ + "/poses.csv", part = path + ".part";
  if (poses_.empty()) {
    fs::remove(path);
    return;
  }
  std::ofstream file(part);
  fmt::print(file, "index,x,y,z,qw,qx,qy,qz\n");
  for (const KeptPose& pose : poses_) {
    const Eigen::Vector3d place = pose.view.T_base_tool.translation();
    const Eigen::Quaterniond turn(pose.view.T_base_tool.linear());
    fmt::print(file, "{},{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f},{:.9f}\n", pose.view.index,
               place.x(), place.y(), place.z(), turn.w(), turn.x(), turn.y(), turn.z());
  }
  file.close();
  std::error_code error;
  if (file) fs::rename(part, path, error);
  if (!file || error) throw CalibrationSetError(path + ": cannot be written: is the disk full?");
}

std::vector<View> CaptureDataset::usable() const {
  std::vector<View> views;
  for (const KeptPose& pose : poses_)
    if (pose.view.unusable.empty()) views.push_back(pose.view);
  return views;
}

void CaptureDataset::locate() {
  for (KeptPose& pose : poses_) pose.T_camera_plate.reset();
  const std::vector<View> views = usable();
  if (views.size() < kFewestToLocate) return;
  try {
    const IntrinsicsStage camera = calibrate_camera(plate_, views, size_.width, size_.height);
    std::size_t next = 0;
    for (KeptPose& pose : poses_)
      if (pose.view.unusable.empty()) pose.T_camera_plate = camera.T_camera_plate[next++];
  } catch (const std::runtime_error&) {
    // Too alike yet to tell the camera.
  }
}

std::string CaptureDataset::advice() const {
  std::vector<RigidTransform> located;
  for (const KeptPose& pose : poses_)
    if (pose.T_camera_plate) located.push_back(*pose.T_camera_plate);
  if (located.size() < kFewestToLocate)
    return "tilt the plate by 20 to 40 deg, each time to another side";
  const auto wishes = diversity_advice(pose_diversity(located));
  return wishes.empty() ? "enough for a good calibration: solve" : wishes.front();
}

CalibrationRun CaptureDataset::solve() const {
  return calibrate(plate_, usable(), size_.width, size_.height);
}

std::string CaptureDataset::report(const CalibrationRun& run,
                                   const CalibrationLimits& limits) const {
  std::vector<View> views;
  for (const KeptPose& pose : poses_) views.push_back(pose.view);
  const auto both_images = [this](int index) {
    const cv::Mat grid = cv::imread(image_path(folder_, "grid", index), cv::IMREAD_GRAYSCALE),
                  laser = cv::imread(image_path(folder_, "laser", index), cv::IMREAD_GRAYSCALE);
    return grid.size() == laser.size() ? cv::Mat(cv::max(grid, laser)) : grid;
  };
  return calibration_report("Calibration of " + folder_, plate_, views, run, limits,
                            missed_limits(run, limits), "", both_images);
}

}  // namespace arcstart::calibration
