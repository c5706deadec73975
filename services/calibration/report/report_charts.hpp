// Small pictures in SVG and JPEG for a page of HTML, each a complete element.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace arcstart::calibration {

std::string escaped(const std::string& text);  // for HTML

// A bar a value, labelled below, with a dashed line at the limit where that is above 0.
std::string bar_chart(const std::string& title, const std::vector<std::string>& labels,
                      const std::vector<double>& values, double limit, const std::string& unit);

// Arrows from points of an image, `times` longer than they are.
struct Arrow {
  Eigen::Vector2d from, by;
};
std::string arrow_chart(const std::string& title, int width, int height,
                        const std::vector<Arrow>& arrows, double times);

// Coloured spots with their value, pale for the least and red for the greatest.
struct Spot {
  Eigen::Vector2d at;
  double value;
};
std::string spot_chart(const std::string& title, const Eigen::Vector2d& low,
                       const Eigen::Vector2d& high, const std::vector<Spot>& spots,
                       const std::string& unit);

// The image with marks, reduced to 480 px across.
std::string picture(const std::string& title, const cv::Mat& grey,
                    const std::vector<Eigen::Vector2d>& circles,
                    const std::vector<Eigen::Vector2d>& dots);

}  // namespace arcstart::calibration
