#include "services/seam_finding/scan/refusal_code.hpp"

#include <arcstart/seam_t.hpp>

namespace arcstart::seam_finding {

std::int16_t refusal_code(const Reason& reason) {
  using Code = Reason::Code;
  switch (reason.code) {
    case Code::kPlatesDoNotTouch:
      return seam_t::PLATES_APART;
    case Code::kAngle:
      return seam_t::WRONG_ANGLE;
    case Code::kNotConcave:
      return seam_t::NOT_CONCAVE;
    case Code::kNotConvex:
      return seam_t::NOT_CONVEX;
    case Code::kEdgeOfOnePlate:
      return seam_t::EDGE_OF_ONE_PLATE;
    case Code::kEdgeOfBlock:
      return seam_t::EDGE_OF_BLOCK;
    case Code::kTooMuchElse:
      return seam_t::CLUTTERED;
    case Code::kFewStripesCross:
      return seam_t::FEW_STRIPES_CROSS;
    case Code::kShortlySeen:
      return seam_t::SEEN_TOO_SHORT;
    case Code::kEdgesNotStraight:
      return seam_t::EDGES_NOT_STRAIGHT;
    case Code::kLapNotWanted:
      return seam_t::LAP_NOT_WANTED;
    case Code::kButtNotWanted:
      return seam_t::BUTT_NOT_WANTED;
    case Code::kGrooveNotWanted:
      return seam_t::GROOVE_NOT_WANTED;
    case Code::kLapThickness:
      return seam_t::WRONG_STEP;
    case Code::kUpperPlateNarrow:
      return seam_t::UPPER_PLATE_NARROW;
    case Code::kGrooveAngle:
      return seam_t::WRONG_GROOVE_ANGLE;
    case Code::kGapWidth:
      return seam_t::GAP_TOO_WIDE;
    case Code::kNotParallel:
      return seam_t::PLATES_NOT_PARALLEL;
    case Code::kFewStripesShow:
      return seam_t::SHOWS_TOO_RARELY;
    case Code::kPlateNarrow:
      return seam_t::PLATE_TOO_NARROW;
    case Code::kNoCloud:
      return seam_t::POINTS_COINCIDE;
    case Code::kToolStoodStill:
      return seam_t::TOOL_STOOD_STILL;
    case Code::kNoPlane:
      return seam_t::NO_WORKPIECE;
    case Code::kBackgroundGoesOn:
      return seam_t::ONLY_BACKGROUND;
    case Code::kOnePlane:
      return seam_t::ONE_PLANE;
    case Code::kNoPair:
      return seam_t::NO_PLANES_MEET;
    case Code::kFewStripesAtSeam:
      return seam_t::FEW_STRIPES_AT_SEAM;
    case Code::kAngleBesideSeam:
      return seam_t::WRONG_ANGLE_AT_SEAM;
    case Code::kStartBeforeScan:
      return seam_t::START_BEFORE_SCAN;
    case Code::kStartMissing:
      return seam_t::START_MISSING;
    case Code::kSimilarScores:
      return seam_t::SEVERAL_SEAMS;
    case Code::kDrawsDisagree:
      return seam_t::SURFACE_TOO_ROUGH;
    case Code::kSeamNotShown:
      return seam_t::SEAM_NOT_SHOWN;
    case Code::kSeamNotCrossed:
      return seam_t::SEAM_NOT_CROSSED;
    case Code::kNoEdgeAtSeam:
      return seam_t::NO_EDGE_AT_SEAM;
    case Code::kPlateTooNarrow:
      return seam_t::PLATE_IS_EDGE;
    case Code::kPlateNotShown:
      return seam_t::PLATE_NOT_SHOWN;
    case Code::kPlateTurned:
      return seam_t::PLATE_TURNED;
    case Code::kPlateRound:
      return seam_t::PLATE_ROUND;
    case Code::kCornerRound:
      return seam_t::CORNER_ROUND;
    case Code::kSeamTooShort:
      return seam_t::SEAM_TOO_SHORT;
    case Code::kNoJoint:
      return refusal_code({reason.because, reason.number});
    default:
      return 0;
  }
}

}  // namespace arcstart::seam_finding
