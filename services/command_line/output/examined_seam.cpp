#include "services/command_line/output/examined_seam.hpp"

#include "services/seam_finding/referee/ruling.hpp"

namespace arcstart::command_line {
namespace {

using seam_finding::Reason;

bool takes_an_end_away(const Reason& remark) {
  switch (remark.code) {
    case Reason::Code::kStartContradicted:
    case Reason::Code::kEndContradicted:
    case Reason::Code::kStartNotShown:
    case Reason::Code::kEndNotShown:
    case Reason::Code::kStartLooselyBounded:
    case Reason::Code::kEndLooselyBounded:
      return true;
    default:
      return false;
  }
}

}  // namespace

ExaminedSeam examined(const seam_finding::ScanCloud& cloud, const seam_finding::SeamResult& found) {
  ExaminedSeam seam;
  seam.found = seam.ruled = found;
  seam.examination = seam_finding::examine(cloud, found);
  seam_finding::rule(seam.examination, seam.ruled);
  if (seam.examination.contradiction) {
    seam.objections.push_back(seam.examination.contradiction);
    return seam;
  }
  for (const Reason& remark : seam.ruled.remarks)
    if (takes_an_end_away(remark)) seam.objections.push_back(remark);
  return seam;
}

bool may_be_contradicted(const seam_t& answer) {
  if (answer.stripes_checked < 0) return false;
  return answer.verdict == seam_t::FOUND ? answer.usable != seam_t::USABLE
                                         : answer.verdict == seam_t::REFUSED;
}

}  // namespace arcstart::command_line
