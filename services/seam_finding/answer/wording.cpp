#include "services/seam_finding/answer/wording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"

namespace arcstart::seam_finding {
namespace {

using Code = Reason::Code;

// {n}, {of}, {most}: the reason's numbers; {deg}: the first one, without its sign, in degrees.
constexpr struct {
  Code code;
  const char* words;
} kWords[] = {
    {Code::kPlatesDoNotTouch, "the plates do not touch"},
    {Code::kAngle, "its angle is {deg:.1f} deg"},
    {Code::kNotConcave, "its edge is not concave"},
    {Code::kNotConvex, "its edge is not convex"},
    {Code::kEdgeOfOnePlate, "it is the edge of one plate"},
    {Code::kEdgeOfBlock, "it is the edge of a solid block"},
    {Code::kTooMuchElse, "too much else lies around it"},
    {Code::kFewStripesCross, "only {n:.0f} stripes cross both plates"},
    {Code::kShortlySeen, "both plates were seen on {n:.0f} mm only"},
    {Code::kEdgesNotStraight, "its edges are not straight"},
    {Code::kLapNotWanted, "a lap is not wanted"},
    {Code::kButtNotWanted, "a butt joint is not wanted"},
    {Code::kGrooveNotWanted, "it is a groove"},
    {Code::kLapThickness, "its step is {n:.1f} mm"},
    {Code::kUpperPlateNarrow, "the upper plate is narrower than a plate is"},
    {Code::kGrooveAngle, "its groove opens by {deg:.0f} deg"},
    {Code::kGapWidth, "its gap is {n:.1f} mm"},
    {Code::kNotParallel, "its plates are not parallel"},
    {Code::kFewStripesShow, "it shows in {percent:.0f} % of the stripes only"},
    {Code::kPlateNarrow, "one of its plates is too narrow"},
    {Code::kScoreTooNear, "its score is too near the best"},
    {Code::kScoreLower, "its score is lower"},
    {Code::kAnotherScoreTooNear, "another's score is too near"},
    {Code::kFewDrawsAgree, "too few draws agree on it"},
    {Code::kNoCloud, "no cloud: the points, or the tool's positions, coincide"},
    {Code::kToolStoodStill, "the tool did not move in the scan"},
    {Code::kNoPlane,
     "no workpiece: no plane among the {n:.0f} of {of:.0f} points that are not background"},
    {Code::kBackgroundGoesOn, "no workpiece: what is left only continues the background"},
    {Code::kOnePlane, "one plane only: a joint needs two"},
    {Code::kNoPair, "no joint: of {n:.0f} planes no two make the joint wanted"},
    {Code::kNoJoint, "no joint: of the best pair of planes {because}"},
    {Code::kFewStripesAtSeam, "only {n:.0f} stripes show both plates at the seam"},
    {Code::kAngleBesideSeam, "no joint: beside the seam the plates' angle is {deg:.1f} deg"},
    {Code::kStartBeforeScan,
     "the seam's start was not seen: both plates are there where the scan begins"},
    {Code::kStartMissing, "the seam's start was not seen: {n:.0f} stripes before it are missing"},
    {Code::kSimilarScores, "{n:.0f} seams with scores within a factor of {of}"},
    {Code::kDrawsDisagree,
     "no surface is smooth enough: of {of:.0f} draws of its planes {n:.0f} give a seam, and "
     "{most:.0f} of them the same one"},
    {Code::kSeamNotShown, "{contradict}: {n:.0f} of {of:.0f} along it show both plates"},
    {Code::kSeamNotCrossed, "the stripes run along the seam that was found: they cannot tell it"},
    {Code::kNoEdgeAtSeam, "{contradict}: {n:.0f} of {of:.0f} leave a plate there"},
    {Code::kPlateTooNarrow, "{contradict}: a plate is {n:.1f} mm wide, as an edge is"},
    {Code::kPlateNotShown, "{contradict}: they do not show one of its plates"},
    {Code::kPlateTurned, "{contradict}: a plate is turned by {deg:.2f} deg to it"},
    {Code::kPlateRound, "{contradict}: a plate is round, its radius {n:.0f} mm"},
    {Code::kCornerRound,
     "{contradict}: its corner is round, its radius {n:.1f} mm: one piece, rolled or bent, or "
     "welded already"},
    {Code::kSeamTooShort,
     "the seam that was found is {n:.0f} mm long, none shorter than {of:.0f} mm is wanted"},
    {Code::kStartContradicted,
     "the start is not there: the stripes show the plates' ends {n:.1f} mm off"},
    {Code::kEndContradicted,
     "the end is not there: the stripes show the plates' ends {n:.1f} mm off"},
    {Code::kStartNotShown, "no stripes beside the start show both plates"},
    {Code::kEndNotShown, "no stripes beside the end show both plates"},
    {Code::kStartLooselyBounded,
     "the stripes leave it open where the start lies, within {n:.1f} mm"},
    {Code::kEndLooselyBounded, "the stripes leave it open where the end lies, within {n:.1f} mm"},
    {Code::kStartBounded, "the stripes bound the start to {n:.1f} mm"},
    {Code::kEndBounded, "the stripes bound the end to {n:.1f} mm"},
    {Code::kMissingBeforeStart, "{n:.0f} stripes right before the start are missing"},
    {Code::kMissingAfterEnd, "{n:.0f} stripes right behind the end are missing"},
    {Code::kStartHidden, "the start is hidden, the seam reaches at least so far"},
    {Code::kEndHidden, "the end is hidden, the seam reaches at least so far"},
    {Code::kStartOutside, "the seam runs on where the scan begins"},
    {Code::kEndOutside, "the seam runs on where the scan ends"},
    {Code::kStartUncertain, "the start was not seen well and may lie elsewhere"},
    {Code::kEndUncertain, "the end was not seen well and may lie elsewhere"},
    {Code::kStartBetweenStripes,
     "the start is known to half a stripe spacing, no stripe crosses an edge there"},
    {Code::kEndBetweenStripes,
     "the end is known to half a stripe spacing, no stripe crosses an edge there"},
    {Code::kThickness, "the upper plate is {n:.1f} mm thick"},
    {Code::kGroove, "the groove opens by {deg:.0f} deg, its gap is given at the top"},
    {Code::kNoGap, "gap not determined"},
    {Code::kGapLikeNone, "the gap cannot be told from none"},
    {Code::kOutsideBox, "its seam lies outside the search box, by {n:.1f} mm"},
    {Code::kAcrossSearch,
     "the seam runs at {deg:.0f} deg to the search direction that is set: which of its ends is the "
     "start cannot be told"},
    {Code::kTorchThroughPlate,
     "with the orientation that was taught the torch would come through a plate: no torch pose"},
    {Code::kStartDeviationLarge,
     "the start is known to {n:.2f} mm, {of:.2f} mm are allowed (end_deviation_max_mm)"},
    {Code::kEndDeviationLarge,
     "the end is known to {n:.2f} mm, {of:.2f} mm are allowed (end_deviation_max_mm)"},
    {Code::kFloorNearTop, "a floor is seen in the gap: it may be a line in one plate"},
};

}  // namespace

std::string in_words(const Reason& reason) {
  const auto found = std::find_if(std::begin(kWords), std::end(kWords),
                                  [&](const auto& one) { return one.code == reason.code; });
  if (found == std::end(kWords)) return "";
  const std::string because =
      reason.because == Code::kNone ? "" : in_words({reason.because, reason.number});
  return fmt::format(fmt::runtime(found->words), fmt::arg("n", reason.number),
                     fmt::arg("of", reason.of), fmt::arg("most", reason.most),
                     fmt::arg("deg", std::abs(reason.number) / kDegree),
                     fmt::arg("percent", 100 * reason.number), fmt::arg("because", because),
                     fmt::arg("contradict", "the stripes contradict the seam that was found"));
}

std::string in_words(const std::vector<Reason>& remarks) {
  std::string text;
  for (const Reason& remark : remarks) text += in_words(remark) + "; ";
  return text;
}

}  // namespace arcstart::seam_finding
