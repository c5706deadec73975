#include "services/seam_finding/scan/refusal_code.hpp"

#include <arcstart/seam_t.hpp>

namespace arcstart::seam_finding {
namespace {

using Code = Reason::Code;

constexpr struct {
  Code code;
  std::int16_t refusal;
} kRefusals[] = {
    {Code::kPlatesDoNotTouch, seam_t::PLATES_APART},
    {Code::kAngle, seam_t::WRONG_ANGLE},
    {Code::kNotConcave, seam_t::NOT_CONCAVE},
    {Code::kNotConvex, seam_t::NOT_CONVEX},
    {Code::kEdgeOfOnePlate, seam_t::EDGE_OF_ONE_PLATE},
    {Code::kEdgeOfBlock, seam_t::EDGE_OF_BLOCK},
    {Code::kTooMuchElse, seam_t::CLUTTERED},
    {Code::kFewStripesCross, seam_t::FEW_STRIPES_CROSS},
    {Code::kShortlySeen, seam_t::SEEN_TOO_SHORT},
    {Code::kEdgesNotStraight, seam_t::EDGES_NOT_STRAIGHT},
    {Code::kLapNotWanted, seam_t::LAP_NOT_WANTED},
    {Code::kButtNotWanted, seam_t::BUTT_NOT_WANTED},
    {Code::kGrooveNotWanted, seam_t::GROOVE_NOT_WANTED},
    {Code::kLapThickness, seam_t::WRONG_STEP},
    {Code::kUpperPlateNarrow, seam_t::UPPER_PLATE_NARROW},
    {Code::kGrooveAngle, seam_t::WRONG_GROOVE_ANGLE},
    {Code::kGapWidth, seam_t::GAP_TOO_WIDE},
    {Code::kNotParallel, seam_t::PLATES_NOT_PARALLEL},
    {Code::kFewStripesShow, seam_t::SHOWS_TOO_RARELY},
    {Code::kPlateNarrow, seam_t::PLATE_TOO_NARROW},
    {Code::kNoCloud, seam_t::POINTS_COINCIDE},
    {Code::kToolStoodStill, seam_t::TOOL_STOOD_STILL},
    {Code::kNoPlane, seam_t::NO_WORKPIECE},
    {Code::kBackgroundGoesOn, seam_t::ONLY_BACKGROUND},
    {Code::kOnePlane, seam_t::ONE_PLANE},
    {Code::kNoPair, seam_t::NO_PLANES_MEET},
    {Code::kFewStripesAtSeam, seam_t::FEW_STRIPES_AT_SEAM},
    {Code::kAngleBesideSeam, seam_t::WRONG_ANGLE_AT_SEAM},
    {Code::kStartBeforeScan, seam_t::START_BEFORE_SCAN},
    {Code::kStartMissing, seam_t::START_MISSING},
    {Code::kSimilarScores, seam_t::SEVERAL_SEAMS},
    {Code::kDrawsDisagree, seam_t::SURFACE_TOO_ROUGH},
    {Code::kSeamNotShown, seam_t::SEAM_NOT_SHOWN},
    {Code::kSeamNotCrossed, seam_t::SEAM_NOT_CROSSED},
    {Code::kNoEdgeAtSeam, seam_t::NO_EDGE_AT_SEAM},
    {Code::kPlateTooNarrow, seam_t::PLATE_IS_EDGE},
    {Code::kPlateNotShown, seam_t::PLATE_NOT_SHOWN},
    {Code::kPlateTurned, seam_t::PLATE_TURNED},
    {Code::kPlateRound, seam_t::PLATE_ROUND},
    {Code::kCornerRound, seam_t::CORNER_ROUND},
    {Code::kSeamTooShort, seam_t::SEAM_TOO_SHORT},
    // By the hundred alone: what helps is the same for all that a job may ask for.
    {Code::kOutsideBox, seam_t::CLEAN},
    {Code::kAcrossSearch, seam_t::CALL},
};

}  // namespace

std::int16_t refusal_code(const Reason& reason) {
  const Code code = reason.code == Code::kNoJoint ? reason.because : reason.code;
  for (const auto& one : kRefusals)
    if (one.code == code) return one.refusal;
  return 0;
}

}  // namespace arcstart::seam_finding
