// Rows of the table of scenes of the wild: how right, how sure, and what is wrong in silence.
#pragma once

#include <arcstart/seam_t.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/bench/seam/wild/judgement.hpp"
#include "tests/seam_finding/support/wild_scan.hpp"

namespace arcstart {

// What is known of one scene, beside the answer to it.
struct WildFacts {
  int seed = 0;
  bool wrong = false;      // there is no seam to be found
  bool traceless = false;  // plates meet edge to edge, at one level, without any gap: two of them
                           // have the very surface of one
  double pitch_mm = 0;
  std::vector<seam_finding::synthetic::WildSeamSight> sights;  // of each true seam
  std::vector<std::string> tags;
};

WildFacts facts_of(const cell_simulator::WildScene& scene, const cell_simulator::WildTruth& truth,
                   const std::vector<seam_finding::synthetic::WildSeamSight>& sights, int seed);

class WildRow {
 public:
  explicit WildRow(std::string name) : name_(std::move(name)) {}

  // Prints each silent error in a line.
  void add(const WildFacts& facts, const seam_t& seam, const WildJudgement& judgement);

  // One line to the table, and the figures as NAME.n, NAME.silent_start and so on.
  // answered: share of the scenes with a start in view whose seam was found and right, or told to
  // be one of several where it is. answered_of_traces: the same without those whose plates have the
  // surface of one, which nobody can answer. seen: share of right answers with a start that stripes
  // cross that say it is seen. Errors of starts are of right answers that say they are seen;
  // within_2sigma and beyond_3sigma are of all starts that carry a deviation, less what the truth
  // leaves open.
  void finish(nlohmann::json& json) const;

 private:
  void add_start(const WildFacts& facts, const seam_t& seam, const WildJudgement& judgement);

  std::string name_;
  int seeds_ = 0, wrong_ = 0, refused_ = 0, refused_wrong_parts_ = 0;
  int in_view_ = 0, answered_ = 0, traceless_ = 0, traceless_answered_ = 0, crossed_ = 0, seen_ = 0;
  int silent_start_ = 0, silent_end_ = 0, silent_else_ = 0, silent_scenes_ = 0;
  int silent_by_robot_ = 0;  // scenes
  int sure_ = 0, within_2_ = 0, beyond_3_ = 0;
  double squared_errors_ = 0, squared_deviations_ = 0;
  std::vector<double> start_, lateral_, direction_, end_, crossed_start_, bounded_start_;
  std::map<int, int> refusals_;  // how many of each code
};

void print_wild_header();

// By what lies in the scenes: how many, refused and silent, of a row's answers before and after the
// referee.
class WildTagTable {
 public:
  void add(const WildFacts& facts, const std::string& joint, const WildJudgement& before,
           const WildJudgement& after);
  void print() const;

 private:
  struct Count {
    int n = 0, refused[2] = {}, silent[2] = {};
    void add(const WildJudgement& before, const WildJudgement& after);
  };
  std::map<std::string, Count> joints_, tags_;
};

}  // namespace arcstart
