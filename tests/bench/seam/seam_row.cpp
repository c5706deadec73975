#include "tests/bench/seam/seam_row.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "services/command_line/output/seam_error.hpp"
#include "tests/bench/seam/figures.hpp"

namespace arcstart {

using namespace command_line;
namespace {

constexpr double kSilent = 1;  // mm

}  // namespace

void SeamRow::add_end(int seed, const seam_t& seam, const truth_t& truth) {
  if (seam.end_visibility != seam_t::SEEN) return;
  const Eigen::Map<const Eigen::Vector3d> end(seam.end), true_end(truth.end),
      direction(truth.direction);
  const Eigen::Map<const Eigen::Matrix3d> covariance(&seam.end_covariance[0][0]);
  const double along = direction.dot(end - true_end);
  const double deviation = std::sqrt(std::max(0.0, direction.dot(covariance * direction)));
  end_.push_back((end - true_end).norm());
  const bool within = std::abs(along) <= 2 * deviation;
  end_within_ += within;
  if (within || end_.back() <= kSilent) return;
  ++end_silent_;
  fmt::print("  {} seed {}: end {:.3f} mm (along {:.3f}, deviation {:.3f}, silent)\n", name_, seed,
             end_.back(), along, deviation);
}

void SeamRow::add(int seed, const seam_t& seam, const std::optional<truth_t>& truth, double tell_mm,
                  bool start_hidden) {
  ++seeds_;
  if (seam.verdict != seam_t::FOUND) {
    ++refused_;
    if (truth)
      fmt::print("  {} seed {}: {}: {}\n", name_, seed,
                 seam.verdict == seam_t::AMBIGUOUS ? "ambiguous" : "refused", seam.reason);
    return;
  }
  if (!truth) {
    ++wrong_;
    fmt::print("  {} seed {}: WRONG, there is no seam\n", name_, seed);
    return;
  }
  const command_line::SeamError error = command_line::seam_error(seam, *truth);
  if (!error.wrong) add_end(seed, seam, *truth);
  wrong_ += error.wrong;
  if (start_hidden && !error.wrong && seam.start_visibility != seam_t::SEEN) {
    ++flagged_;
    return;
  }
  start_.push_back(error.start_mm);
  lateral_.push_back(error.lateral_mm);
  direction_.push_back(error.direction_deg);
  const Eigen::Map<const Eigen::Matrix3d> covariance(&seam.start_covariance[0][0]);
  const Eigen::Map<const Eigen::Vector3d> direction(truth->direction);
  const double deviation = std::sqrt(std::max(0.0, direction.dot(covariance * direction)));
  if (covariance(0, 0) >= 0) {
    ++covered_;
    within_ += std::abs(error.along_mm) <= 2 * deviation;
  }
  // Neither is the start said to be hidden, nor the error by the deviation given.
  const bool silent = error.start_mm > kSilent && seam.start_visibility == seam_t::SEEN &&
                      !(std::abs(error.along_mm) <= 2 * deviation);
  silent_ += silent;
  if (error.wrong || error.start_mm > tell_mm)
    fmt::print("  {} seed {}: start {:.3f} mm (along {:.3f}, deviation {:.3f}{}{}), {}{}\n", name_,
               seed, error.start_mm, error.along_mm, deviation, start_hidden ? ", hidden" : "",
               silent ? ", silent" : "", seam.remark, error.wrong ? "  WRONG" : "");
}

void print_row_header() {
  fmt::print(
      "{:<16} {:>5} {:>5} {:>7} | start {:>6} {:>6} {:>6} | lateral {:>6} {:>6} | direction {:>6} "
      "{:>6} | {:>8} | end {:>6} {:>6} {:>6} {:>9}\n",
      "row", "n", "wrong", "refused", "mean", "95 %", "max", "mean", "max", "mean", "max",
      "within 2s", "mean", "95 %", "max", "within 2s");
}

void SeamRow::finish(nlohmann::json& json) const {
  const double within =
      covered_ > 0 ? static_cast<double>(within_) / static_cast<double>(covered_) : 0;
  const double end_within =
      end_.empty() ? 0 : static_cast<double>(end_within_) / static_cast<double>(end_.size());
  const double start95 = percentile(start_, 0.95), start_max = percentile(start_, 1);
  const double lateral_max = percentile(lateral_, 1), direction_max = percentile(direction_, 1);
  fmt::print(
      "{:<16} {:>5} {:>5} {:>7} |       {:>6.3f} {:>6.3f} {:>6.3f} |         {:>6.4f} {:>6.4f} |   "
      "        {:>6.4f} {:>6.4f} | {:>9.2f} |     {:>6.3f} {:>6.3f} {:>6.3f} {:>9.2f}\n",
      name_, seeds_, wrong_, refused_, mean(start_), start95, start_max, mean(lateral_),
      lateral_max, mean(direction_), direction_max, within, mean(end_), percentile(end_, 0.95),
      percentile(end_, 1), end_within);
  std::fflush(stdout);
  json[name_ + ".n"] = seeds_;
  json[name_ + ".wrong"] = wrong_;
  json[name_ + ".refused"] = refused_;
  json[name_ + ".flagged"] = flagged_;
  json[name_ + ".silent"] = silent_;
  json[name_ + ".end_silent"] = end_silent_;
  if (flagged_ > 0 || silent_ > 0 || end_silent_ > 0)
    fmt::print("  {}: {} hidden starts flagged, silent errors over 1 mm: {} starts, {} ends\n",
               name_, flagged_, silent_, end_silent_);
  if (start_.empty()) return;
  json[name_ + ".start_mean_mm"] = mean(start_);
  json[name_ + ".start_p95_mm"] = start95;
  json[name_ + ".start_max_mm"] = start_max;
  json[name_ + ".lateral_mean_mm"] = mean(lateral_);
  json[name_ + ".lateral_max_mm"] = lateral_max;
  json[name_ + ".direction_mean_deg"] = mean(direction_);
  json[name_ + ".direction_max_deg"] = direction_max;
  json[name_ + ".within_2sigma"] = within;
  if (end_.empty()) return;
  json[name_ + ".end_mean_mm"] = mean(end_);
  json[name_ + ".end_p95_mm"] = percentile(end_, 0.95);
  json[name_ + ".end_max_mm"] = percentile(end_, 1);
  json[name_ + ".end_within_2sigma"] = end_within;
}

}  // namespace arcstart
