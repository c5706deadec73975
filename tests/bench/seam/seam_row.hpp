// A row of the table of seam errors: many seeds of one kind of scene, each told.
#pragma once

#include <arcstart/seam_t.hpp>
#include <arcstart/truth_t.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace arcstart {

class SeamRow {
 public:
  explicit SeamRow(std::string name) : name_(std::move(name)) {}

  // truth: nothing where there is no seam, so that every answer is wrong. Prints seeds that are
  // wrong or not answered, and those whose start is off by more than `tell_mm`, or whose end is off
  // in silence.
  // start_hidden: of the truth. An answer that says so too is counted as flagged, and its bound is
  // no start. An error over 1 mm of a start that is said to be seen is silent, where it is more
  // than two of the deviations given.
  void add(int seed, const seam_t& seam, const std::optional<truth_t>& truth, double tell_mm,
           bool start_hidden = false);

  // One line to the table, and the figures as NAME.n, NAME.wrong and so on. Ends that are said to
  // be hidden or not seen are left out of the end's.
  void finish(nlohmann::json& json) const;

 private:
  void add_end(int seed, const seam_t& seam, const truth_t& truth);

  std::string name_;
  int flagged_ = 0, silent_ = 0;
  int seeds_ = 0, wrong_ = 0, refused_ = 0, within_ = 0, covered_ = 0;
  int end_silent_ = 0, end_within_ = 0;
  std::vector<double> start_, lateral_, direction_, end_;  // of each answer; mm, mm, deg, mm
};

void print_row_header();

}  // namespace arcstart
