#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <ctime>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "services/extraction/stripe_extractor.hpp"
#include "tests/bench/extraction/extraction_bench.hpp"
#include "tests/extraction/image/counted_allocations.hpp"
#include "tests/extraction/support/column_methods.hpp"
#include "tests/extraction/support/plain_ridge.hpp"
#include "tests/extraction/support/scene_renderer.hpp"
#include "tests/extraction/support/stripe_image.hpp"

namespace arcstart {

using namespace extraction;
namespace {

constexpr double kSigma = 2.5;
constexpr int kSeeds = 4;  // images of a scene
// As the service asks for ridge points: to the border but for 2 px, no more than 96 a column.
constexpr int kBorder = 2;
constexpr std::size_t kMostPoints = 96 * 1600;

// Of this thread: what other programs do beside it does not count.
double cpu_ms() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

struct Method {
  const char* name;
  std::function<void(const cv::Mat&)> run;
};

// Of one method on one image.
struct Times {
  std::vector<double> ms;
  double least() const { return *std::min_element(ms.begin(), ms.end()); }
  double tenth() {
    std::sort(ms.begin(), ms.end());
    return ms[ms.size() / 10];
  }
};

// The whole image at least once through the registers.
std::uint64_t read_once(const cv::Mat& grey) {
  std::uint64_t sum = 0;
  const std::size_t words = grey.total() / 8;
  for (std::size_t i = 0; i < words; ++i) {
    std::uint64_t eight;
    std::memcpy(&eight, grey.data + 8 * i, 8);
    sum ^= eight;
  }
  return sum;
}

class Row {
 public:
  explicit Row(std::string name) : name_(std::move(name)) {}
  std::vector<cv::Mat> images;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

std::vector<Row> rows_of_images() {
  std::vector<Row> rows;
  for (const StripeSceneKind kind : kAllStripeScenes) {
    rows.emplace_back(name_of(kind));
    for (int seed = 1; seed <= kSeeds; ++seed)
      rows.back().images.push_back(
          render_stripe_scene(stripe_scene_settings(kind), static_cast<std::uint64_t>(seed)).grey);
  }
  rows.emplace_back("worst");  // every block is active
  rows.back().images.push_back(expose(darkness(1600, 1200, 128), 40));
  for (const int field : {2, 4, 8, 16}) {  // full of ridge points, but for the first
    rows.emplace_back(fmt::format("checkers_{}", field));
    cv::Mat& grey = rows.back().images.emplace_back(1200, 1600, CV_8U);
    grey.forEach<std::uint8_t>([&](std::uint8_t& value, const int* at) {
      value = (at[0] / field + at[1] / field) % 2 != 0 ? 255 : 0;
    });
  }
  return rows;
}

// prefix: of the figures' names.
void bench_at(double strength, int rounds, const std::string& prefix, nlohmann::json& json) {
  const extraction::GaussianKernels kernels = extraction::gaussian_kernels(kSigma);
  const double least = strength / extraction::strength_factor(kSigma, 1.5);
  extraction::ExtractionSettings at_sigma;
  at_sigma.sigma_px = kSigma;
  at_sigma.least_strength = strength;
  PlainRidgeDetector plain;
  extraction::RidgeDetector fast;
  extraction::StripeExtractor selecting(at_sigma), service{extraction::ExtractionSettings{}};
  ColumnMethods columns;
  std::vector<extraction::RidgePoint> points;
  std::vector<Centre> centres;
  extraction::Stripe stripe;
  volatile std::uint64_t seen = 0;  // so that the reading is not left out
  const std::vector<Method> methods{
      {"read", [&](const cv::Mat& grey) { seen = read_once(grey); }},
      {"plain", [&](const cv::Mat& grey) { plain.detect(grey, kernels, least, points); }},
      {"ridge", [&](const cv::Mat& grey) { fast.detect(view_of(grey), kernels, least, points); }},
      {"with_selection", [&](const cv::Mat& grey) { selecting.extract(view_of(grey), stripe); }},
      {"centroid", [&](const cv::Mat& grey) { columns.centroid(grey, kSigma, centres); }},
      {"gaussian_fit", [&](const cv::Mat& grey) { columns.gaussian_fit(grey, kSigma, centres); }},
      {"fir", [&](const cv::Mat& grey) { columns.finite_impulse(grey, kSigma, centres); }},
      {"as_service_asks", [&](const cv::Mat& grey) {
         fast.detect_lines(view_of(grey), kernels, at_sigma.weakest_share * least, least, kBorder,
                           points, kMostPoints);
       }}};

  fmt::print(
      "\nTime, ms of one core for a frame of 1600 x 1200: least of {} rounds, mean over the "
      "images; "
      "in brackets the 10th\npercentile. sigma {}, strength {:.2f}: curvature {:.2f} grey values / "
      "px^2. service: as shipped, sigma followed, within a scan. ratio: of plain to "
      "ridge, all points of that\ncurvature; asked: to as_service_asks, with hysteresis from {} of "
      "it on, and given up beyond {} points.\n{:<14} {:>9}",
      rounds, kSigma, strength, least, at_sigma.weakest_share, kMostPoints, "", "active %");
  for (const Method& method : methods) fmt::print(" {:>16}", method.name);
  fmt::print(" {:>16} {:>7} {:>7}\n", "service", "ratio", "asked");
  for (const Row& row : rows_of_images()) {
    std::vector<double> least_ms(methods.size() + 1, 0), tenth_ms(methods.size() + 1, 0);
    bool refused = false;  // an image, for more points than are asked for
    const double share = 1.0 / static_cast<double>(row.images.size());
    double active = 0;
    std::vector<std::vector<Times>> times(row.images.size(),
                                          std::vector<Times>(methods.size() + 1));
    for (std::size_t i = 0; i < row.images.size(); ++i) {
      service.restart();
      for (int warm = 0; warm < 3; ++warm) service.extract(view_of(row.images[i]));
      for (int round = 0; round < rounds; ++round) {
        for (std::size_t m = 0; m < methods.size(); ++m) {
          const double begin = cpu_ms();
          methods[m].run(row.images[i]);
          times[i][m].ms.push_back(cpu_ms() - begin);
        }
        const double begin = cpu_ms();
        service.extract(view_of(row.images[i]), stripe);
        times[i].back().ms.push_back(cpu_ms() - begin);
      }
      fast.detect(view_of(row.images[i]), kernels, least, points);
      active += share * fast.active_share();
      refused |= !fast.detect_lines(view_of(row.images[i]), kernels, at_sigma.weakest_share * least,
                                    least, kBorder, points, kMostPoints);
      for (std::size_t m = 0; m <= methods.size(); ++m) {
        least_ms[m] += share * times[i][m].least();
        tenth_ms[m] += share * times[i][m].tenth();
      }
    }
    fmt::print("{:<14} {:9.1f}", row.name(), 100 * active);
    for (std::size_t m = 0; m <= methods.size(); ++m)
      fmt::print(" {:7.2f} ({:6.2f})", least_ms[m], tenth_ms[m]);
    const double ratio = least_ms[1] / least_ms[2], ratio_as_asked = least_ms[1] / least_ms[7];
    fmt::print(" {:7.1f} {:7.1f}{}\n", ratio, ratio_as_asked, refused ? " refused" : "");
    std::fflush(stdout);
    json[prefix + "ratio_" + row.name()] = ratio;
    json[prefix + "ratio_as_asked_" + row.name()] = ratio_as_asked;
    json[prefix + "refused_" + row.name()] = refused;
    json[prefix + "ms_" + row.name()] = least_ms[2];
    json[prefix + "ms_as_asked_" + row.name()] = least_ms[7];
    json[prefix + "plain_ms_" + row.name()] = least_ms[1];
    json[prefix + "with_selection_ms_" + row.name()] = least_ms[3];
    json[prefix + "service_ms_" + row.name()] = least_ms.back();
    if (row.name() != "typical") continue;
    json[prefix + "ms_read"] = least_ms[0];
    json[prefix + "ratio_to_read"] = least_ms[2] / least_ms[0];
    json[prefix + "ms_with_selection"] = least_ms[3];
    for (const std::size_t m : {4u, 5u, 6u})
      json[fmt::format("{}ms_{}", prefix, methods[m].name)] = least_ms[m];
  }

  // Once warm: the same images again.
  const Row typical = rows_of_images()[1];
  const auto allocations = [&](const std::function<void(const cv::Mat&)>& run) {
    for (int warm = 0; warm < 2; ++warm)
      for (const cv::Mat& grey : typical.images) run(grey);
    const std::int64_t before = counted_allocations();
    for (const cv::Mat& grey : typical.images) run(grey);
    return static_cast<double>(counted_allocations() - before) /
           static_cast<double>(typical.images.size());
  };
  json[prefix + "allocations_ridge"] = allocations(methods[2].run);
  json[prefix + "allocations_with_selection"] = allocations(methods[3].run);
  static_cast<void>(seen);
  fmt::print("allocations a frame, once warm: ridge {}, with selection {}\n",
             json[prefix + "allocations_ridge"].get<double>(),
             json[prefix + "allocations_with_selection"].get<double>());
}

}  // namespace

void bench_speed(int rounds, nlohmann::json& json) {
  // Curvature 1.5 is where blocks can be told apart in these scenes; strength 1.5 is far below the
  // service's own threshold, there all of the image is looked at.
  bench_at(1.5 * extraction::strength_factor(kSigma, 1.5), rounds, "speed.", json);
  bench_at(1.5, rounds, "speed_all_active.", json);
}

}  // namespace arcstart
