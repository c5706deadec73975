#include "tests/extraction/support/column_methods.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/extraction/support/plain_ridge.hpp"

namespace arcstart::extraction {
namespace {

constexpr float kLeastHeight = 20;  // grey values above the background

// Of every 97th pixel.
float median_of(const cv::Mat& grey) {
  std::vector<std::uint8_t> values;
  for (std::size_t i = 0; i < grey.total(); i += 97) values.push_back(grey.data[i]);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void ColumnMethods::find_peaks(const cv::Mat& grey, double sigma) {
  cv::GaussianBlur(grey, smooth_, {1, 2 * static_cast<int>(std::ceil(3 * sigma)) + 1}, 0.1, sigma);
  highest_.assign(grey.cols, -1);
  row_.assign(grey.cols, 0);
  for (int row = 0; row < grey.rows; ++row) {
    const std::uint8_t* values = smooth_.ptr(row);
    for (int column = 0; column < grey.cols; ++column)
      if (values[column] > highest_[column]) {
        highest_[column] = values[column];
        row_[column] = row;
      }
  }
  background_ = median_of(grey);
}

void ColumnMethods::centroid(const cv::Mat& grey, double sigma, std::vector<Centre>& centres) {
  centres.clear();
  find_peaks(grey, sigma);
  const int reach = static_cast<int>(4 * sigma);
  for (int column = 0; column < grey.cols; ++column) {
    const float height = highest_[column] - background_;
    if (height < kLeastHeight) continue;
    double sum = 0, moment = 0;
    for (int row = std::max(0, row_[column] - reach);
         row <= std::min(grey.rows - 1, row_[column] + reach); ++row) {
      const double weight = grey.at<std::uint8_t>(row, column) - background_ - height / 2;
      if (weight <= 0) continue;
      sum += weight;
      moment += weight * row;
    }
    if (sum > 0) centres.push_back({static_cast<double>(column), moment / sum});
  }
}

void ColumnMethods::gaussian_fit(const cv::Mat& grey, double sigma, std::vector<Centre>& centres) {
  centres.clear();
  find_peaks(grey, sigma);
  const int reach = static_cast<int>(2 * sigma);
  for (int column = 0; column < grey.cols; ++column) {
    const float height = highest_[column] - background_;
    if (height < kLeastHeight) continue;
    double s[5] = {}, t[3] = {};
    for (int k = -reach; k <= reach; ++k) {
      const int row = row_[column] + k;
      if (row < 0 || row >= grey.rows) continue;
      const double value = grey.at<std::uint8_t>(row, column) - background_;
      if (value < height / 5) continue;
      double weight = value * value;
      const double logarithm = std::log(value);
      for (int power = 0; power < 5; ++power, weight *= k) {
        s[power] += weight;
        if (power < 3) t[power] += weight * logarithm;
      }
    }
    // logarithm = a + b k + c k^2, by Cramer's rule.
    const auto determinant = [](double a, double b, double c, double d, double e, double f,
                                double g, double h, double i) {
      return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
    };
    const double b = determinant(s[0], t[0], s[2], s[1], t[1], s[3], s[2], t[2], s[4]);
    const double c = determinant(s[0], s[1], t[0], s[1], s[2], t[1], s[2], s[3], t[2]);
    const double whole = determinant(s[0], s[1], s[2], s[1], s[2], s[3], s[2], s[3], s[4]);
    if (whole <= 0 || c >= 0) continue;
    const double vertex = -b / (2 * c);
    if (std::abs(vertex) <= reach)
      centres.push_back({static_cast<double>(column), row_[column] + vertex});
  }
}

void ColumnMethods::finite_impulse(const cv::Mat& grey, double sigma,
                                   std::vector<Centre>& centres) {
  centres.clear();
  find_peaks(grey, sigma);
  const cv::Mat one(1, 1, CV_32F, cv::Scalar(1));
  cv::sepFilter2D(grey, slope_, CV_32F, one,
                  both_sides(gaussian_kernels(sigma).first, true, CV_32F), {-1, -1}, 0,
                  cv::BORDER_REFLECT_101);
  for (int column = 0; column < grey.cols; ++column) {
    if (highest_[column] - background_ < kLeastHeight) continue;
    for (int row = std::max(0, row_[column] - 3); row < std::min(grey.rows - 1, row_[column] + 3);
         ++row) {
      const float above = slope_.at<float>(row, column), below = slope_.at<float>(row + 1, column);
      if (!(above > 0 && below <= 0)) continue;
      centres.push_back({static_cast<double>(column), row + above / (above - below)});
      break;
    }
  }
}

}  // namespace arcstart::extraction
