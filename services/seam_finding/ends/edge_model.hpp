// How likely the stripes' evidence is where a plate ends at a straight edge of a given slope.
#pragma once

#include <optional>
#include <vector>

#include "services/seam_finding/ends/edge_hypotheses.hpp"
#include "services/seam_finding/ends/plate_evidence.hpp"

namespace arcstart::seam_finding {

// Crossings that tell an edge.
struct EdgeTold {
  int crossings = 0, occluded = 0;  // of which what is seen next stands before the plate
  double common = 0;                // mean of the deviations that they have in common; mm
};

// Logarithms over the grid's places of the edge's foot. What is seen on the plate and past it, and
// what is not seen at all, are steps; a stripe that leaves the plate over the edge is a peak, which
// counts in place of what the steps say of it. evidence must outlive the model.
class EdgeModel {
 public:
  EdgeModel(const std::vector<StripeEvidence>& evidence, const PlaceGrid& grid);

  std::vector<double> steps(double slope) const;
  void add_peaks(double slope, double roughness, std::vector<double>& log) const;
  EdgeTold told_at(double place, double slope, double roughness) const;

 private:
  class Steps;
  void add_peak(const EdgeCrossing& edge, bool covered, double slope, double roughness,
                std::vector<double>& log) const;
  std::optional<double> seen_past_before(double limit, double away, double slope) const;
  void add_on(const StripeEvidence& stripe, double slope, Steps& log) const;

  const std::vector<StripeEvidence>& evidence_;
  PlaceGrid grid_;
  std::vector<Stretch> offs_;  // of all stripes
};

}  // namespace arcstart::seam_finding
