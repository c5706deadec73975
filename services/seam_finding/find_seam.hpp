// From the points of a scan to the weld seam and where it starts (paper 5).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "services/seam_finding/accuracy.hpp"
#include "services/seam_finding/background.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"
#include "services/seam_finding/seam_survey.hpp"
#include "services/seam_finding/thinned_cloud.hpp"
#include "services/seam_finding/torch.hpp"

namespace arcstart {

struct SeamResult {
  enum class Verdict { kFound, kAmbiguous, kRefused };
  Verdict verdict = Verdict::kRefused;
  std::string reason;  // why, where not found
  std::string remark;  // what a person should know of a found one

  // Where found. In base, mm and rad.
  std::string joint_type;
  Eigen::Vector3d start = Eigen::Vector3d::Zero(), end = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // unit, along the search
  std::array<Eigen::Vector3d, 2> normals = {Eigen::Vector3d::Zero(),
                                            Eigen::Vector3d::Zero()};  // out of the metal
  double angle = 0;  // between the plates' open sides; of a groove, between its slants
  double gap = -1, gap_deviation = -1;  // mean along the seam; of a groove, its width at the top
  EndVisibility start_visibility = EndVisibility::kNotDetermined;
  EndVisibility end_visibility = EndVisibility::kNotDetermined;
  std::optional<SeamAccuracy> accuracy;  // nothing where it was not determined
  Polyline course;
  std::vector<SurveyPlace> stations;  // along counts from the start
  std::optional<TorchPose> torch;
  std::array<std::vector<int>, 2> plates;  // indices of the plates' points

  // Other seams, and where ambiguous all of them, best first.
  struct Alternative {
    std::string joint_type;
    double score = 0;
    Eigen::Vector3d start, end;
    std::string reason;  // why it is not the answer
  };
  std::vector<Alternative> alternatives;

  std::vector<int> background;  // indices of the points taken for background
};

// A cloud's points by whether they are background, indices, rising.
struct Division {
  std::vector<int> background, left;
  int size() const { return static_cast<int>(background.size() + left.size()); }
};
// Goes on behind the last point that is divided already: a scan can be divided stripe by stripe.
void divide(const ScanCloud& scan, const Background& background, Division& division);

// The whole way: background, planes, joints, refit beside the seam, start. Refuses with a reason
// when in doubt. The result depends on nothing but the arguments; seed: the scan's id.
SeamResult find_seam(const ScanCloud& scan, const Background& background,
                     const SeamFindingSettings& settings, std::uint64_t seed);
// The same of a scan that is divided and thinned; leaves the result's background to the division.
SeamResult find_seam(const ScanCloud& scan, const Division& division, const ThinnedCloud& thinned,
                     const SeamFindingSettings& settings, std::uint64_t seed);

// Takes nothing for background.
class NoBackground : public Background {
 public:
  bool contains(const Eigen::Vector3d&) const override { return false; }
};

}  // namespace arcstart
