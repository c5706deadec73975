// Renders frames of the simulated cell to PNG files for a person to look at, and times them:
//   render_scene FOLDER [SEED] [FLAG...]   flags: background box_beside box_on_base no_tool top
//   small
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <string>

#include "services/cell_simulator/image/image_renderer.hpp"

using namespace arcstart;
using namespace arcstart::cell_simulator;

namespace {

// The whole scene under a headlight, from `eye` to `target`: what the laser alone does not show.
void draw_scene(const Scene& scene, const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                const std::string& path) {
  constexpr int width = 900, height = 700;
  const Eigen::Vector3d z = (target - eye).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized(), y = z.cross(x);
  cv::Mat image(height, width, CV_8UC3, cv::Scalar(60, 40, 30));
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector3d ray = z + (u - width / 2) * x / 1200.0 + (v - height / 2) * y / 1200.0;
      int triangle = -1;
      if (scene.triangles().first_hit(eye, eye + 3000 * ray, &triangle) > 1) continue;
      const double light =
          40 + 200 * std::abs(scene.triangles().triangle(triangle).normal.dot(ray.normalized()));
      const int object = scene.triangles().object_of(triangle);
      const double tint = object == 0 ? 0.7 : 1;
      image.at<cv::Vec3b>(v, u) =
          cv::Vec3b(cv::saturate_cast<uchar>(light * (object > 2 ? 0.5 : tint)),
                    cv::saturate_cast<uchar>(light * tint), cv::saturate_cast<uchar>(light));
    }
  }
  cv::imwrite(path, image);
}

// Of this thread: what other programs do beside it does not count.
double cpu_ms() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: render_scene FOLDER [SEED] [FLAG...]\n");
    return 2;
  }
  const std::string folder = argv[1];
  const std::uint64_t seed = argc > 2 ? std::stoull(argv[2]) : 1;
  const std::set<std::string> flags(argv + std::min(argc, 3), argv + argc);
  SensorSettings sensor_settings;
  if (flags.contains("small"))
    sensor_settings.image_width_px = 400, sensor_settings.image_height_px = 300;
  SceneSettings settings;
  settings.tool_lying_about = !flags.contains("no_tool");
  settings.box_beside = flags.contains("box_beside");
  settings.box_on_base = flags.contains("box_on_base");
  const Scene scene = make_scene(
      settings, flags.contains("background") ? SceneKind::background : SceneKind::workpiece, seed);
  if (flags.contains("top")) {
    draw_scene(scene, {850, -450, 450}, {950, 0, 20}, folder + "/scene.png");
    draw_scene(scene, {950, -20, 650}, {950, 0, 0}, folder + "/scene_above.png");
  }
  ImageRenderer renderer(sensor_settings);
  const ImageRegion region = renderer.whole_image();
  cv::Mat image(region.height, region.width, CV_8UC1);
  std::vector<double> times;
  const int frames = 42;
  for (int i = 0; i < frames; ++i) {
    const double along = settings.search_begin_mm +
                         (settings.search_end_mm - settings.search_begin_mm) * i / (frames - 1);
    const RigidTransform T_base_tool = taught_tool_pose(sensor_settings, settings, along);
    const double begin = cpu_ms();
    renderer.render(scene, T_base_tool, {}, seed + static_cast<std::uint64_t>(i), image.data,
                    region);
    times.push_back(cpu_ms() - begin);
    if (i % 6 == 3) cv::imwrite(folder + "/frame" + std::to_string(i) + ".png", image);
  }
  std::sort(times.begin(), times.end());
  std::printf("%d triangles, ms of CPU a frame: least %.2f, median %.2f, most %.2f\n",
              scene.triangles().size(), times.front(), times[times.size() / 2], times.back());
  return 0;
}
