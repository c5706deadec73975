#include "tests/bench/seam/wild/wild_row.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/seam/figures.hpp"
#include "tests/bench/seam/wild/scene_tags.hpp"

namespace arcstart {

using Where = SilentError::Where;
using seam_finding::synthetic::WildSeamSight;
using seam_finding::synthetic::WildSight;

namespace {

// Closed form: the tops lie in one plane and the edges coincide, so that no stripe differs from one
// over a single plate. Another colour or roughness is no other surface, and a corner of the outline
// where one plate ends before the other is one that a single plate may have.
bool is_traceless(const cell_simulator::WildSeam& seam) {
  return seam.joint_type == "butt" && seam.gap_start == 0 && seam.gap_end == 0 &&
         seam.mismatch_start == 0 && seam.mismatch_end == 0;
}

}  // namespace

WildFacts facts_of(const cell_simulator::WildScene& scene, const cell_simulator::WildTruth& truth,
                   const std::vector<WildSeamSight>& sights, int seed) {
  const bool traceless =
      !truth.seams.empty() && std::all_of(truth.seams.begin(), truth.seams.end(), is_traceless);
  return {seed, truth.wrong, traceless, scene.scan.pitch_mm, sights, tags_of(scene, truth, sights)};
}

void WildRow::add(const WildFacts& facts, const seam_t& seam, const WildJudgement& judgement) {
  ++seeds_;
  bool in_view = false;
  for (const WildSeamSight& sight : facts.sights) in_view = in_view || sight.start.in_view;
  in_view_ += in_view;
  traceless_ += in_view && facts.traceless;
  for (const SilentError& error : judgement.silent)
    fmt::print("  {} seed {}: silent {}{} | {}\n", name_, facts.seed, error.text,
               judgement.by_robot ? ", as the robot errs" : "", fmt::join(facts.tags, " "));
  silent_by_robot_ += judgement.by_robot;
  silent_scenes_ += !judgement.silent.empty();
  silent_start_ += judgement.silently(Where::kStart);
  silent_end_ += judgement.silently(Where::kEnd);
  silent_else_ += judgement.silently(Where::kElse);
  if (!judgement.found) {
    // Of two true seams either is right, and so is it to say that there are several.
    answered_ += in_view && seam.verdict == seam_t::AMBIGUOUS && facts.sights.size() > 1;
    ++refused_;
    refused_wrong_parts_ += facts.wrong;
    ++refusals_[seam.refusal];
    return;
  }
  wrong_ += !judgement.right;
  if (!judgement.right) return;
  answered_ += in_view;
  traceless_answered_ += in_view && facts.traceless;
  lateral_.push_back(std::hypot(judgement.start.across, judgement.start.height));
  direction_.push_back(judgement.direction);
  if (seam.end_visibility == seam_t::SEEN) end_.push_back(judgement.end.distance());
  add_start(facts, seam, judgement);
}

void WildRow::add_start(const WildFacts& facts, const seam_t& seam,
                        const WildJudgement& judgement) {
  const PlaceError& start = judgement.start;
  const bool seen = seam.start_visibility == seam_t::SEEN;
  const WildSight::Kind kind = facts.sights.at(judgement.seam).start.kind();
  crossed_ += kind == WildSight::Kind::kCrossed;
  seen_ += seen && kind == WildSight::Kind::kCrossed;
  if (start.deviation >= 0) {
    ++sure_;
    within_2_ += std::abs(start.along) <= 2 * start.deviation;
    beyond_3_ += std::abs(start.along) > 3 * start.deviation;
  }
  if (!seen) return;
  start_.push_back(start.distance());
  if (kind == WildSight::Kind::kCrossed) crossed_start_.push_back(start.distance());
  if (kind == WildSight::Kind::kBounded)
    bounded_start_.push_back(start.distance() / facts.pitch_mm);
  if (start.deviation < 0) return;
  squared_errors_ += start.along * start.along;
  squared_deviations_ += start.deviation * start.deviation;
}

void print_wild_header() {
  fmt::print(
      "{:<24} {:>5} {:>5} {:>7} {:>8} {:>5} | silent {:>5} {:>5} {:>5} {:>5} | start {:>6} {:>6} "
      "{:>6} | "
      "crossed {:>6} {:>6} | bounded {:>6} | {:>8} {:>9} {:>8}\n",
      "row", "n", "wrong", "refused", "answered", "seen", "start", "end", "else", "robot", "mean",
      "95 %", "max", "mean", "95 %", "pitch", "within2s", "beyond3s", "sd_ratio");
}

void WildRow::finish(nlohmann::json& json) const {
  const double ratio =
      squared_deviations_ > 0 ? std::sqrt(squared_errors_ / squared_deviations_) : 0;
  fmt::print(
      "{:<24} {:>5} {:>5} {:>7} {:>8.3f} {:>5.3f} |        {:>5} {:>5} {:>5} {:>5} |       "
      "{:>6.3f} "
      "{:>6.3f} {:>6.3f} |         {:>6.3f} {:>6.3f} |         {:>6.3f} | {:>8.3f} {:>9.4f} "
      "{:>8.2f}\n",
      name_, seeds_, wrong_, refused_, share(answered_, in_view_), share(seen_, crossed_),
      silent_start_, silent_end_, silent_else_, silent_by_robot_, mean(start_),
      percentile(start_, 0.95), percentile(start_, 1), mean(crossed_start_),
      percentile(crossed_start_, 0.95), mean(bounded_start_), share(within_2_, sure_),
      share(beyond_3_, sure_), ratio);
  const double of_traces = share(answered_ - traceless_answered_, in_view_ - traceless_);
  if (traceless_ > 0)
    fmt::print(
        "  {}: {} of {} in view have the surface of one plate; answered of the others {:.3f}\n",
        name_, traceless_, in_view_, of_traces);
  fmt::print("  {}: refused", name_);
  for (const auto& [code, count] : refusals_) fmt::print(" {} x {},", code, count);
  fmt::print(" {} of them have no seam\n", refused_wrong_parts_);
  std::fflush(stdout);
  const auto put = [&](const char* key, auto value) { json[name_ + "." + key] = value; };
  put("n", seeds_);
  put("wrong", wrong_);
  put("refused", refused_);
  put("in_view", in_view_);
  put("answered", share(answered_, in_view_));
  put("traceless", traceless_);
  put("answered_of_traces", of_traces);
  put("seen", share(seen_, crossed_));
  put("silent", silent_scenes_);
  put("silent_by_robot", silent_by_robot_);
  put("silent_start", silent_start_);
  put("silent_end", silent_end_);
  put("silent_else", silent_else_);
  put("within_2sigma", share(within_2_, sure_));
  put("beyond_3sigma", share(beyond_3_, sure_));
  put("sd_ratio", ratio);
  put("start_mean_mm", mean(start_));
  put("start_p95_mm", percentile(start_, 0.95));
  put("start_max_mm", percentile(start_, 1));
  put("crossed_n", crossed_start_.size());
  put("crossed_start_mean_mm", mean(crossed_start_));
  put("crossed_start_p95_mm", percentile(crossed_start_, 0.95));
  put("bounded_n", bounded_start_.size());
  put("bounded_start_mean_spacings", mean(bounded_start_));
  put("lateral_mean_mm", mean(lateral_));
  put("lateral_max_mm", percentile(lateral_, 1));
  put("direction_mean_deg", mean(direction_));
  put("direction_max_deg", percentile(direction_, 1));
  put("end_mean_mm", mean(end_));
  put("end_p95_mm", percentile(end_, 0.95));
  put("end_max_mm", percentile(end_, 1));
}

void WildTagTable::Count::add(const WildJudgement& before, const WildJudgement& after) {
  ++n;
  refused[0] += !before.found, refused[1] += !after.found;
  silent[0] += !before.silent.empty(), silent[1] += !after.silent.empty();
}

void WildTagTable::add(const WildFacts& facts, const std::string& joint,
                       const WildJudgement& before, const WildJudgement& after) {
  joints_[joint].add(before, after);
  for (const std::string& tag : facts.tags) tags_[tag].add(before, after);
}

void WildTagTable::print() const {
  fmt::print("\nBefore and after the referee, by joint and by what lies in the scene\n");
  fmt::print("{:<16} {:>6} | refused {:>6} {:>6} | silent {:>6} {:>6}\n", "", "n", "before",
             "after", "before", "after");
  for (const auto* counts : {&joints_, &tags_})
    for (const auto& [name, count] : *counts)
      fmt::print("{:<16} {:>6} |         {:>6} {:>6} |        {:>6} {:>6}\n", name, count.n,
                 count.refused[0], count.refused[1], count.silent[0], count.silent[1]);
}

}  // namespace arcstart
