// What was found in a cloud from a file, for people.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "services/seam_finding/model/scan_cloud.hpp"
#include "services/seam_finding/model/seam.hpp"

namespace arcstart::command_line {

// "(1.50, 2.00, -0.25)"
std::string in_words(const Eigen::Vector3d& v, int decimals);

// The verdict with start, end and their deviations, then a line a remark and a line a second seam.
std::vector<std::string> answer_lines(const seam_finding::SeamResult& result);

// A PNG of the cloud from two sides: background, plates, seam and start. cloud_name stands over it.
// Throws PointCloudFileError.
void draw_answer(const seam_finding::ScanCloud& cloud, const seam_finding::SeamResult& result,
                 const std::optional<Plane>& dominant_plane, const std::string& cloud_name,
                 const std::string& path);

// CSV of what was measured along the seam, a line a place. Throws PointCloudFileError where it
// cannot be written.
void write_stations(const seam_finding::SeamResult& result, const std::string& path);

}  // namespace arcstart::command_line
