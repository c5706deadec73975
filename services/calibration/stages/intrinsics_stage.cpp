#include "services/calibration/stages/intrinsics_stage.hpp"

#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

#include "services/calibration/target/projection.hpp"

namespace arcstart::calibration {
namespace {

using Points = std::vector<cv::Point2d>;

cv::Mat camera_matrix(const SensorModel& model) {
  return (cv::Mat_<double>(3, 3) << model.fx, 0, model.cx, 0, model.fy, model.cy, 0, 0, 1);
}

cv::Mat distortion(const SensorModel& model) {
  cv::Mat result(1, 5, CV_64F);
  for (int i = 0; i < 5; ++i) result.at<double>(i) = model.distortion[static_cast<std::size_t>(i)];
  return result;
}

RigidTransform to_transform(const cv::Mat& turn, const cv::Mat& shift) {
  const Eigen::Vector3d axis(turn.at<double>(0), turn.at<double>(1), turn.at<double>(2));
  RigidTransform result = RigidTransform::Identity();
  if (axis.norm() > 0)
    result.linear() = Eigen::AngleAxisd(axis.norm(), axis.normalized()).toRotationMatrix();
  result.translation() =
      Eigen::Vector3d(shift.at<double>(0), shift.at<double>(1), shift.at<double>(2));
  return result;
}

std::vector<cv::Point3f> model_points(const Target& plate) {
  std::vector<cv::Point3f> result;
  for (const Eigen::Vector3d& point : plate.points())
    result.push_back({static_cast<float>(point.x()), static_cast<float>(point.y()), 0});
  return result;
}

Eigen::Vector2d seen_as(const SensorModel& model, const RigidTransform& pose,
                        const Eigen::Vector3d& point, double radius) {
  const std::array<double, 4> camera{model.fx, model.fy, model.cx, model.cy};
  return seen_centre<double>(camera.data(), model.distortion.data(),
                             {pose.linear(), pose.translation()}, point, radius);
}

// What was seen, as if each circle's centre had been seen instead of its ellipse's.
std::vector<cv::Point2f> without_bias(const SensorModel& model, const Target& plate,
                                      const RigidTransform& pose, const View& view) {
  std::vector<cv::Point2f> result;
  const std::vector<Eigen::Vector3d> points = plate.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d centre =
        view.target[i] + seen_as(model, pose, points[i], 0) -
        seen_as(model, pose, points[i], plate.radius(static_cast<int>(i)));
    result.push_back({static_cast<float>(centre.x()), static_cast<float>(centre.y())});
  }
  return result;
}

std::vector<cv::Point2f> as_seen(const View& view) {
  std::vector<cv::Point2f> result;
  for (const Eigen::Vector2d& point : view.target)
    result.push_back({static_cast<float>(point.x()), static_cast<float>(point.y())});
  return result;
}

}  // namespace

IntrinsicsStage calibrate_camera(const Target& plate, const std::vector<View>& views, int width,
                                 int height, const SensorModel* guess) {
  const int rounds = plate.has_circles() ? 4 : 1;
  IntrinsicsStage stage;
  stage.model.width = width;
  stage.model.height = height;
  if (guess) stage.model = *guess;
  const std::vector<std::vector<cv::Point3f>> objects(views.size(), model_points(plate));
  std::vector<std::vector<cv::Point2f>> images;
  for (const View& view : views) images.push_back(as_seen(view));
  cv::Mat camera = camera_matrix(stage.model), lens = distortion(stage.model);
  for (int round = 0; round < rounds; ++round) {
    std::vector<cv::Mat> turns, shifts;
    const int flags = cv::CALIB_FIX_K3 | (guess || round > 0 ? cv::CALIB_USE_INTRINSIC_GUESS : 0);
    try {
      cv::calibrateCamera(objects, images, {width, height}, camera, lens, turns, shifts, flags,
                          {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 60, 1e-10});
    } catch (const cv::Exception&) {
      throw std::runtime_error("no camera explains the images: are pattern, columns, rows right?");
    }
    SensorModel& model = stage.model;
    model.fx = camera.at<double>(0, 0);
    model.fy = camera.at<double>(1, 1);
    model.cx = camera.at<double>(0, 2);
    model.cy = camera.at<double>(1, 2);
    for (int i = 0; i < 5; ++i) model.distortion[static_cast<std::size_t>(i)] = lens.at<double>(i);
    stage.T_camera_plate.clear();
    for (std::size_t i = 0; i < views.size(); ++i) {
      stage.T_camera_plate.push_back(to_transform(turns[i], shifts[i]));
      images[i] = without_bias(model, plate, stage.T_camera_plate[i], views[i]);
    }
  }
  double sum = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double rms =
        root_mean_square(reprojection(stage.model, plate, stage.T_camera_plate[i], views[i]));
    stage.view_rms.push_back(rms);
    sum += rms * rms;
  }
  stage.rms = std::sqrt(sum / static_cast<double>(views.size()));
  return stage;
}

RigidTransform locate_plate(const SensorModel& model, const Target& plate, const View& view) {
  const std::vector<cv::Point3f> object = model_points(plate);
  std::vector<cv::Point2f> image = as_seen(view);
  cv::Mat turn, shift;
  const int rounds = plate.has_circles() ? 3 : 1;
  RigidTransform pose;
  for (int round = 0; round < rounds; ++round) {
    cv::solvePnP(object, image, camera_matrix(model), distortion(model), turn, shift, round > 0);
    pose = to_transform(turn, shift);
    image = without_bias(model, plate, pose, view);
  }
  return pose;
}

std::vector<Eigen::Vector2d> reprojection(const SensorModel& model, const Target& plate,
                                          const RigidTransform& T_camera_plate, const View& view) {
  std::vector<Eigen::Vector2d> result;
  const std::vector<Eigen::Vector3d> points = plate.points();
  for (std::size_t i = 0; i < points.size(); ++i)
    result.push_back(view.target[i] -
                     seen_as(model, T_camera_plate, points[i], plate.radius(static_cast<int>(i))));
  return result;
}

double root_mean_square(const std::vector<Eigen::Vector2d>& residuals) {
  double sum = 0;
  for (const Eigen::Vector2d& residual : residuals) sum += residual.squaredNorm();
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, residuals.size())));
}

}  // namespace arcstart::calibration
