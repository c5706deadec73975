// What draw_wild_scene() puts together, each part from a random stream of its own.
#pragma once

#include <initializer_list>
#include <vector>

#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/wild/wild_scene.hpp"

namespace arcstart::cell_simulator {

class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t purpose) : random_(seed, purpose) {}

  bool chance(double share) { return random_.uniform() < share; }
  double within(double low, double high) { return random_.uniform(low, high); }
  int count(int low, int high) {  // both may come
    return low + static_cast<int>(random_.uniform() * (high - low + 1));
  }
  template <class T>
  T one_of(std::initializer_list<T> choices) {
    return choices.begin()[count(0, static_cast<int>(choices.size()) - 1)];
  }

 private:
  RandomStream random_;
};

// Ground steel, scale, rust, primer, black, or nearly a mirror.
WildSurface draw_surface(Draw& draw);

// Plates with scale: in half of the works ground as far as 10 to 30 mm from the seam.
void draw_ground_bands(WildWork& work, Draw& draw);

// How an outside corner's plates meet: in four works of ten mitred, else each as thick as it is.
void draw_corner(WildWork& work, Draw& draw);

// quiet: nothing but the joint itself.
WildWork draw_work(const std::string& joint, Draw& draw, bool quiet);

// Lying across, before, behind and on the seam of the first work, or where it would be.
std::vector<WildSolid> draw_clutter(const WildScene& scene, Draw& draw);

WildTable draw_table(Draw& draw);
WildEvents draw_events(Draw& draw);
// Of the works that lie there.
WildScanGeometry draw_scan(const std::vector<WildWork>& works, Draw& draw);

}  // namespace arcstart::cell_simulator
