#include "services/cell_simulator/wild/wild_json.hpp"

#include <nlohmann/json.hpp>

#include "services/cell_simulator/scene/scene_object.hpp"

namespace arcstart::cell_simulator {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildSurface, albedo, mottling, specular_share,
                                                gloss_spread_rad, noise_px, dropout_share)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildCut, at_mm, turn_deg, slant_deg, chamfer_mm,
                                                round_mm, wave_mm, wave_pitch_mm, wave_phase_deg,
                                                cope_mm)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildHole, along_mm, away_mm, radius_mm)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildNotch, along_mm, width_mm, depth_mm)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildPlate, section, thickness_mm, away_mm,
                                                behind_mm, depth_mm, corner_radius_mm, begin, end,
                                                holes, notches, surface, ground_mm, ground)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildBead, along_mm, length_mm, leg_mm, other_side)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildRib, across_mm, thickness_mm, height_mm,
                                                begin_mm, end_mm)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildTab, at_begin, length_mm, half_width_mm,
                                                thickness_mm, lower_mm)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildWork, joint, first, second, second_missing,
                                                upside_down, corner, angle_deg, gap_begin_mm,
                                                gap_end_mm, mismatch_begin_mm, mismatch_end_mm,
                                                groove_deg, root_face_mm, bow_mm, position_mm,
                                                yaw_deg, tilt_deg, tilt_axis_deg, beads, ribs, tabs)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildSolid, kind, size_mm, position_mm, quaternion,
                                                points_mm, with_work, with_background, surface)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildTable, size_mm, unevenness_mm, slot_pitch_mm,
                                                slot_width_mm, slot_depth_mm, slot_offset_mm,
                                                slot_turn_deg, seed, surface)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildEvents, wire_radius_mm, wire_in_camera_mm,
                                                arc_grey, sun_grey, flicker_grey, shake_mm,
                                                spoilt_share)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildScanGeometry, lean_deg, pitch_mm, phase_share,
                                                begin_mm, end_mm, taught_height_mm, jitter_mm,
                                                robot_wave_mm, calibration_error)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WildScene, asked, seed, works, solids, table,
                                                events, scan)

namespace {

using Json = nlohmann::json;

// The first key of `given` that `known` lacks, with the way to it; empty if none.
std::string unknown_key(const Json& given, const Json& known, const std::string& way) {
  if (given.is_object()) {
    for (const auto& [key, value] : given.items()) {
      if (!known.contains(key)) return way + key;
      if (auto found = unknown_key(value, known.at(key), way + key + "."); !found.empty())
        return found;
    }
  } else if (given.is_array()) {
    for (std::size_t i = 0; i < given.size() && i < known.size(); ++i)
      if (auto found = unknown_key(given[i], known[i], way + std::to_string(i) + ".");
          !found.empty())
        return found;
  }
  return "";
}

}  // namespace

std::string to_json(const WildScene& scene) { return Json(scene).dump(1) + "\n"; }

WildScene wild_scene_from_json(const std::string& text) {
  try {
    const Json given = Json::parse(text);
    const auto scene = given.get<WildScene>();
    if (const std::string key = unknown_key(given, Json(scene), ""); !key.empty())
      throw SceneError("a scene of the wild has no " + key);
    return scene;
  } catch (const Json::exception& error) {
    throw SceneError(std::string("no scene of the wild: ") + error.what());
  }
}

}  // namespace arcstart::cell_simulator
