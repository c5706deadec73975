// What stands in the simulated cell, in base: mm and degrees. The search runs along base +x; the
// joint's open side looks to base -y, and there the sensor leans.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/configuration.hpp"

namespace arcstart::cell_simulator {

// The keys are a part of section `cell_simulator` of cell.yaml.
struct SceneSettings {
  // The taught work: middle of the joint over the table's top; x, y, z mm. The seed moves the real
  // work about it.
  std::array<double, 3> work_position_mm{950, 0, 0};
  double place_range_mm = 12;     // work off its taught place in x and in y, at most
  double yaw_range_deg = 15;      // work turned about z, at most
  double tilt_range_deg = 3;      // work tilted about a level axis, at most
  double size_range_share = 0.2;  // plates longer, wider or thicker than below, at most

  // How the plates meet. tee: the upright stands on the base plate. outside_corner: it stands under
  // the base plate's edge, both mitred. lap: it lies on the base plate. butt, v: it lies beside it,
  // the edges cut square or slanting. The base plate is then half as wide, but for the lap.
  std::string joint = "tee";
  std::array<double, 3> base_plate_mm{110, 110, 10};   // along the seam, across it, thickness
  std::array<double, 3> upright_plate_mm{100, 8, 45};  // along the seam, thickness, height
  double joint_angle_deg = 90;   // of a tee, between the plates' faces on the open side
  double root_gap_mm = 0;        // between the plates: under the upright or upper, or at the root
  double groove_angle_deg = 60;  // of a V, between its two slants

  double search_begin_mm =
      -80;  // taught positions, along the search from the middle of the taught work
  double search_end_mm = 70;  // 150 mm of search
  // For what a calibration is checked by: the search rises by so much from its begin to its end,
  // half of it below the taught height; and sensor and search are turned about the vertical through
  // the taught work.
  double search_rise_mm = 0;
  double search_turn_deg = 0;

  double table_size_mm = 700;        // square, its middle under the taught work
  double table_pitch_mm = 4;         // of its mesh
  double table_unevenness_mm = 0.4;  // highest deviation from flat, up and down

  double ball_radius_mm = 0;  // a ball on the table's top in place of the joint; 0: none

  bool tool_lying_about = true;  // a hammer or a pair of pliers near the work
  bool box_beside = false;       // bigger than the plates, behind the work
  bool box_on_base = false;      // small, on the base plate's open side

  double plate_albedo = 0.45;          // share of the light sent back diffusely
  double plate_specular_share = 0.35;  // share mirrored; makes the ghost stripes, 0 for none
  double table_albedo = 0.35;

  // STL files that stand with the work, mm; relative to the working folder.
  std::vector<std::string> stl_files;
  // Six numbers a file: x, y, z mm and turns about the fixed x, y, z of base (in this order) deg.
  std::vector<double> stl_poses;

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("work_position_mm", work_position_mm);
    visitor("place_range_mm", place_range_mm, between(0, 100));
    visitor("yaw_range_deg", yaw_range_deg, between(0, 45));
    visitor("tilt_range_deg", tilt_range_deg, between(0, 20));
    visitor("size_range_share", size_range_share, between(0, 0.5));
    visitor("joint", joint, one_of({"tee", "outside_corner", "lap", "butt", "v"}));
    visitor("base_plate_mm", base_plate_mm, each_positive);
    visitor("upright_plate_mm", upright_plate_mm, each_positive);
    visitor("joint_angle_deg", joint_angle_deg, between(60, 120));
    visitor("root_gap_mm", root_gap_mm, between(0, 10));
    visitor("groove_angle_deg", groove_angle_deg, between(20, 120));
    visitor("search_begin_mm", search_begin_mm, between(-500, 500));
    visitor("search_end_mm", search_end_mm, between(-500, 500));
    visitor("search_rise_mm", search_rise_mm, between(-200, 200));
    visitor("search_turn_deg", search_turn_deg, between(-180, 180));
    visitor("table_size_mm", table_size_mm, between(10, 3000));
    visitor("table_pitch_mm", table_pitch_mm, between(1, 100));
    visitor("table_unevenness_mm", table_unevenness_mm, between(0, 20));
    visitor("ball_radius_mm", ball_radius_mm, between(0, 100));
    visitor("tool_lying_about", tool_lying_about);
    visitor("box_beside", box_beside);
    visitor("box_on_base", box_on_base);
    visitor("plate_albedo", plate_albedo, between(0, 1));
    visitor("plate_specular_share", plate_specular_share, between(0, 1));
    visitor("table_albedo", table_albedo, between(0, 1));
    visitor("stl_files", stl_files);
    visitor("stl_poses", stl_poses);
  }

  static std::string each_positive(const std::array<double, 3>& lengths) {
    for (const double length : lengths)
      if (!(length > 0)) return "must be three lengths greater than 0";
    return "";
  }
};

}  // namespace arcstart::cell_simulator
