#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paths.hpp"
#include "services/extraction/files/image_file.hpp"
#include "tests/bench/extraction/extraction_bench.hpp"
#include "tests/extraction/support/plain_ridge.hpp"
#include "tests/extraction/support/real_stripes.hpp"
#include "tests/extraction/support/stripe_image.hpp"

namespace arcstart {

using namespace extraction;
namespace {

// The plain form's strongest point of each row.
RowCentres plain_centres(const cv::Mat& grey, double sigma) {
  std::vector<extraction::RidgePoint> points;
  const extraction::ExtractionSettings settings;
  PlainRidgeDetector().detect(
      grey, extraction::gaussian_kernels(sigma),
      settings.least_strength / extraction::strength_factor(sigma, settings.strength_exponent),
      points);
  RowCentres centres(static_cast<std::size_t>(grey.rows), {-1, -1});
  std::vector<float> strongest(static_cast<std::size_t>(grey.rows), 0);
  for (const extraction::RidgePoint& p : points)
    if (p.curvature > strongest[static_cast<std::size_t>(p.row)]) {
      strongest[static_cast<std::size_t>(p.row)] = p.curvature;
      centres[static_cast<std::size_t>(p.row)] = {p.u, p.v};
    }
  return centres;
}

// Those of a in rows where b has one of the same line.
RowCentres where_both(const RowCentres& a, const RowCentres& b) {
  constexpr double kSameLine = 5;  // px
  RowCentres both = a;
  for (std::size_t row = 0; row < both.size(); ++row)
    if (b[row].x < 0 || std::abs(a[row].x - b[row].x) > kSameLine) both[row] = {-1, -1};
  return both;
}

// common: over the rows, and so the windows, where both have a centre of
// the same line.
struct Rows {
  double sigma, found_rms, smoothed_rms, common_rms, common_plain_rms, share;
};

Rows measure(const cv::Mat& grey) {
  extraction::ExtractionSettings settings;
  const extraction::Stripe smoothed = extraction::StripeExtractor(settings).extract(view_of(grey));
  settings.smooth_course = false;
  const extraction::Stripe found = extraction::StripeExtractor(settings).extract(view_of(grey));
  const RowCentres centres = row_centres(found, grey.rows),
                   plain = plain_centres(grey, found.sigma);
  return {found.sigma,
          line_rms(centres),
          line_rms(row_centres(smoothed, grey.rows)),
          line_rms(where_both(centres, plain)),
          line_rms(where_both(plain, centres)),
          share_found(centres, grey, static_cast<int>(std::ceil(2 * found.sigma)) + 1)};
}

}  // namespace

void bench_real_images(nlohmann::json& json) {
  fmt::print(
      "\nReal images: RMS about a straight line through 60 rows, median over the windows, px. "
      "Common: "
      "over the rows in which\nboth as found and plain have a centre of the same line. Rows: of "
      "those that show the "
      "stripe, 2 sigma and more from the border, with a centre.\n"
      "{:<28} {:>6} {:>9} {:>9} {:>9} {:>9} {:>8}\n",
      "", "sigma", "as found", "common", "plain", "smoothed", "rows %");
  for (const std::string set : {"etna_calib4", "etna_calib3"}) {
    const std::filesystem::path folder = real_data(set, ARCSTART_SOURCE);
    if (folder.empty()) {
      fmt::print("{}: not there, left out; set ARCSTART_DATA\n", set);
      continue;
    }
    double worst_rms = 0, worst_share = 1, most_over_plain = 0;
    for (const auto& path : images_in(folder)) {
      const Rows rows = measure(extraction::read_grey_image(path.string()));
      fmt::print("{:<28} {:6.2f} {:9.4f} {:9.4f} {:9.4f} {:9.4f} {:8.2f}\n",
                 set + "/" + path.filename().string(), rows.sigma, rows.found_rms, rows.common_rms,
                 rows.common_plain_rms, rows.smoothed_rms, 100 * rows.share);
      std::fflush(stdout);
      json[fmt::format("{}.{}.rms_px", set, path.stem().string())] = rows.found_rms;
      json[fmt::format("{}.{}.rows", set, path.stem().string())] = rows.share;
      worst_rms = std::max(worst_rms, rows.found_rms);
      worst_share = std::min(worst_share, rows.share);
      most_over_plain = std::max(most_over_plain, rows.common_rms - rows.common_plain_rms);
    }
    json[set + ".worst_rms_px"] = worst_rms;
    json[set + ".worst_rows"] = worst_share;
    json[set + ".most_over_plain_px"] = most_over_plain;
  }
}

}  // namespace arcstart
