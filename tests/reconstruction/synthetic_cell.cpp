#include "tests/reconstruction/synthetic_cell.hpp"

#include <cmath>
#include <opencv2/calib3d.hpp>

namespace arcstart::test {

namespace {

const cv::Matx33d kCamera(2400, 0, 805.5, 0, 2410, 592.25, 0, 0, 1);
const std::vector<double> kDistortion = {-0.1, 0.02, 3e-4, -5e-4, 0.01};
const cv::Vec3d kLaserNormal = cv::normalize(cv::Vec3d(0.03, 0.93, -0.36));
const double kLaserOffset = 300 * 0.36 / std::sqrt(0.03 * 0.03 + 0.93 * 0.93 + 0.36 * 0.36);
const cv::Vec3d kHandEyeTurn(0.05, -0.03, 0.1);  // rotation vector
const cv::Vec3d kHandEyePlace(60, 5, 40);
const cv::Vec3d kToolPlace(500, -20, 350), kVelocity(50, 3, -1);  // mm, mm/s
const cv::Vec3d kAxis = cv::normalize(cv::Vec3d(0.2, -0.5, 0.8));
constexpr double kTurnRate = 0.1;  // rad/s

cv::Matx44d rigid(const cv::Matx33d& rotation, const cv::Vec3d& place) {
  cv::Matx44d result = cv::Matx44d::eye();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) result(row, column) = rotation(row, column);
    result(row, 3) = place[row];
  }
  return result;
}

cv::Matx33d rotation_of(const cv::Vec3d& rotation_vector) {
  cv::Matx33d rotation;
  cv::Rodrigues(rotation_vector, rotation);
  return rotation;
}

cv::Vec4d multiplied(const cv::Vec4d& a, const cv::Vec4d& b) {  // quaternions w, x, y, z
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

cv::Vec4d quaternion_of(const cv::Vec3d& rotation_vector) {
  const double angle = cv::norm(rotation_vector);
  const cv::Vec3d axis = rotation_vector / angle * std::sin(angle / 2);
  return {std::cos(angle / 2), axis[0], axis[1], axis[2]};
}

stripe_t header(std::int64_t time, int number, std::int64_t scan_id) {
  stripe_t message{};
  message.utime = kBegin + time + kImageDelay;
  message.run_id = 77;
  message.seq = 1000 + number;
  message.scan_id = scan_id;
  message.scan_index = scan_id == 0 ? -1 : number;
  message.sensor_width = 1600;
  message.sensor_height = 1200;
  message.sigma = 3;
  return message;
}

}  // namespace

Calibration true_calibration() {
  Calibration calibration;
  calibration.id = "0123456789abcdef";
  calibration.sensor = "LASER0";
  calibration.robot = "ROBOT0";
  calibration.tool = "TCP1";
  calibration.made = kBegin - 1'000'000;
  calibration.origin = "synthetic cell";
  SensorModel& model = calibration.sensor_model;
  model.width = 1600;
  model.height = 1200;
  model.fx = kCamera(0, 0);
  model.fy = kCamera(1, 1);
  model.cx = kCamera(0, 2);
  model.cy = kCamera(1, 2);
  std::copy(kDistortion.begin(), kDistortion.end(), model.distortion.begin());
  model.laser_plane = {{kLaserNormal[0], kLaserNormal[1], kLaserNormal[2]}, kLaserOffset};
  const cv::Vec4d turn = quaternion_of(kHandEyeTurn);
  calibration.T_tool_camera = transform_from_arrays(kHandEyePlace.val, turn.val);
  calibration.time_offset = -0.02732;
  return calibration;
}

cv::Matx44d tool_at(double seconds) {
  const cv::Matx33d upside_down(1, 0, 0, 0, -1, 0, 0, 0, -1);  // the tool looks down
  return rigid(upside_down * rotation_of(kAxis * kTurnRate * seconds),
               kToolPlace + kVelocity * seconds);
}

robot_pose_t pose_at(std::int64_t time) {
  const double seconds = static_cast<double>(time) * 1e-6;
  robot_pose_t pose{};
  pose.utime = kBegin + time;
  pose.run_id = 88;
  pose.seq = (time + 10'000'000) / 20'000;
  const cv::Vec3d place = kToolPlace + kVelocity * seconds;
  cv::Vec4d turn = {0, 1, 0, 0};
  if (seconds != 0) turn = multiplied(turn, quaternion_of(kAxis * kTurnRate * seconds));
  for (int i = 0; i < 3; ++i) pose.position[i] = place[i];
  for (int i = 0; i < 4; ++i) pose.quaternion[i] = turn[i];
  return pose;
}

TrueStripe stripe_at(std::int64_t time, int number, std::int64_t scan_id) {
  TrueStripe stripe{header(time, number, scan_id), {}};
  stripe_t& message = stripe.message;
  const cv::Matx44d T_base_camera =
      tool_at(static_cast<double>(time) * 1e-6) * rigid(rotation_of(kHandEyeTurn), kHandEyePlace);
  const cv::Matx44d T_camera_base = T_base_camera.inv();
  const cv::Matx33d rotation = T_base_camera.get_minor<3, 3>(0, 0);
  const cv::Vec3d centre(T_base_camera(0, 3), T_base_camera(1, 3), T_base_camera(2, 3));
  // Laser plane in base, cut with z = 0.
  const cv::Vec3d normal = rotation * kLaserNormal;
  const double offset = kLaserOffset - normal.dot(centre);
  const cv::Vec3d direction = cv::normalize(normal.cross(cv::Vec3d(0, 0, 1)));
  const cv::Vec2d flat(normal[0], normal[1]);
  const cv::Vec2d foot = flat * (-offset / flat.dot(flat));
  const double middle = direction.dot(centre - cv::Vec3d(foot[0], foot[1], 0));
  for (int step = -400; step <= 400; ++step) {
    const cv::Vec3d point = cv::Vec3d(foot[0], foot[1], 0) + direction * (middle + step * 0.15);
    const cv::Vec4d seen = T_camera_base * cv::Vec4d(point[0], point[1], point[2], 1);
    std::vector<cv::Point2d> pixel;
    cv::projectPoints(std::vector<cv::Point3d>{{seen[0], seen[1], seen[2]}}, cv::Vec3d(),
                      cv::Vec3d(), kCamera, kDistortion, pixel);
    if (pixel[0].x < 0 || pixel[0].x > 1599 || pixel[0].y < 0 || pixel[0].y > 1199) continue;
    stripe.points.push_back(point);
    message.u.push_back(static_cast<float>(pixel[0].x));
    message.v.push_back(static_cast<float>(pixel[0].y));
  }
  const std::size_t count = stripe.points.size();
  message.count = static_cast<int>(count);
  message.strength.assign(count, 50);
  message.width.assign(count, 3);
  message.deviation.assign(count, 0.05f);
  message.rank.assign(count, stripe_t::CHOSEN);
  message.segment_end.assign(count, stripe_t::CONTINUES);
  for (std::size_t i = 0; i < count; ++i)  // two segments
    message.segment.push_back(i < count / 3 ? 0 : 1);
  if (count >= 6) {
    message.segment_end.front() = message.segment_end.back() = stripe_t::BORDER;
    message.segment_end[count / 3 - 1] = message.segment_end[count / 3] = stripe_t::EDGE;
  }
  return stripe;
}

stripe_t empty_stripe_at(std::int64_t time, int number, std::int64_t scan_id) {
  stripe_t message = header(time, number, scan_id);
  message.why = stripe_t::NO_STRIPE;
  message.empty = "no stripe";
  return message;
}

}  // namespace arcstart::test
