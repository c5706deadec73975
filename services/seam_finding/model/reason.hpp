// Why there is no joint or no seam, and what a person should know of one that was found: codes with
// their numbers. What they say in words stands in answer/wording.
#pragma once

namespace arcstart::seam_finding {

struct Reason {
  enum class Code {
    kNone,

    // Of two plates: why they are no joint.
    kPlatesDoNotTouch,
    kAngle,            // number: the plates' angle; rad
    kNotConcave,       // of a tee or an inside corner
    kNotConvex,        // of an outside corner
    kEdgeOfOnePlate,   // no outside corner: the other plate is the edge face of the first
    kEdgeOfBlock,      // no outside corner: its end shows metal where two plates leave none
    kTooMuchElse,      // around it
    kFewStripesCross,  // number: stripes that cross both plates
    kShortlySeen,      // number: both plates; mm
    kEdgesNotStraight,
    kLapNotWanted,
    kButtNotWanted,
    kGrooveNotWanted,
    kLapThickness,      // number: of the upper plate; mm
    kUpperPlateNarrow,  // of a lap: narrower than a plate is
    kGrooveAngle,       // number: included angle; rad
    kGapWidth,          // number: mm
    kNotParallel,
    kFewStripesShow,  // number: share of the stripes, 0..1
    kPlateNarrow,

    // Of an alternative: why another is the answer, or none.
    kScoreTooNear,  // to the best one's
    kScoreLower,
    kAnotherScoreTooNear,  // to this one's, which is the best
    kFewDrawsAgree,        // on it

    // Why no seam is given.
    kNoCloud,  // points or positions coincide
    kToolStoodStill,
    kNoPlane,           // number, of: points left, of so many
    kBackgroundGoesOn,  // all that is left continues the background
    kOnePlane,
    kNoPair,            // number: planes, no two of which meet under the angle wanted
    kNoJoint,           // because: what the best pair's planes lack
    kFewStripesAtSeam,  // number: stripes with both plates there
    kAngleBesideSeam,   // number: rad
    kStartBeforeScan,   // both plates are there where the scan begins
    kStartMissing,      // number: stripes missing right before the start
    kSimilarScores,     // number, of: seams, within that factor
    kDrawsDisagree,     // number, of, most: draws with a seam, of so many, on the same one
    // The referee's: stripes show something else than the seam that was found.
    kSeamNotShown,    // number, of: stripes that show both plates, of those at the seam that tell
    kSeamNotCrossed,  // the stripes run along it
    kNoEdgeAtSeam,    // number, of: stripes that leave the plate at the seam, of so many there
    kPlateTooNarrow,  // number: its width; mm
    kPlateNotShown,   // hardly a point lies where a plate is claimed
    kPlateTurned,     // number: a plate's tilt against what is claimed; rad
    kPlateRound,      // number: radius; mm
    kCornerRound,     // number: radius of an outside corner; mm
    kSeamTooShort,    // number, of: its length, and the least that is wanted; mm

    // What a person should know of a seam that was found.
    kMissingBeforeStart,  // number: stripes
    kMissingAfterEnd,
    kStartHidden,
    kEndHidden,
    kStartOutside,  // the seam runs on beyond the scan
    kEndOutside,
    kStartUncertain,
    kEndUncertain,
    kStartBetweenStripes,  // known to half a stripe spacing
    kEndBetweenStripes,
    kThickness,     // number: of a lap's upper plate; mm
    kGroove,        // number: included angle; rad
    kNoGap,         // not determined
    kGapLikeNone,   // smaller than it is known to
    kFloorNearTop,  // between the plates: it may be a line in one
    // The referee's of an end. number: mm along the seam.
    kStartContradicted,  // by so much, at least: the seam ends elsewhere
    kEndContradicted,
    kStartNotShown,  // no run of stripes shows both plates near it
    kEndNotShown,
    kStartLooselyBounded,  // it may be off by so much, too much for an answer
    kEndLooselyBounded,
    kStartBounded,  // it may be off by so much
    kEndBounded,

    // Of the job: why a seam that was found is none of its, or how its torch would stand.
    kOutsideBox,         // number: mm outside the search box
    kAcrossSearch,       // number: angle between the seam and the search direction that is set; rad
    kTorchThroughPlate,  // with the orientation that was taught
    kStartDeviationLarge,  // number, of: mm, and the most that is allowed
    kEndDeviationLarge,
  };

  Code code = Code::kNone;
  double number = 0, of = 0, most = 0;
  Code because = Code::kNone;  // of kNoJoint; the numbers are that one's

  explicit operator bool() const { return code != Code::kNone; }
};

}  // namespace arcstart::seam_finding
