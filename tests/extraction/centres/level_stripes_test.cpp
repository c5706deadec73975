#include <catch2/catch.hpp>
#include <cmath>

#include "services/extraction/stripe_extractor.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

TEST_CASE("a level stripe is found whole, also between two rows of pixels") {
  for (const double slope : {0.0, 0.003})
    for (const double width : {0.9, 1.4, 2.5})
      for (double row = 100; row <= 101; row += 0.0625) {
        cv::Mat light = darkness(400, 200);
        add_stripe(light, 20, row - 180 * slope, 380, row + 180 * slope, 120, width);
        const cv::Mat image = expose(light, 2);
        const Stripe stripe = StripeExtractor(ExtractionSettings{}).extract(view_of(image));
        CAPTURE(slope, width, row);
        REQUIRE(stripe.centres.size() > 350);
        CHECK(stripe.centres.back().segment == 0);
        for (const StripeCentre& c : stripe.centres)
          if (c.u > 25 && c.u < 375)
            REQUIRE(std::abs(c.v - row - slope * (c.u - 200)) < (width < 1 ? 0.2 : 0.06));
      }
}
