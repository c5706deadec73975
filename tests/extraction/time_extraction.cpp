// Time of one core for a 1600 x 1200 frame, median of 30: `extraction_time [IMAGE...]`, rendered
// scenes without arguments.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

#include "services/extraction/image_file.hpp"
#include "services/extraction/stripe_extractor.hpp"
#include "tests/extraction/scene_renderer.hpp"
#include "tests/extraction/stripe_image.hpp"

namespace {

using namespace arcstart;

// Of this thread: what other programs do beside it does not count.
double cpu_ms() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

void measure(const std::string& name, const cv::Mat& grey) {
  StripeExtractor extractor(ExtractionSettings{});
  std::vector<double> first, next;
  Stripe stripe;
  for (int i = 0; i < 30; ++i) {
    extractor.restart();
    double begin = cpu_ms();
    stripe = extractor.extract(view_of(grey));
    first.push_back(cpu_ms() - begin);
    begin = cpu_ms();
    stripe = extractor.extract(view_of(grey));
    next.push_back(cpu_ms() - begin);
  }
  const auto median = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + 15, values.end());
    return values[15];
  };
  std::cout << fmt::format(
      "{:<14} {:4} x {:4}  sigma {:5.2f}  blocks active {:5.1f} %  {:6.2f} ms, first of a scan "
      "{:6.2f} ms\n",
      name, grey.cols, grey.rows, stripe.sigma, 100 * extractor.active_share(), median(next),
      median(first));
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) measure(argv[i], read_grey_image(argv[i]));
  if (argc > 1) return 0;
  const std::pair<const char*, StripeSceneKind> scenes[] = {
      {"clean", StripeSceneKind::kClean},
      {"typical", StripeSceneKind::kTypical},
      {"glare", StripeSceneKind::kGlare},
      {"saturated", StripeSceneKind::kSaturated},
      {"low contrast", StripeSceneKind::kLowContrast}};
  for (const auto& [name, kind] : scenes)
    measure(name, render_stripe_scene(stripe_scene_settings(kind), 1).grey);
}
