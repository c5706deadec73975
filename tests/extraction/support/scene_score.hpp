// What stripe centres are worth against a rendered scene's truth.
#pragma once

#include <vector>

#include "tests/extraction/support/scene_renderer.hpp"

namespace arcstart::extraction {

struct Centre {
  double u, v;  // px
};

struct StripeSceneScore {
  std::vector<double> errors;  // of the centres that are not false: distance to the curve; px
  double visible = 0;          // length of the stripe that shows; px
  double recalled = 0;         // length of it with a centre within 3 px
  std::size_t centres = 0;
  std::size_t wrong = 0;  // centres over 3 px from every visible piece

  double rms() const;  // px
  double p95() const;  // nearest rank; px
  double recall() const { return visible > 0 ? recalled / visible : 0; }
  double false_share() const {
    return centres > 0 ? static_cast<double>(wrong) / static_cast<double>(centres) : 0;
  }
  void add(const StripeSceneScore& other);
};

// from_corners: centres nearer than this to a corner, along u, give no error; px.
StripeSceneScore score(const StripeScene& scene, const std::vector<Centre>& centres,
                       double from_corners = 0);

}  // namespace arcstart::extraction
