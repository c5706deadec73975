#include "services/calibration/report/report_charts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace arcstart::calibration {
namespace {

constexpr int kWidth = 480, kHeight = 220;

std::string framed(const std::string& title, const std::string& inside, int width, int height) {
  return fmt::format(
      "<figure><figcaption>{}</figcaption><svg viewBox=\"0 0 {} {}\" "
      "width=\"{}\">{}</svg></figure>\n",
      escaped(title), width, height, kWidth, inside);
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char letters[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? letters[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string bar_chart(const std::string& title, const std::vector<std::string>& labels,
                      const std::vector<double>& values, double limit, const std::string& unit) {
  if (values.empty()) return "";
  const double top = std::max({*std::max_element(values.begin(), values.end()), limit, 1e-9});
  const double step = (kWidth - 20.0) / static_cast<double>(values.size());
  std::string inside;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double height = (kHeight - 50) * values[i] / top, x = 10 + step * static_cast<double>(i);
    inside += fmt::format(
        "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{} "
        "{:.4g} {}</title></rect><text x=\"{:.1f}\" y=\"{}\">{}</text>",
        limit > 0 && values[i] > limit ? "bad" : "bar", x + 0.15 * step, kHeight - 20 - height,
        0.7 * step, height, escaped(labels[i]), values[i], unit, x + step / 2, kHeight - 6,
        escaped(labels[i]));
  }
  if (limit > 0)
    inside += fmt::format("<line class=\"limit\" x1=\"0\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>",
                          kWidth, kHeight - 20 - (kHeight - 50) * limit / top,
                          kHeight - 20 - (kHeight - 50) * limit / top);
  return framed(fmt::format("{}; greatest {:.3g} {}", title,
                            *std::max_element(values.begin(), values.end()), unit),
                inside, kWidth, kHeight);
}

std::string arrow_chart(const std::string& title, int width, int height,
                        const std::vector<Arrow>& arrows, double times) {
  std::string inside =
      fmt::format("<rect class=\"frame\" width=\"{}\" height=\"{}\"/>", width, height);
  for (const Arrow& arrow : arrows) {
    const Eigen::Vector2d tip = arrow.from + times * arrow.by;
    inside += fmt::format(
        "<line class=\"arrow\" stroke-width=\"{:.1f}\" x1=\"{:.0f}\" y1=\"{:.0f}\" x2=\"{:.1f}\" "
        "y2=\"{:.1f}\"/>",
        width / 600.0, arrow.from.x(), arrow.from.y(), tip.x(), tip.y());
  }
  return framed(fmt::format("{}, {:.0f} times as long", title, times), inside, width, height);
}

std::string spot_chart(const std::string& title, const Eigen::Vector2d& low,
                       const Eigen::Vector2d& high, const std::vector<Spot>& spots,
                       const std::string& unit) {
  if (spots.empty()) return "";
  const Eigen::Vector2d extent = (high - low).cwiseMax(1e-9);
  // What is far taller than wide is drawn shorter, or a narrow field would fill pages.
  constexpr double kTallest = 420;
  const double across = (kWidth - 80) / extent.x();
  const Eigen::Vector2d scale(across, std::min(across, kTallest / extent.y()));
  const double drawn = extent.y() * scale.y() + 60;
  const auto [least, most] = std::minmax_element(
      spots.begin(), spots.end(), [](const Spot& a, const Spot& b) { return a.value < b.value; });
  std::string inside;
  for (const Spot& spot : spots) {
    const double share = (spot.value - least->value) / std::max(1e-12, most->value - least->value);
    const Eigen::Vector2d at = scale.cwiseProduct(spot.at - low) + Eigen::Vector2d(40, 30);
    inside += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"17\" fill=\"rgb({:.0f},{:.0f},{:.0f})\"/><text "
        "x=\"{:.1f}\" y=\"{:.1f}\">{:.3f}</text>",
        at.x(), at.y(), 230.0, 230 - 140 * share, 230 - 160 * share, at.x(), at.y() + 4,
        spot.value);
  }
  return framed(title + ", " + unit, inside, kWidth, static_cast<int>(drawn));
}

std::string picture(const std::string& title, const cv::Mat& grey,
                    const std::vector<Eigen::Vector2d>& circles,
                    const std::vector<Eigen::Vector2d>& dots) {
  const double scale = double{kWidth} / grey.cols;
  cv::Mat small, colour;
  cv::resize(grey, small, {}, scale, scale, cv::INTER_AREA);
  double darkest = 0, brightest = 255;
  cv::minMaxLoc(small, &darkest, &brightest);
  small.convertTo(small, CV_8U, 255 / std::max(1.0, brightest));
  cv::cvtColor(small, colour, cv::COLOR_GRAY2BGR);
  const auto place = [&](const Eigen::Vector2d& p) {
    return cv::Point(cvRound(16 * scale * p.x()), cvRound(16 * scale * p.y()));
  };
  for (const auto& p : circles)
    cv::circle(colour, place(p), 16 * 4, {60, 200, 60}, 1, cv::LINE_AA, 4);
  for (const auto& p : dots) cv::circle(colour, place(p), 20, {60, 60, 240}, -1, cv::LINE_AA, 4);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", colour, bytes, {cv::IMWRITE_JPEG_QUALITY, 75});
  return fmt::format(
      "<figure><figcaption>{}</figcaption><img width=\"{}\" "
      "src=\"data:image/jpeg;base64,{}\"></figure>\n",
      escaped(title), kWidth, base64(bytes));
}

}  // namespace arcstart::calibration
