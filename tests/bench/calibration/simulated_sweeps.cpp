#include "tests/bench/calibration/simulated_sweeps.hpp"

#include "common/time.hpp"
#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/robot/search_motion.hpp"
#include "services/extraction/stripe_extractor.hpp"

namespace arcstart::test {

using namespace calibration;
using namespace cell_simulator;
using namespace extraction;
namespace {

std::vector<std::vector<Eigen::Vector2d>> segments_of(const extraction::Stripe& stripe) {
  std::vector<std::vector<Eigen::Vector2d>> segments;
  int last = -1;
  for (const extraction::StripeCentre& centre : stripe.centres) {
    if (!centre.chosen) continue;
    if (centre.segment != last) segments.emplace_back();
    last = centre.segment;
    segments.back().push_back({centre.u, centre.v});
  }
  return segments;
}

}  // namespace

void append_sweeps(calibration::SweepData& record, const SimulatedSweepsSettings& settings,
                   std::uint64_t seed) {
  const cell_simulator::Scene scene =
      cell_simulator::make_scene(settings.scene, settings.kind, seed);
  cell_simulator::ImageRenderer renderer(settings.sensor);
  extraction::StripeExtractor extractor(extraction::ExtractionSettings{});
  cell_simulator::RandomStream jitter(seed, 71), noise(seed, 72), phase(seed, 73);
  const std::int64_t begin =
      record.stripes.empty() ? settings.begin_utime : record.stripes.back().utime + 60'000'000;
  const auto taught = [&](double along) {
    return cell_simulator::taught_tool_pose(settings.sensor, settings.scene, along);
  };
  cell_simulator::SearchMotionSettings moves;
  moves.search_speed = settings.speeds_mm_s.front();
  moves.further_sweeps.assign(settings.speeds_mm_s.begin() + 1, settings.speeds_mm_s.end());
  cell_simulator::SearchMotion motion(taught(settings.scene.search_begin_mm),
                                      taught(settings.scene.search_end_mm), moves);
  const std::int64_t period = seconds_to_us(1 / settings.frames_per_second);
  motion.search(begin, begin, period, phase.uniform());
  const std::int64_t end = motion.at_rest_from(begin) + 200'000;

  // Where the robot is while it says to be elsewhere, with play in its joints.
  const auto true_pose = [&](std::int64_t utime) {
    RigidTransform pose = motion.pose(utime);
    const Eigen::Vector3d way = motion.pose(utime + 1000).translation() - pose.translation();
    if (way.norm() > 0) pose.translation() -= settings.play_mm * way.normalized();
    return pose;
  };
  for (std::int64_t t = begin; t < end + 300'000;
       t += seconds_to_us(1 / settings.positions_per_second)) {
    RigidTransform said = motion.pose(t);
    for (double& value : said.translation()) value += settings.position_noise_mm * noise.normal();
    record.trajectory.insert(t, said);
  }
  const cell_simulator::TrueSensor& sensor = renderer.sensor();
  std::vector<std::uint8_t> grey(static_cast<std::size_t>(sensor.width * sensor.height));
  std::uint64_t frame = 0;
  for (std::int64_t t = begin + 100'000; t < end; t += period, ++frame) {
    renderer.render(scene, true_pose(t), cell_simulator::Exposure{}, seed * 100'003 + frame,
                    grey.data(), renderer.whole_image());
    const extraction::Stripe stripe =
        extractor.extract({grey.data(), sensor.width, sensor.height, sensor.width});
    const double late = settings.image_delay_s + settings.image_jitter_s * jitter.normal();
    record.stripes.push_back({t + seconds_to_us(late), begin, segments_of(stripe)});
  }
}

Calibration true_calibration(const SimulatedSweepsSettings& settings) {
  const cell_simulator::TrueSensor sensor = cell_simulator::make_true_sensor(settings.sensor);
  Calibration calibration;
  calibration.id = "simulated";
  calibration.made = 1;
  calibration.sensor = "LASER0";
  calibration.robot = "ROBOT0";
  calibration.origin = "simulator's truth";
  calibration.sensor_model = {
      sensor.width, sensor.height, sensor.fx,         sensor.fy,
      sensor.cx,    sensor.cy,     sensor.distortion, {sensor.laser_normal, sensor.laser_offset}};
  calibration.T_tool_camera = sensor.T_tool_camera;
  calibration.time_offset = -settings.image_delay_s;
  return calibration;
}

}  // namespace arcstart::test
