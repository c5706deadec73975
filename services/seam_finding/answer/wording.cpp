#include "services/seam_finding/answer/wording.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/geometry.hpp"

namespace arcstart::seam_finding {
namespace {

using Code = Reason::Code;

std::string about_a_joint(const Reason& reason) {
  switch (reason.code) {
    case Code::kPlatesDoNotTouch:
      return "the plates do not touch";
    case Code::kAngle:
      return fmt::format("its angle is {:.1f} deg", reason.number / kDegree);
    case Code::kNotConcave:
      return "its edge is not concave";
    case Code::kNotConvex:
      return "its edge is not convex";
    case Code::kEdgeOfOnePlate:
      return "it is the edge of one plate";
    case Code::kEdgeOfBlock:
      return "it is the edge of a solid block";
    case Code::kTooMuchElse:
      return "too much else lies around it";
    case Code::kFewStripesCross:
      return fmt::format("only {:.0f} stripes cross both plates", reason.number);
    case Code::kShortlySeen:
      return fmt::format("both plates were seen on {:.0f} mm only", reason.number);
    case Code::kEdgesNotStraight:
      return "its edges are not straight";
    case Code::kLapNotWanted:
      return "a lap is not wanted";
    case Code::kButtNotWanted:
      return "a butt joint is not wanted";
    case Code::kGrooveNotWanted:
      return "it is a groove";
    case Code::kLapThickness:
      return fmt::format("its step is {:.1f} mm", reason.number);
    case Code::kUpperPlateNarrow:
      return "the upper plate is narrower than a plate is";
    case Code::kGrooveAngle:
      return fmt::format("its groove opens by {:.0f} deg", reason.number / kDegree);
    case Code::kGapWidth:
      return fmt::format("its gap is {:.1f} mm", reason.number);
    case Code::kNotParallel:
      return "its plates are not parallel";
    case Code::kFewStripesShow:
      return fmt::format("it shows in {:.0f} % of the stripes only", 100 * reason.number);
    case Code::kPlateNarrow:
      return "one of its plates is too narrow";
    case Code::kScoreTooNear:
      return "its score is too near the best";
    case Code::kScoreLower:
      return "its score is lower";
    case Code::kAnotherScoreTooNear:
      return "another's score is too near";
    case Code::kFewDrawsAgree:
      return "too few draws agree on it";
    default:
      return "";
  }
}

std::string about_no_seam(const Reason& reason) {
  switch (reason.code) {
    case Code::kNoCloud:
      return "no cloud: the points, or the tool's positions, coincide";
    case Code::kToolStoodStill:
      return "the tool did not move in the scan";
    case Code::kNoPlane:
      return fmt::format(
          "no workpiece: no plane among the {:.0f} of {:.0f} points that are not background",
          reason.number, reason.of);
    case Code::kBackgroundGoesOn:
      return "no workpiece: what is left only continues the background";
    case Code::kOnePlane:
      return "one plane only: a joint needs two";
    case Code::kNoPair:
      return fmt::format("no joint: of {:.0f} planes no two meet under the angle wanted",
                         reason.number);
    case Code::kNoJoint:
      return "no joint: of the best pair of planes " +
             about_a_joint({reason.because, reason.number});
    case Code::kFewStripesAtSeam:
      return fmt::format("only {:.0f} stripes show both plates at the seam", reason.number);
    case Code::kAngleBesideSeam:
      return fmt::format("no joint: beside the seam the plates' angle is {:.1f} deg",
                         reason.number / kDegree);
    case Code::kStartBeforeScan:
      return "the seam's start was not seen: both plates are there where the scan begins";
    case Code::kStartMissing:
      return fmt::format("the seam's start was not seen: {:.0f} stripes before it are missing",
                         reason.number);
    case Code::kSimilarScores:
      return fmt::format("{:.0f} seams with scores within a factor of {}", reason.number,
                         reason.of);
    case Code::kDrawsDisagree:
      return fmt::format(
          "no surface is smooth enough: of {:.0f} draws of its planes {:.0f} give a seam, and "
          "{:.0f} of them the same one",
          reason.of, reason.number, reason.most);
    case Code::kSeamNotShown:
      return fmt::format(
          "the stripes contradict the seam that was found: {:.0f} of {:.0f} along it show both "
          "plates",
          reason.number, reason.of);
    case Code::kSeamNotCrossed:
      return "the stripes run along the seam that was found: they cannot tell it";
    case Code::kNoEdgeAtSeam:
      return fmt::format(
          "the stripes contradict the seam that was found: {:.0f} of {:.0f} leave a plate there",
          reason.number, reason.of);
    case Code::kPlateTooNarrow:
      return fmt::format(
          "the stripes contradict the seam that was found: a plate is {:.1f} mm wide, as an edge "
          "is",
          reason.number);
    case Code::kPlateNotShown:
      return "the stripes contradict the seam that was found: they do not show one of its plates";
    case Code::kPlateTurned:
      return fmt::format(
          "the stripes contradict the seam that was found: a plate is turned by {:.2f} deg to it",
          std::abs(reason.number) / kDegree);
    case Code::kPlateRound:
      return fmt::format(
          "the stripes contradict the seam that was found: a plate is round, its radius {:.0f} mm",
          reason.number);
    case Code::kCornerRound:
      return fmt::format(
          "the stripes contradict the seam that was found: its corner is round, its radius {:.1f} "
          "mm: one piece, rolled or bent, or welded already",
          reason.number);
    case Code::kSeamTooShort:
      return fmt::format(
          "the seam that was found is {:.0f} mm long, none shorter than {:.0f} mm is wanted",
          reason.number, reason.of);
    default:
      return about_a_joint(reason);
  }
}

std::string about_a_checked_end(const Reason& reason) {
  switch (reason.code) {
    case Code::kStartContradicted:
      return fmt::format("the start is not there: the stripes show the plates' ends {:.1f} mm off",
                         reason.number);
    case Code::kEndContradicted:
      return fmt::format("the end is not there: the stripes show the plates' ends {:.1f} mm off",
                         reason.number);
    case Code::kStartNotShown:
      return "no stripes beside the start show both plates";
    case Code::kEndNotShown:
      return "no stripes beside the end show both plates";
    case Code::kStartLooselyBounded:
      return fmt::format("the stripes leave it open where the start lies, within {:.1f} mm",
                         reason.number);
    case Code::kEndLooselyBounded:
      return fmt::format("the stripes leave it open where the end lies, within {:.1f} mm",
                         reason.number);
    case Code::kStartBounded:
      return fmt::format("the stripes bound the start to {:.1f} mm", reason.number);
    case Code::kEndBounded:
      return fmt::format("the stripes bound the end to {:.1f} mm", reason.number);
    default:
      return about_no_seam(reason);
  }
}

}  // namespace

std::string in_words(const Reason& reason) {
  switch (reason.code) {
    case Code::kMissingBeforeStart:
      return fmt::format("{:.0f} stripes right before the start are missing", reason.number);
    case Code::kMissingAfterEnd:
      return fmt::format("{:.0f} stripes right behind the end are missing", reason.number);
    case Code::kStartHidden:
      return "the start is hidden, the seam reaches at least so far";
    case Code::kEndHidden:
      return "the end is hidden, the seam reaches at least so far";
    case Code::kStartOutside:
      return "the seam runs on where the scan begins";
    case Code::kEndOutside:
      return "the seam runs on where the scan ends";
    case Code::kStartUncertain:
      return "the start was not seen well and may lie elsewhere";
    case Code::kEndUncertain:
      return "the end was not seen well and may lie elsewhere";
    case Code::kStartBetweenStripes:
      return "the start is known to half a stripe spacing, no stripe crosses an edge there";
    case Code::kEndBetweenStripes:
      return "the end is known to half a stripe spacing, no stripe crosses an edge there";
    case Code::kThickness:
      return fmt::format("the upper plate is {:.1f} mm thick", reason.number);
    case Code::kGroove:
      return fmt::format("the groove opens by {:.0f} deg, its gap is given at the top",
                         reason.number / kDegree);
    case Code::kNoGap:
      return "gap not determined";
    case Code::kGapLikeNone:
      return "the gap cannot be told from none";
    default:
      return about_a_checked_end(reason);
  }
}

std::string in_words(const std::vector<Reason>& remarks) {
  std::string text;
  for (const Reason& remark : remarks) text += in_words(remark) + "; ";
  return text;
}

}  // namespace arcstart::seam_finding
