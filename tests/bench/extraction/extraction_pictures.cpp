#include <fmt/core.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "services/extraction/files/stripe_picture.hpp"
#include "services/extraction/stripe_extractor.hpp"
#include "tests/bench/extraction/extraction_bench.hpp"
#include "tests/extraction/support/scene_renderer.hpp"
#include "tests/extraction/support/stripe_image.hpp"

namespace arcstart {

using namespace extraction;

void draw_scenes(const std::string& folder) {
  constexpr int kWidth = 800, kHeight = 450;
  for (const StripeSceneKind kind : kAllStripeScenes) {
    const StripeScene scene = render_stripe_scene(stripe_scene_settings(kind), 1);
    const extraction::Stripe stripe =
        extraction::StripeExtractor(extraction::ExtractionSettings{}).extract(view_of(scene.grey));
    const int left = (scene.grey.cols - kWidth) / 2;
    const auto middle = static_cast<int>(scene.truth[scene.truth.size() / 2].v);
    const int top = std::clamp(middle - kHeight / 2, 0, scene.grey.rows - kHeight);
    std::vector<extraction::PictureCentre> centres;
    for (const extraction::StripeCentre& c : stripe.centres)
      if (c.u >= left && c.u < left + kWidth && c.v >= top && c.v < top + kHeight)
        centres.push_back({c.u - left, c.v - top, c.segment, c.chosen});
    cv::Mat picture =
        extraction::draw_stripe(scene.grey(cv::Rect(left, top, kWidth, kHeight)).clone(), centres);
    cv::resize(picture, picture, {}, 0.5, 0.5, cv::INTER_AREA);
    const std::string file = fmt::format("{}/{}.jpg", folder, name_of(kind));
    if (!cv::imwrite(file, picture, {cv::IMWRITE_JPEG_QUALITY, 75}))
      fmt::print(stderr, "bench_extraction: {} cannot be written\n", file);
  }
}

}  // namespace arcstart
