#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "services/cell_simulator/scene/scene_object.hpp"
#include "tests/bench/seam/wild/judgement.hpp"
#include "tests/bench/seam/wild/scene_file.hpp"
#include "tests/bench/seam/wild/scene_tags.hpp"
#include "tests/bench/seam/wild/shrink.hpp"
#include "tests/bench/seam/wild/wild_bench.hpp"
#include "tests/bench/seam/wild/wild_case.hpp"

namespace arcstart {

using cell_simulator::WildScene;
namespace {

constexpr const char* folder = "build/bench/hunt";
constexpr std::size_t worst_kept = 20;
constexpr int tries = 40;  // to make a scene plainer

KeptScene kept(const WildScene& scene, const std::string& from, const WildJudgement& judgement) {
  KeptScene one{scene, joint_setting(scene.asked), from, {}, judgement.worst_ratio};
  for (const SilentError& error : judgement.silent) one.silent.push_back(error.text);
  return one;
}

WildJudgement judged(const WildScene& scene, bool referee) {
  const WildCase wild(scene);
  return judge(wild.answer(referee), wild.truth());
}

std::string tags(const WildScene& scene) {
  const WildCase wild(scene);
  return fmt::format("{}", fmt::join(tags_of(scene, wild.truth(), wild.sights()), " "));
}

class Hunt {
 public:
  explicit Hunt(bool referee) : referee_(referee) { std::filesystem::create_directories(folder); }

  void take(const WildScene& scene, const std::string& from) {
    const WildJudgement judgement = judged(scene, referee_);
    ++scenes_;
    found_ += judgement.found;
    if (judgement.silent.empty()) return remember(kept(scene, from, judgement));
    ++silent_;
    // As long as the same is wrong in silence.
    const SilentError::Where where = judgement.silent[0].where;
    const bool right = judgement.right;
    const WildScene plain = shrunk(scene, tries, [&](const WildScene& plainer) {
      const WildJudgement now = judged(plainer, referee_);
      return now.right == right && now.silently(where);
    });
    const KeptScene one = kept(plain, from, judged(plain, referee_));
    write(one);
    fmt::print("{}: silent {} | {} | of {}\n", from, fmt::join(one.silent, "; "), tags(plain),
               tags(scene));
    std::fflush(stdout);
  }

  void finish(nlohmann::json& json) const {
    for (const KeptScene& one : worst_) {
      write(one);
      fmt::print("{}: error over deviation {:.1f}\n", one.drawn_from, one.ratio);
    }
    fmt::print("{} scenes, {} found, {} silent; kept in {}\n", scenes_, found_, silent_, folder);
    json["hunt.n"] = scenes_;
    json["hunt.found"] = found_;
    json["hunt.silent"] = silent_;
  }

 private:
  static void write(const KeptScene& one) {
    write_scene(one, fmt::format("{}/{}.json", folder, one.drawn_from));
  }

  void remember(KeptScene one) {
    if (one.ratio <= 0) return;
    const auto place = std::find_if(worst_.begin(), worst_.end(), [&](const KeptScene& other) {
      return other.ratio < one.ratio;
    });
    worst_.insert(place, std::move(one));
    if (worst_.size() > worst_kept) worst_.pop_back();
  }

  bool referee_;
  int scenes_ = 0, found_ = 0, silent_ = 0;
  std::vector<KeptScene> worst_;  // that are not silent, the worst first
};

}  // namespace

void hunt(const WildChoice& choice, double minutes, nlohmann::json& json) {
  fmt::print("\nScenes of the wild for {} minutes, from seed {}\n", minutes, choice.wanted.first);
  Hunt hunt(choice.referee);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(60 * minutes);
  for (int seed = choice.wanted.first; std::chrono::steady_clock::now() < end; ++seed)
    for (const std::string joint : cell_simulator::wild_joints) {
      if (!choice.wanted.makes(joint) || std::chrono::steady_clock::now() >= end) continue;
      try {
        hunt.take(cell_simulator::draw_wild_scene(joint, static_cast<std::uint64_t>(seed)),
                  fmt::format("{}-{}", joint, seed));
      } catch (const cell_simulator::SceneError& error) {
        fmt::print("{}-{}: no scene: {}\n", joint, seed, error.what());
      }
    }
  hunt.finish(json);
}

void show_scene(const std::string& path) {
  const WildScene scene = read_scene(path);
  const WildCase wild(scene);
  fmt::print("{}: {} asked | {}\n", path, joint_setting(scene.asked),
             fmt::join(tags_of(scene, wild.truth(), wild.sights()), " "));
  for (const cell_simulator::WildSeam& seam : wild.truth().seams)
    fmt::print("true {}: start {:.2f}, end {:.2f}, {:.2f} and {:.2f} mm of them open\n",
               seam.joint_type, fmt::join(seam.start.point, " "), fmt::join(seam.end.point, " "),
               seam.start.play_mm, seam.end.play_mm);
  for (const bool referee : {false, true}) {
    const seam_t seam = wild.answer(referee);
    const WildJudgement judgement = judge(seam, wild.truth());
    fmt::print("{} the referee: ", referee ? "after" : "before");
    if (!judgement.found) {
      fmt::print("not found, {}: {}\n", seam.refusal, seam.reason);
      continue;
    }
    fmt::print("{}: start {:.2f}, {}, end {:.2f}, {}; {}\n", seam.joint_type,
               fmt::join(seam.start, " "), name_of_visibility(seam.start_visibility),
               fmt::join(seam.end, " "), name_of_visibility(seam.end_visibility), seam.remark);
    if (judgement.right)
      fmt::print(
          "  start off along {:.3f}, across {:.3f}, height {:.3f}, deviation {:.3f} mm; end "
          "{:.3f}, "
          "{:.3f}, {:.3f}, {:.3f} mm; direction {:.3f} deg\n",
          judgement.start.along, judgement.start.across, judgement.start.height,
          judgement.start.deviation, judgement.end.along, judgement.end.across,
          judgement.end.height, judgement.end.deviation, judgement.direction);
    for (const SilentError& error : judgement.silent) fmt::print("  silent {}\n", error.text);
  }
}

}  // namespace arcstart
