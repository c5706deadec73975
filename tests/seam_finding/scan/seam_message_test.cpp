#include "services/seam_finding/scan/seam_message.hpp"

#include <catch2/catch.hpp>

#include "common/bus/message_checks.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

using Verdict = SeamResult::Verdict;

SeamResult found_with(EndVisibility start, EndVisibility end) {
  SeamResult result;
  result.verdict = Verdict::kFound;
  result.joint_type = "tee";
  result.end = {100, 0, 0};
  result.direction = {1, 0, 0};
  result.start_visibility = start, result.end_visibility = end;
  return result;
}

seam_t told(const SeamResult& result) {
  seam_t seam = empty_seam();
  fill_in(seam, result);
  return seam;
}

int usable(EndVisibility start, EndVisibility end) { return told(found_with(start, end)).usable; }

}  // namespace

TEST_CASE("a seam is usable where both of its ends were seen") {
  using End = EndVisibility;
  CHECK(usable(End::kSeen, End::kSeen) == seam_t::USABLE);
  CHECK(usable(End::kSeen, End::kHidden) == seam_t::END_NOT_SEEN);
  CHECK(usable(End::kSeen, End::kOutside) == seam_t::END_NOT_SEEN);
  CHECK(usable(End::kSeen, End::kNotDetermined) == seam_t::END_UNSURE);
  // Of two ends the start is named.
  for (const End end : {End::kSeen, End::kHidden, End::kOutside, End::kNotDetermined}) {
    CHECK(usable(End::kHidden, end) == seam_t::START_NOT_SEEN);
    CHECK(usable(End::kOutside, end) == seam_t::START_NOT_SEEN);
    CHECK(usable(End::kNotDetermined, end) == seam_t::START_UNSURE);
  }
}

TEST_CASE("a seam of which the stripes contradict an end says so before all else") {
  using Code = Reason::Code;
  for (const Code code : {Code::kStartContradicted, Code::kEndContradicted}) {
    SeamResult result = found_with(EndVisibility::kNotDetermined, EndVisibility::kNotDetermined);
    result.remarks = {{Code::kNoGap}, {code, 4}};
    CHECK(told(result).usable == seam_t::CONTRADICTED);
  }
  SeamResult loose = found_with(EndVisibility::kNotDetermined, EndVisibility::kSeen);
  loose.remarks = {{Code::kStartLooselyBounded, 9}};
  CHECK(told(loose).usable == seam_t::START_UNSURE);
}

TEST_CASE("mismatch is told where it was measured") {
  SeamResult result = found_with(EndVisibility::kSeen, EndVisibility::kSeen);
  CHECK(told(result).mismatch == -1);
  result.mismatch = 0.75;
  CHECK(told(result).mismatch == 0.75);
}

TEST_CASE("where else an end may be is told with how likely that is") {
  SeamResult result = found_with(EndVisibility::kNotDetermined, EndVisibility::kSeen);
  result.start_second = {{-4, 1, 2}, 0.5};
  const seam_t start = told(result);
  CHECK(start.start_second_weight == 0.5);
  CHECK(start.start_second[0] == -4);
  CHECK(start.start_second[1] == 1);
  CHECK(start.start_second[2] == 2);
  CHECK(start.end_second_weight == 0);

  result = found_with(EndVisibility::kSeen, EndVisibility::kNotDetermined);
  result.end_second = {{107, 0.5, -1}, 0.25};
  const seam_t end = told(result);
  CHECK(end.end_second_weight == 0.25);
  CHECK(end.end_second[0] == 107);
  CHECK(end.end_second[1] == 0.5);
  CHECK(end.end_second[2] == -1);
  CHECK(end.start_second_weight == 0);
  CHECK(meaning_error(end).empty());
}

TEST_CASE("how a seam stands against the stripes is told, of a refused one too") {
  SeamResult result = found_with(EndVisibility::kSeen, EndVisibility::kSeen);
  CHECK(told(result).stripes_checked == -1);
  CHECK(told(result).explained_share == -1);
  CHECK(told(result).worst_contradiction == -1);
  result.checked = {31, 0.75, 2.5};
  for (const Verdict verdict : {Verdict::kFound, Verdict::kRefused}) {
    result.verdict = verdict;
    const seam_t seam = told(result);
    CHECK(seam.stripes_checked == 31);
    CHECK(seam.explained_share == 0.75);
    CHECK(seam.worst_contradiction == 2.5);
  }
}

TEST_CASE("of a refused seam no place and no use is told") {
  SeamResult result = found_with(EndVisibility::kNotDetermined, EndVisibility::kSeen);
  result.verdict = Verdict::kRefused;
  result.reason = {Reason::Code::kPlateTurned, 0.02};
  result.start_second = {{-4, 0, 0}, 0.5};
  const seam_t seam = told(result);
  CHECK(seam.refusal == seam_t::PLATE_TURNED);
  CHECK(seam.usable == seam_t::USABLE);  // speaks of found ones alone
  CHECK(seam.joint_type.empty());
  CHECK(seam.end[0] == 0);
  CHECK(seam.start_second_weight == 0);
  CHECK(meaning_error(seam).empty());
}
