#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <utility>

#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/referee/ruling.hpp"
#include "tests/bench/seam/figures.hpp"
#include "tests/bench/seam/wild/falsified.hpp"
#include "tests/bench/seam/wild/judgement.hpp"
#include "tests/bench/seam/wild/scene_tags.hpp"
#include "tests/bench/seam/wild/wild_bench.hpp"
#include "tests/bench/seam/wild/wild_case.hpp"

namespace arcstart {

using namespace seam_finding;
using cell_simulator::WildScene;
namespace {

// What is wrong with the cell that scans.
struct Cell {
  const char* name;
  double calibration_error;  // factor on that of a robot that errs by 0.1 mm in its poses
  double robot_wave_mm;      // amplitude, over 400 mm
};
constexpr Cell cells[] = {{"exact", 0, 0}, {"calibration", 1, 0}, {"robot", 0, 0.3}};

struct Caught {
  int n = 0, caught = 0;
  int honest = 0;  // not caught, and yet the deviation told covers the error
};

class FalsifiedRow {
 public:
  FalsifiedRow(std::string cell, std::string joint)
      : cell_(std::move(cell)), joint_(std::move(joint)) {}

  void add(const WildCase& wild, int seed) {
    const WildJudgement judgement = judge(wild.answer(false), wild.truth());
    if (!judgement.right || !judgement.silent.empty() ||
        wild.found().start_visibility != EndVisibility::kSeen)
      return;
    tags_ = fmt::format("{}", fmt::join(tags_of(wild.scene(), wild.truth(), wild.sights()), " "));
    seed_ = seed;
    const SeamResult upheld = ruled(wild.cloud(), wild.found());
    ++right_;
    if (upheld.verdict != SeamResult::Verdict::kFound) {
      ++refused_;
      tell("true, refused: " + in_words(upheld.reason));
    } else {
      add_end(judgement.start, wild.found().start_visibility, upheld.start_visibility, "start",
              upheld);
      add_end(judgement.end, wild.found().end_visibility, upheld.end_visibility, "end", upheld);
    }
    const double spacing = wild.scene().scan.pitch_mm / std::abs(wild.found().direction.x());
    for (const Falsified& one :
         falsified(wild.found(), wild.cloud(), spacing, static_cast<std::uint64_t>(seed)))
      add_falsified(wild, one);
  }

  void add(const FalsifiedRow& other) {
    right_ += other.right_, refused_ += other.refused_;
    ends_ += other.ends_, demoted_ += other.demoted_;
    for (const auto& [kind, count] : other.kinds_) {
      kinds_[kind].n += count.n;
      kinds_[kind].caught += count.caught;
      kinds_[kind].honest += count.honest;
    }
  }

  void finish(nlohmann::json& json) const {
    Caught all;
    std::string kinds;
    const std::string between = cell_.empty() ? "" : cell_ + "." + joint_ + ".";
    for (const auto& [kind, count] : kinds_) {
      all.n += count.n, all.caught += count.caught, all.honest += count.honest;
      kinds += fmt::format(" {} {:.4f} of {},", kind, share(count.caught, count.n), count.n);
      json["falsified." + between + kind] = share(count.caught, count.n);
    }
    json["falsified." + between + "n"] = all.n;
    json["falsified." + between + "caught"] = share(all.caught, all.n);
    json["true." + between + "n"] = right_;
    json["true." + between + "refused"] = share(refused_, right_);
    json["true." + between + "demoted"] = share(demoted_, ends_);
    fmt::print(
        "{:<12} {:<15} | true: {:>4}, refused {:>3} = {:.4f}, ends demoted {:>3} of {:>4} = {:.4f} "
        "| false: {:>5}, caught {:.4f}, else honest {:>3};{}\n",
        cell_.empty() ? "all" : cell_, joint_, right_, refused_, share(refused_, right_), demoted_,
        ends_, share(demoted_, ends_), all.n, share(all.caught, all.n), all.honest, kinds);
    std::fflush(stdout);
  }

 private:
  static SeamResult ruled(const ScanCloud& cloud, SeamResult seam) {
    rule(examine(cloud, seam), seam);
    return seam;
  }

  void tell(const std::string& text) const {
    fmt::print("  {} {} seed {}: {} | {}\n", cell_, joint_, seed_, text, tags_);
  }

  void add_end(const PlaceError& end, EndVisibility before, EndVisibility after, const char* name,
               const SeamResult& upheld) {
    constexpr double right_mm = 1;
    if (before != EndVisibility::kSeen ||
        std::abs(end.along) > std::max(3 * end.deviation, right_mm))
      return;
    ++ends_;
    if (after != EndVisibility::kNotDetermined) return;
    ++demoted_;
    tell(fmt::format("true, {} (off {:.2f} mm) not determined: {}", name, end.along,
                     in_words(upheld.remarks)));
  }

  void add_falsified(const WildCase& wild, const Falsified& one) {
    const SeamResult seam = ruled(wild.cloud(), one.seam);
    const bool start = one.end == ClaimedEnd::kStart;
    const EndVisibility visibility = start ? seam.start_visibility : seam.end_visibility;
    const bool caught =
        seam.verdict != SeamResult::Verdict::kFound ||
        (one.end != ClaimedEnd::kNone && visibility == EndVisibility::kNotDetermined);
    Caught& count = kinds_[one.kind];
    ++count.n;
    count.caught += caught;
    if (caught) return;
    double deviation = 0;
    if (one.end != ClaimedEnd::kNone && seam.accuracy)
      deviation = std::sqrt(
          std::max(0.0, seam.direction.dot((start ? seam.accuracy->start : seam.accuracy->end) *
                                           seam.direction)));
    count.honest += one.end != ClaimedEnd::kNone && 3 * deviation >= std::abs(one.off_mm);
    tell(fmt::format("FALSE, {}: {}, deviation {:.2f} mm, passed", one.kind, one.text, deviation));
  }

  std::string cell_, joint_, tags_;
  int seed_ = 0;
  int right_ = 0, refused_ = 0, ends_ = 0, demoted_ = 0;
  std::map<std::string, Caught> kinds_;
};

WildScene in_cell(WildScene scene, const Cell& cell) {
  scene.scan.calibration_error = cell.calibration_error;
  scene.scan.robot_wave_mm = cell.robot_wave_mm;
  return scene;
}

}  // namespace

void bench_falsified(const WildChoice& choice, nlohmann::json& json) {
  fmt::print(
      "\nRight answers held up by the referee, and made wrong on purpose: cells without error, "
      "with "
      "that of\ncalibration by a robot that errs by 0.1 mm, and with smooth errors of the robot of "
      "0.3 mm\n");
  FalsifiedRow all("", "");
  for (const Cell& cell : cells)
    for (const std::string joint : cell_simulator::wild_joints) {
      if (!choice.wanted.makes(joint)) continue;
      FalsifiedRow row(cell.name, joint);
      for_each_scene(
          joint, choice.wanted.first, choice.profile_seeds,
          [&](const WildScene& scene, int seed) { row.add(WildCase(in_cell(scene, cell)), seed); });
      row.finish(json);
      all.add(row);
    }
  all.finish(json);
}

}  // namespace arcstart
