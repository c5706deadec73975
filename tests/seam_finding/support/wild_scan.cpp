#include "tests/seam_finding/support/wild_scan.hpp"

#include <algorithm>
#include <cmath>

#include "services/cell_simulator/base/random_stream.hpp"
#include "services/cell_simulator/image/sensor_camera.hpp"
#include "tests/seam_finding/support/wild_centres.hpp"
#include "tests/seam_finding/support/wild_sight.hpp"
#include "tests/seam_finding/support/wild_told.hpp"
#include "tests/seam_finding/support/wild_view.hpp"

namespace arcstart::seam_finding::synthetic {

using namespace cell_simulator;
using Eigen::Vector2d, Eigen::Vector3d;
namespace {

enum Purpose : std::uint64_t { kBackground = 41, kWorkpiece };  // of the random streams

constexpr double ghost_from_share = 0.3;    // extraction keeps what a mirror throws, not less
constexpr std::int64_t stripe_us = 71'000;  // 14 frames/s

void copy(const Vector3d& from, double to[3]) { std::copy(from.begin(), from.end(), to); }

// Sun and flicker leave less of the stripe's contrast, and so more noise.
double noise_by(const WildEvents& events, RandomStream& random) {
  constexpr double doubles_at_grey = 60;
  const double flicker = events.flicker_grey * (0.5 + 0.5 * std::sin(6.28 * random.uniform()));
  return 1 + (events.sun_grey + flicker) / doubles_at_grey;
}

// Of a spoilt stripe half shows nothing, half loses a part of itself.
void spoil(std::vector<WildCentre>& centres, int width, RandomStream& random) {
  if (random.uniform() < 0.5) {
    centres.clear();
    return;
  }
  const double from = random.uniform(0, width), to = from + random.uniform(0.1, 0.5) * width;
  std::erase_if(centres,
                [&](const WildCentre& c) { return c.pixel.x() >= from && c.pixel.x() <= to; });
  // What is left of a segment on either side counts as one of its own.
  int segment = -1, before = -1;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const bool parted = i == 0 || centres[i].segment != before ||
                        (centres[i - 1].pixel.x() < from) != (centres[i].pixel.x() < from);
    before = centres[i].segment;
    if (parted) {
      ++segment;
      for (std::size_t k : {i, i - 1})
        if (k < centres.size() && centres[k].segment_end == profile_t::CONTINUES)
          centres[k].segment_end = profile_t::SATURATION;
    }
    centres[i].segment = segment;
  }
  if (!centres.empty() && centres.back().segment_end == profile_t::CONTINUES)
    centres.back().segment_end = profile_t::SATURATION;
}

class Scanner {
 public:
  Scanner(const WildScene& wild, const Scene& scene, SceneKind kind, const WildScanChoice& choice)
      : wild_(wild),
        scene_(scene),
        kind_(kind),
        choice_(choice),
        settings_(sensor_of(wild)),
        taught_(taught_scene_of(wild)),
        sensor_(make_true_sensor(settings_)),
        told_(told_sensor(wild, sensor_)),
        surfaces_(surfaces_of(wild, kind)),
        on_tool_(on_tool(wild)),
        truth_(kind == SceneKind::workpiece ? truth_of(wild) : WildTruth{}),
        random_(wild.seed, kind == SceneKind::workpiece ? kWorkpiece : kBackground) {
    for (const WildSeam& seam : truth_.seams) sightings_.emplace_back(seam, wild.scan.pitch_mm);
    for (const SceneObject& object : scene.objects())
      mirrors_ = mirrors_ || object.surface.specular_share >= ghost_from_share ||
                 (object.band && object.band->surface.specular_share >= ghost_from_share);
  }

  WildScan scan() {
    const WildScanGeometry& geometry = wild_.scan;
    const double phase = kind_ == SceneKind::workpiece ? geometry.phase_share : random_.uniform();
    for (double along = geometry.begin_mm + phase * geometry.pitch_mm; along < geometry.end_mm;
         along += geometry.pitch_mm)
      add_stripe(along);
    for (const WildSightings& sightings : sightings_) result_.sights.push_back(sightings.sight());
    return std::move(result_);
  }

 private:
  Vector3d jolt(double deviation) {
    const double x = random_.normal(), y = random_.normal(), z = random_.normal();
    return deviation * Vector3d(x, y, z);
  }

  void add_stripe(double along) {
    const RigidTransform taught = taught_tool_pose(settings_, taught_, along);
    RigidTransform truly = taught;
    truly.translation() += jolt(wild_.scan.jitter_mm);
    // Where the work shakes the sensor sees it as if itself had moved the other way.
    if (kind_ == SceneKind::workpiece && wild_.events.shake_mm > 0)
      truly.translation() -= jolt(wild_.events.shake_mm);
    const std::vector<WildPiece> pieces = seen_pieces(
        scene_, sensor_, truly, on_tool_ ? &*on_tool_ : nullptr, mirrors_ ? ghost_from_share : 1);
    const WildExtraction extraction{sensor_.width, sensor_.height, choice_.end_noise_px,
                                    choice_.bend_blur_px,
                                    choice_.noise_factor * noise_by(wild_.events, random_)};
    std::vector<WildCentre> centres = centres_of(pieces, surfaces_, extraction, random_);
    const double spoilt = wild_.events.spoilt_share + (wild_.events.arc_grey > 0 ? 0.1 : 0);
    if (spoilt > 0 && random_.uniform() < spoilt) spoil(centres, sensor_.width, random_);
    add_profile(thinned(centres, choice_.downsample, choice_.bend_px), told_pose(wild_, taught));
    const Plane sheet = transform_plane(truly * sensor_.T_tool_camera,
                                        {sensor_.laser_normal, sensor_.laser_offset});
    for (WildSightings& sightings : sightings_) sightings.add(pieces, sheet);
  }

  void add_profile(const std::vector<WildCentre>& centres, const RigidTransform& T_base_tool) {
    const int index = static_cast<int>(result_.profiles.size());
    const RigidTransform T_base_camera = T_base_tool * told_.T_tool_camera;
    profile_t profile{};
    profile.utime = choice_.scan_id + stripe_us * (index + 1);
    profile.run_id = choice_.run_id;
    profile.seq = choice_.first_seq + index;
    profile.scan_id = choice_.scan_id;
    profile.scan_index = index;
    profile.calibration_id = choice_.calibration_id;
    transform_to_arrays(T_base_tool, profile.tool_position, profile.tool_quaternion);
    copy(T_base_camera.translation(), profile.camera_centre);
    std::vector<int>& objects = result_.objects.emplace_back();
    for (const WildCentre& centre : centres) {
      const auto at = on_sheet(told_, centre.pixel);
      constexpr double beside_px = 0.5;
      const auto beside = on_sheet(told_, centre.pixel + beside_px * centre.across);
      if (!at || !beside) continue;
      const Eigen::Vector3f p = (T_base_camera * *at).cast<float>();
      profile.x.push_back(p.x());
      profile.y.push_back(p.y());
      profile.z.push_back(p.z());
      profile.u.push_back(static_cast<float>(centre.pixel.x()));
      profile.v.push_back(static_cast<float>(centre.pixel.y()));
      profile.deviation.push_back(
          static_cast<float>(centre.deviation * (*beside - *at).norm() / beside_px));
      profile.segment.push_back(static_cast<std::int16_t>(centre.segment));
      profile.segment_end.push_back(centre.segment_end);
      objects.push_back(centre.object);
    }
    profile.count = static_cast<int>(profile.x.size());
    if (profile.count == 0) {
      profile.why = profile_t::NO_STRIPE;
      profile.empty = "stripe empty: no stripe found";
    }
    result_.profiles.push_back(std::move(profile));
  }

  const WildScene& wild_;
  const Scene& scene_;
  SceneKind kind_;
  WildScanChoice choice_;
  SensorSettings settings_;
  SceneSettings taught_;
  TrueSensor sensor_, told_;
  std::vector<WildSurface> surfaces_;
  std::optional<Scene> on_tool_;
  WildTruth truth_;
  RandomStream random_;
  bool mirrors_ = false;
  std::vector<WildSightings> sightings_;
  WildScan result_;
};

}  // namespace

WildScan wild_scan(const WildScene& wild, const Scene& scene, SceneKind kind,
                   const WildScanChoice& choice) {
  return Scanner(wild, scene, kind, choice).scan();
}

WildScan wild_scan(const WildScene& wild, SceneKind kind, const WildScanChoice& choice) {
  return wild_scan(wild, build(wild, kind), kind, choice);
}

}  // namespace arcstart::seam_finding::synthetic
