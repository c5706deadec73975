#include "tests/extraction/support/real_stripes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

namespace arcstart::extraction {

std::filesystem::path real_data(const std::string& folder, const std::string& project) {
  const char* set = std::getenv("ARCSTART_DATA");
  const std::filesystem::path root = set != nullptr ? set : project + "/../shared/data";
  return std::filesystem::is_directory(root / folder) ? root / folder : std::filesystem::path();
}

std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> images;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".png") images.push_back(entry.path());
  std::sort(images.begin(), images.end());
  return images;
}

std::vector<double> white_middles(const cv::Mat& grey) {
  cv::Mat labels, sizes, centroids;
  const int count = cv::connectedComponentsWithStats(grey >= 250, labels, sizes, centroids);
  int stripe = 1;
  for (int i = 2; i < count; ++i)
    if (sizes.at<int>(i, cv::CC_STAT_HEIGHT) > sizes.at<int>(stripe, cv::CC_STAT_HEIGHT))
      stripe = i;
  std::vector<double> middles(grey.rows, -1);
  for (int v = 0; v < grey.rows; ++v) {
    int first = -1, last = -1, white = 0;
    for (int u = 0; u < grey.cols; ++u) {
      if (labels.at<int>(v, u) != stripe) continue;
      if (first < 0) first = u;
      last = u;
      ++white;
    }
    if (white >= 7 && last - first < 40) middles[v] = 0.5 * (first + last);
  }
  return middles;
}

RowCentres row_centres(const Stripe& stripe, int rows) {
  RowCentres centres(static_cast<std::size_t>(rows), {-1, -1});
  for (const StripeCentre& c : stripe.centres)
    if (c.chosen) centres[static_cast<std::size_t>(std::lround(c.v))] = {c.u, c.v};
  return centres;
}

double line_rms(const RowCentres& centres) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin + 60 <= centres.size(); begin += 10) {
    std::vector<cv::Point2d> points;
    for (std::size_t row = begin; row < begin + 60; ++row)
      if (centres[row].x >= 0) points.push_back({centres[row].y, centres[row].x});
    if (points.size() < 58) continue;
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& p : points) n += 1, x += p.x, y += p.y, xx += p.x * p.x, xy += p.x * p.y;
    const double slope = (n * xy - x * y) / (n * xx - x * x), offset = (y - slope * x) / n;
    double squares = 0;
    for (const auto& p : points) squares += std::pow(p.y - offset - slope * p.x, 2);
    values.push_back(std::sqrt(squares / n / (1 + slope * slope)));
  }
  if (values.empty()) return -1;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

double share_found(const RowCentres& centres, const cv::Mat& grey, int margin) {
  const std::vector<double> white = white_middles(grey);
  int shown = 0, found = 0;
  for (int v = margin; v < grey.rows - margin; ++v)
    if (white[v] >= 0) {
      ++shown;
      found += centres[v].x >= 0 && std::abs(centres[v].x - white[v]) < 5;
    }
  return shown > 0 ? static_cast<double>(found) / shown : 0;
}

}  // namespace arcstart::extraction
