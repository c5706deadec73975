// What a real image of a stripe running down it is measured by, without truth.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "services/extraction/stripe_extractor.hpp"

namespace arcstart::extraction {

// A folder of the real data; empty where it is not there. Root: the environment's ARCSTART_DATA, by
// default ../shared/data from the project's root.
std::filesystem::path real_data(const std::string& folder, const std::string& project);
std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder);  // png, by name

// Middle of the tallest white thing in each row, -1 where it is narrower than 7 px: rows that show
// the stripe beyond doubt.
std::vector<double> white_middles(const cv::Mat& grey);

// One a row, u < 0 for none.
using RowCentres = std::vector<cv::Point2d>;
RowCentres row_centres(const Stripe& stripe, int rows);  // the chosen ones

// Least-squares line through the centres of 60 rows, each where it is and not at its row's middle;
// its rms, perpendicular, in the median over windows; px. -1 where no window has 58 centres.
double line_rms(const RowCentres& centres);

// Share of the rows that show the stripe, `margin` and more from the border, with a centre nearer
// than 5 px to its middle.
double share_found(const RowCentres& centres, const cv::Mat& grey, int margin);

}  // namespace arcstart::extraction
