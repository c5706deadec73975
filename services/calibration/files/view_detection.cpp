#include "services/calibration/files/view_detection.hpp"

#include <fmt/core.h>

#include "services/calibration/target/target_detection.hpp"
#include "services/extraction/stripe_extractor.hpp"

namespace arcstart::calibration {

View detect_view(const CalibrationPose& pose, const Target& plate, const cv::Mat& grid,
                 const cv::Mat& laser) {
  View view;
  view.index = pose.index;
  view.T_base_tool = pose.T_base_tool;
  view.target = detect_target(grid, plate);
  if (view.target.empty())
    view.unusable = fmt::format(
        "the plate's {} x {} points are not all to be seen: glare, a part "
        "outside the image, or other columns and rows",
        plate.columns, plate.rows);
  extraction::StripeExtractor extractor(extraction::ExtractionSettings{});
  const extraction::Stripe stripe = extractor.extract(
      {laser.data, laser.cols, laser.rows, static_cast<std::ptrdiff_t>(laser.step)});
  for (const extraction::StripeCentre& centre : stripe.centres)
    if (centre.chosen) view.stripe.push_back({centre.u, centre.v});
  return view;
}

}  // namespace arcstart::calibration
