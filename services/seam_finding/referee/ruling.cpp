#include "services/seam_finding/referee/ruling.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "services/seam_finding/referee/constants.hpp"

namespace arcstart::seam_finding {
namespace {

using Code = Reason::Code;

// Replaces the covariance's part along the seam.
void set_variance_along(const Eigen::Vector3d& along, double variance, Eigen::Matrix3d& matrix) {
  matrix += (variance - along.dot(matrix * along)) * along * along.transpose();
}

// How far the edges of plates side by side lie beside the seam, at its ends; mm across it.
struct BesideSeam {
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  double at_start = 0, at_end = 0;
};

// The seam lies in the middle of their edges, or at the upper one's. Nothing where none is known.
std::optional<BesideSeam> beside_seam(const Examination& examination, const SeamResult& seam) {
  BesideSeam beside;
  double plates = 0;
  for (int j = 0; j < 2; ++j) {
    if (!examination.edges[j] || !examination.edges[j]->known) continue;
    const SeamEdges& edges = *examination.edges[j];
    const double sign = plates == 0 ? 1 : -1;
    beside.at_start += sign * edges.at_start, beside.at_end += sign * edges.at_end;
    if (plates == 0) beside.across = seam.faces[j].away;
    ++plates;
  }
  if (plates == 0) return std::nullopt;
  beside.at_start /= plates, beside.at_end /= plates;
  return beside;
}

// Edges that lie beside the seam by more at one end than at the other are turned against it.
void widen_direction(const Examination& examination, SeamResult& seam) {
  const auto edges = beside_seam(examination, seam);
  if (!edges || !seam.accuracy || seam.accuracy->direction < 0) return;
  const double apart = edges->at_end - edges->at_start;
  if (std::abs(apart) > kReferee.place)
    seam.accuracy->direction =
        std::hypot(seam.accuracy->direction, apart / (seam.end - seam.start).norm());
}

class EndRuling {
 public:
  EndRuling(const Examination& examination, bool start, SeamResult& seam)
      : examination_(examination),
        bounds_(examination.ends[start ? 0 : 1]),
        start_(start),
        seam_(seam) {}

  void rule() {
    // Between crossing or parallel plates alike: off what is claimed across the seam.
    for (int j = 0; j < 2; ++j) widen_across(j);
    widen_beside();
    if (visibility() == EndVisibility::kNotDetermined) return without_deviation();
    if (!bounds_.anchored) return undetermined(Code::kStartNotShown, Code::kEndNotShown, 0);
    const double allowed = std::max(kReferee.allowed, kFit.outlier * claimed_deviation());
    if (bounds_.least > allowed) return contradicted(bounds_.least);
    if (bounds_.most < -allowed) return contradicted(bounds_.most);
    const double farthest = std::max(bounds_.most, -bounds_.least);
    if (farthest <= allowed) return;
    const bool open =
        visibility() == EndVisibility::kOutside || visibility() == EndVisibility::kHidden;
    if (open) return without_deviation();
    if (!(farthest <=
          std::max(kReferee.always_determined, kReferee.determined * examination_.spacing)))
      return undetermined(Code::kStartLooselyBounded, Code::kEndLooselyBounded,
                          std::min(farthest, kReferee.reach));
    set_reach(farthest);
    remark(Code::kStartBounded, Code::kEndBounded, farthest);
  }

 private:
  EndVisibility& visibility() { return start_ ? seam_.start_visibility : seam_.end_visibility; }
  Eigen::Matrix3d& covariance() { return start_ ? seam_.accuracy->start : seam_.accuracy->end; }
  void remark(Code start, Code end, double number) {
    seam_.remarks.push_back({start_ ? start : end, number});
  }

  double claimed_deviation() {
    if (!seam_.accuracy) return 0;
    return std::sqrt(std::max(0.0, seam_.direction.dot(covariance() * seam_.direction)));
  }

  void contradicted(double by) {
    SecondPlace& second = start_ ? seam_.start_second : seam_.end_second;
    const double least = std::max(bounds_.least, -kReferee.reach),
                 most = std::min(bounds_.most, kReferee.reach);
    second.place = (start_ ? seam_.start : seam_.end) +
                   (start_ ? -1 : 1) * (least + most) / 2 * seam_.direction;
    second.weight = kReferee.second_weight;
    undetermined(Code::kStartContradicted, Code::kEndContradicted, std::abs(by));
  }

  // Of an end that is not known there is no deviation: what the stripes leave is in the second
  // place.
  void undetermined(Code start, Code end, double number) {
    visibility() = EndVisibility::kNotDetermined;
    without_deviation();
    remark(start, end, number);
  }

  void without_deviation() {
    if (seam_.accuracy) covariance().setConstant(-1);
  }

  // The farthest place where the end may be.
  void set_reach(double farthest) {
    if (!seam_.accuracy) return;
    const double deviation = farthest / kFit.outlier;
    set_variance_along(seam_.direction, deviation * deviation, covariance());
  }

  void widen_across(int j) {
    const PlateShape& shape = examination_.shapes[j];
    if (!shape.known || !seam_.accuracy) return;
    const double off = shape.height_at_seam(start_ ? 0 : 2 * shape.half);
    if (std::abs(off) < kReferee.allowed / 2) return;
    covariance() += off * off * seam_.normals[j] * seam_.normals[j].transpose();
  }

  void widen_beside() {
    const auto edges = beside_seam(examination_, seam_);
    if (!edges || !seam_.accuracy) return;
    const double off = start_ ? edges->at_start : edges->at_end;
    if (std::abs(off) > kReferee.place)
      covariance() += off * off * edges->across * edges->across.transpose();
  }

  const Examination& examination_;
  const EndBounds& bounds_;
  bool start_;
  SeamResult& seam_;
};

}  // namespace

void rule(const Examination& examination, SeamResult& seam) {
  if (examination.stripes == 0 && !examination.contradiction) return;
  seam.checked.stripes = examination.stripes;
  seam.checked.explained = examination.explained;
  seam.checked.worst = 0;
  for (const EndBounds& end : examination.ends)
    seam.checked.worst = std::max({seam.checked.worst, end.least, -end.most});
  if (examination.contradiction) {
    SeamResult refused;
    refused.reason = examination.contradiction;
    refused.checked = seam.checked;
    refused.alternatives = std::move(seam.alternatives);
    refused.background = std::move(seam.background);
    seam = std::move(refused);
    return;
  }
  widen_direction(examination, seam);
  EndRuling(examination, true, seam).rule();
  EndRuling(examination, false, seam).rule();
}

}  // namespace arcstart::seam_finding
