#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "services/extraction/image_file.hpp"
#include "tests/bench/extraction_bench.hpp"
#include "tests/extraction/plain_ridge.hpp"
#include "tests/extraction/real_stripes.hpp"
#include "tests/extraction/stripe_image.hpp"

namespace arcstart {
namespace {

// The plain form's strongest point of each row.
std::vector<double> plain_columns(const cv::Mat& grey, double sigma) {
  std::vector<RidgePoint> points;
  const ExtractionSettings settings;
  PlainRidgeDetector().detect(
      grey, gaussian_kernels(sigma),
      settings.least_strength / strength_factor(sigma, settings.strength_exponent), points);
  std::vector<double> columns(static_cast<std::size_t>(grey.rows), -1);
  std::vector<float> strongest(static_cast<std::size_t>(grey.rows), 0);
  for (const RidgePoint& p : points)
    if (p.curvature > strongest[static_cast<std::size_t>(p.row)]) {
      strongest[static_cast<std::size_t>(p.row)] = p.curvature;
      columns[static_cast<std::size_t>(p.row)] = p.u;
    }
  return columns;
}

struct Rows {
  double sigma, found_rms, smoothed_rms, plain_rms, share;
};

Rows measure(const cv::Mat& grey) {
  ExtractionSettings settings;
  const Stripe smoothed = StripeExtractor(settings).extract(view_of(grey));
  settings.smooth_course = false;
  const Stripe found = StripeExtractor(settings).extract(view_of(grey));
  const std::vector<double> columns = columns_of(found, grey.rows);
  return {found.sigma, line_rms(columns), line_rms(columns_of(smoothed, grey.rows)),
          line_rms(plain_columns(grey, found.sigma)),
          share_found(columns, grey, static_cast<int>(std::ceil(2 * found.sigma)) + 1)};
}

}  // namespace

void bench_real_images(nlohmann::json& json) {
  fmt::print(
      "\nReal images: RMS about a straight line through 60 rows, median over the windows, px. "
      "Rows: "
      "of those that show the stripe,\n2 sigma and more from the border, with a centre.\n"
      "{:<28} {:>6} {:>9} {:>9} {:>9} {:>8}\n",
      "", "sigma", "as found", "plain", "smoothed", "rows %");
  for (const std::string set : {"etna_calib4", "etna_calib3"}) {
    const std::filesystem::path folder = real_data(set, ARCSTART_SOURCE);
    if (folder.empty()) {
      fmt::print("{}: not there, left out; set ARCSTART_DATA\n", set);
      continue;
    }
    double worst_rms = 0, worst_share = 1, most_over_plain = 0;
    for (const auto& path : images_in(folder)) {
      const Rows rows = measure(read_grey_image(path.string()));
      fmt::print("{:<28} {:6.2f} {:9.4f} {:9.4f} {:9.4f} {:8.2f}\n",
                 set + "/" + path.filename().string(), rows.sigma, rows.found_rms, rows.plain_rms,
                 rows.smoothed_rms, 100 * rows.share);
      std::fflush(stdout);
      json[fmt::format("{}.{}.rms_px", set, path.stem().string())] = rows.found_rms;
      json[fmt::format("{}.{}.rows", set, path.stem().string())] = rows.share;
      worst_rms = std::max(worst_rms, rows.found_rms);
      worst_share = std::min(worst_share, rows.share);
      most_over_plain = std::max(most_over_plain, rows.found_rms - rows.plain_rms);
    }
    json[set + ".worst_rms_px"] = worst_rms;
    json[set + ".worst_rows"] = worst_share;
    json[set + ".most_over_plain_px"] = most_over_plain;
  }
}

}  // namespace arcstart
