#include "tests/bench/calibration/calibration_mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "services/calibration/files/view_detection.hpp"
#include "services/calibration/solve/calibrate.hpp"

namespace arcstart::test {

using namespace calibration;
using namespace cell_simulator;
namespace {

// One image taken anew.
calibration::View rendered_view(PlateImages& images, const PrintedPlate& printed,
                                const calibration::View& view, const RigidTransform& T_camera_plate,
                                std::uint64_t seed, const Glare& glare) {
  auto grid = images.grid(T_camera_plate, seed, glare);
  auto laser = images.laser(T_camera_plate, seed);
  const int width = images.sensor().width, height = images.sensor().height;
  return calibration::detect_view({view.index, "", "", view.T_base_tool}, plate_of(printed),
                                  cv::Mat(height, width, CV_8U, grid.data()),
                                  cv::Mat(height, width, CV_8U, laser.data()));
}

}  // namespace

void run_mistakes(PlateImages& images, const PrintedPlate& printed,
                  const std::vector<RigidTransform>& poses,
                  const std::vector<calibration::View>& true_views, std::uint64_t seed,
                  std::vector<Mistake>& mistakes) {
  std::vector<calibration::View> views = true_views;
  for (calibration::View& view : views)
    view.T_base_tool = said_pose(view.T_base_tool, 0.1, 0.01, seed, view.index);
  const auto probes = probe_points(images.sensor());
  const std::size_t wrong = seed % views.size(), other = (wrong + 7) % views.size();
  const auto solve = [&](const std::vector<calibration::View>& with) {
    calibration::CalibrateOptions options;
    options.leave_one_out = false;
    return calibration::calibrate(plate_of(printed), with, images.sensor().width,
                                  images.sensor().height, options);
  };
  const auto error = [&](const calibration::CalibrationRun& run) {
    return end_to_end(run.adjustment.state.model, run.adjustment.state.T_tool_camera, probes);
  };
  const double clean = error(solve(views));
  for (Mistake& mistake : mistakes) {
    std::vector<calibration::View> with = views;
    const std::string name = mistake.name;
    if (name == "mislabelled") {
      with[wrong].T_base_tool = views[other].T_base_tool;
    } else if (name == "glared") {
      const Eigen::Vector2d beside = views[wrong].target[22] + Eigen::Vector2d(28, 18);
      with[wrong] = rendered_view(images, printed, views[wrong], poses[wrong], seed, {beside, 45});
    } else {
      // The plate lifted and put down the other way round, on the same place.
      RigidTransform turn = RigidTransform::Identity();
      turn.linear() = Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      turn.translation() = dots(printed).front() + dots(printed).back();
      with[wrong] = rendered_view(images, printed, views[wrong], poses[wrong] * turn, seed, {});
    }
    const calibration::CalibrationRun run = solve(with);
    const int index = views[wrong].index;
    const bool named =
        std::any_of(run.left_out.begin(), run.left_out.end(),
                    [&](const calibration::LeftOutView& view) { return view.index == index; });
    const double found = run.refused.empty() ? error(run) : 1e9;
    mistake.named += named;
    mistake.others += static_cast<int>(run.left_out.size()) - named;
    mistake.squares += found * found;
    mistake.clean += clean * clean;
    ++mistake.seeds;
    fmt::print("{:<16} {:>4} {:>9.4f} {:>9.4f} without it; {}\n", name, seed, found, clean,
               named ? "named" : "NOT NAMED");
  }
}

void report(const std::vector<Mistake>& mistakes, nlohmann::json& json) {
  for (const Mistake& mistake : mistakes) {
    const double over = std::sqrt(mistake.squares / std::max(1e-12, mistake.clean));
    fmt::print(
        "{:<16} {} seeds: named in {}, {} other views left out, error {:.3f} times the clean "
        "set's\n",
        mistake.name, mistake.seeds, mistake.named, mistake.others, over);
    const std::string row = mistake.name;
    json[row + ".n"] = mistake.seeds;
    json[row + ".named"] = mistake.named;
    json[row + ".others_left_out"] = mistake.others;
    json[row + ".e2e_over_clean"] = over;
  }
}

}  // namespace arcstart::test
