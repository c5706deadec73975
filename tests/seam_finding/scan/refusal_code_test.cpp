#include "services/seam_finding/scan/refusal_code.hpp"

#include <arcstart/seam_t.hpp>
#include <catch2/catch.hpp>
#include <set>

#include "common/geometry.hpp"
#include "services/seam_finding/answer/wording.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

using Code = Reason::Code;

template <class Visit>
void for_each_code(Code first, Code last, Visit visit) {
  for (int code = static_cast<int>(first); code <= static_cast<int>(last); ++code)
    visit(static_cast<Code>(code));
}

}  // namespace

TEST_CASE("each reason for which no seam is given has a code of its own in a range that helps") {
  std::set<int> codes;
  const auto take = [&](Code code) {
    if (code == Code::kNoJoint) return;
    const int refusal = refusal_code({code});
    INFO(in_words({code}));
    CHECK(refusal > seam_t::SCAN_AGAIN);
    CHECK(refusal < seam_t::STOP);
    CHECK(codes.insert(refusal).second);
  };
  for_each_code(Code::kPlatesDoNotTouch, Code::kPlateNarrow, take);
  for_each_code(Code::kNoCloud, Code::kSeamTooShort, take);
}

TEST_CASE("a best pair that is no joint is refused by what it lacks") {
  CHECK(refusal_code({Code::kNoJoint, 1.2, 0, 0, Code::kAngle}) == seam_t::WRONG_ANGLE);
  CHECK(in_words(Reason{Code::kNoJoint, 90 * kDegree, 0, 0, Code::kAngle}) ==
        "no joint: of the best pair of planes its angle is 90.0 deg");
}

TEST_CASE("what only ranks an alternative, or is only remarked, refuses nothing") {
  CHECK(refusal_code({}) == 0);
  for_each_code(Code::kScoreTooNear, Code::kFewDrawsAgree,
                [](Code code) { CHECK(refusal_code({code}) == 0); });
  for_each_code(Code::kMissingBeforeStart, Code::kEndBounded,
                [](Code code) { CHECK(refusal_code({code}) == 0); });
}

TEST_CASE("every code has words, and no two the same") {
  std::set<std::string> all;
  for_each_code(Code::kPlatesDoNotTouch, Code::kEndDeviationLarge, [&](Code code) {
    const std::string words = in_words(Reason{code, 1, 2, 3, Code::kNotConcave});
    INFO(static_cast<int>(code));
    CHECK_FALSE(words.empty());
    CHECK(all.insert(words).second);
  });
  CHECK(in_words(Reason{}).empty());
}
