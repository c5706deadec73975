// A program of its own: operator new is replaced in it.
#include <catch2/catch.hpp>

#include "services/extraction/stripe_extractor.hpp"
#include "tests/extraction/image/counted_allocations.hpp"
#include "tests/extraction/support/scene_renderer.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

TEST_CASE("once warm, an image takes no memory from the heap") {
  StripeSceneSettings scene = stripe_scene_settings(StripeSceneKind::kGlare);
  scene.width = 700;
  scene.height = 500;
  const cv::Mat images[] = {render_stripe_scene(scene, 1).grey, render_stripe_scene(scene, 2).grey};
  ExtractionSettings settings;
  settings.sigma_px = GENERATE(0.0, 2.5);  // followed, or set
  settings.threads = GENERATE(1, 3);
  StripeExtractor extractor(settings);
  Stripe stripe;
  // Followed, sigma comes to rest.
  for (int i = 0; i < 60; ++i) extractor.extract(view_of(images[i % 2]), stripe);
  REQUIRE(stripe.centres.size() > 300);
  const auto before = counted_allocations();
  // In between, sigma may go to and fro between two steps, and kernels are made anew.
  std::int64_t fewest = 1'000'000;
  for (int i = 0; i < 10; ++i) {
    const auto begin = counted_allocations();
    extractor.extract(view_of(images[0]), stripe);
    fewest = std::min(fewest, counted_allocations() - begin);
  }
  CHECK(fewest == 0);
  if (settings.sigma_px > 0) CHECK(counted_allocations() == before);
}
