// A scene as workshops have them, as plain numbers: what works lie there, how they were cut, what
// lies about, how it is scanned. mm and degrees. Every number has the value of a plain scene where
// it is not given, and each element of a list stands for itself: any of them may be taken away.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace arcstart::cell_simulator {

// How an object answers light: to the renderer, and to a scan in closed form.
struct WildSurface {
  double albedo = 0.45;             // share sent back diffusely
  double mottling = 0.08;           // relative change of it over a few mm: rust, scale
  double specular_share = 0.1;      // share mirrored
  double gloss_spread_rad = 0.006;  // of the mirrored direction
  double noise_px = 0.1;            // of a stripe's centres across the stripe
  double dropout_share = 0;         // of its centres, in runs of some pixels

  bool operator==(const WildSurface&) const = default;
};

// Bright steel as a grinder leaves it, and mill scale. The noise is what extraction's own
// deviations say on real images, 0.05 to 0.3 px.
inline constexpr WildSurface ground_steel{0.5, 0.08, 0.12, 0.006, 0.08, 0};
inline constexpr WildSurface mill_scale{0.15, 0.3, 0.08, 0.02, 0.15, 0.002};

// How a plate ends along the seam. Turns, slants and waves carry the end outward where they are
// above 0 at the far side: at a distance t from the seam and a depth d under the plate's face it
// lies at_mm + outward * (t * tan(turn) + d * tan(slant) + wave).
struct WildCut {
  double at_mm = 0;       // along the seam, on the seam's line, before chamfers and copes
  double turn_deg = 0;    // of the cut in the plate's plane; 0: square to the seam
  double slant_deg = 0;   // of the cut through the thickness; 0: square to the face
  double chamfer_mm = 0;  // of the edge between face and cut, at 45 deg
  double round_mm = 0;    // radius of that edge; instead of a chamfer
  double wave_mm = 0;     // amplitude, of a flame's cut
  double wave_pitch_mm = 6;
  double wave_phase_deg = 0;
  double cope_mm = 0;  // radius of a quarter-round cut-out at the foot; uprights only
};

// In the plate's plane: along the seam and away from it.
struct WildHole {
  double along_mm = 0, away_mm = 30, radius_mm = 5;
};

// A rectangular cut-out of the edge that lies away from the seam.
struct WildNotch {
  double along_mm = 0, width_mm = 10, depth_mm = 8;
};

// away: from the seam, in the plate's plane. behind: a base plate's or lower plate's part on the
// other side of the seam.
struct WildPlate {
  std::string section = "plate";  // plate, angle (its heel at the seam) or hollow
  double thickness_mm = 8;        // of an angle's or a hollow section's wall
  double away_mm = 50, behind_mm = 0;
  double depth_mm = 40;         // of an angle or a hollow section, from its face
  double corner_radius_mm = 0;  // outside, of an angle's heel or a hollow section
  WildCut begin{-50}, end{50};
  std::vector<WildHole> holes;
  std::vector<WildNotch> notches;
  WildSurface surface;
  double ground_mm = 0;  // beside the seam, to both sides of it, the plate is ground; 0: nowhere
  WildSurface ground = ground_steel;  // how it answers there
};

// Weld metal along the joint: tacks, stitches, the other side's bead.
struct WildBead {
  double along_mm = 0;  // its middle
  double length_mm = 15;
  double leg_mm = 4;
  bool other_side = false;
};

// A further upright on the base plate, parallel to the first; its front face at y = across_mm.
struct WildRib {
  double across_mm = 40, thickness_mm = 8, height_mm = 40, begin_mm = -50, end_mm = 50;
};

// A run-off tab: a small plate against an end of the base plate or of a butt joint.
struct WildTab {
  bool at_begin = true;
  double length_mm = 25, half_width_mm = 20, thickness_mm = 6, lower_mm = 0;
};

// Work frame: x along the seam in the search's sense, through the taught middle; z out of the first
// plate; the open side looks to -y.
struct WildWork {
  std::string joint = "tee";  // tee, inside_corner, outside_corner, lap, butt, v
  WildPlate first, second;
  bool second_missing = false, upside_down = false;  // a wrong part
  // How an outside corner's plates meet: mitred; over: the first lies on the second's edge; butted:
  // it ends at the second's inner face; open: their inner edges meet, and leave a notch.
  std::string corner = "mitred";
  double angle_deg = 90;                    // of a tee or a corner, between the faces
  double gap_begin_mm = 0, gap_end_mm = 0;  // at the ends of the second plate
  double mismatch_begin_mm = 0,
         mismatch_end_mm = 0;                    // of butt and V: second plate's top above first
  double groove_deg = 60, root_face_mm = 0;      // of a V
  double bow_mm = 0;                             // in 100 mm along the seam, ends up: above 0
  std::array<double, 3> position_mm{950, 0, 0};  // of the work's middle; z: of its lowest point
  double yaw_deg = 0, tilt_deg = 0, tilt_axis_deg = 0;
  std::vector<WildBead> beads;
  std::vector<WildRib> ribs;
  std::vector<WildTab> tabs;
};

// What lies about, in base.
struct WildSolid {
  // block: edges size_mm, about its middle; round, hexagon: length and radius (hexagon: of its
  // corners), about its middle, along its own x; ball: radius; cable: radius, through `points_mm`;
  // hammer, pliers: lying on z = 0 of their own frame. size_mm holds these in this order.
  std::string kind = "block";
  std::array<double, 3> size_mm{20, 20, 20};
  std::array<double, 3> position_mm{0, 0, 0};
  std::array<double, 4> quaternion{1, 0, 0, 0};  // w, x, y, z
  std::vector<std::array<double, 3>> points_mm;  // in base; of a cable alone
  bool with_work = true, with_background = false;
  WildSurface surface;
};

struct WildTable {
  double size_mm = 700;
  double unevenness_mm = 0.2;  // highest deviation from flat
  double slot_pitch_mm = 0;    // 0: no slots
  double slot_width_mm = 12, slot_depth_mm = 15, slot_offset_mm = 0;
  double slot_turn_deg = 0;  // of the slots from base x
  std::uint64_t seed = 1;    // of its waves
  WildSurface surface{0.35, 0.25, 0, 0.01, 0.12, 0};
};

// What spoils a scan for a while or all along.
struct WildEvents {
  double wire_radius_mm = 0;  // a nozzle with its wire before the sensor, on the tool; 0: none
  std::array<double, 3> wire_in_camera_mm{0, 45, 200};  // the wire's tip, in camera
  double arc_grey = 0;                                  // neighbour's arc; 0: none
  double sun_grey = 0;                                  // added to the ambient light
  double flicker_grey = 0;  // amplitude of a light that changes from frame to frame
  double shake_mm = 0;      // standard deviation of the work's place, by frame
  double spoilt_share = 0;  // of stripes that show nothing, or half of it
};

struct WildScanGeometry {
  double lean_deg = 38;                // of the optical axis over the open side
  double pitch_mm = 3.6;               // between stripes
  double phase_share = 0.5;            // of a pitch, of the first stripe
  double begin_mm = -90, end_mm = 90;  // along the search, from the taught middle
  double taught_height_mm = 10;        // of the taught seam above the table
  double jitter_mm = 0.02;             // of the tool's place by stripe, each axis
  double robot_wave_mm = 0;            // amplitude of a smooth error of 400 mm wavelength
  double calibration_error = 0;  // factor on a typical error of calibration; 0: the truth is told
};

struct WildScene {
  std::string asked = "tee";  // the joint that the scan is to find
  std::uint64_t seed = 0;     // of all noise; and of what it was drawn from
  std::vector<WildWork> works;
  std::vector<WildSolid> solids;
  WildTable table;
  WildEvents events;
  WildScanGeometry scan;
};

// The names of the joints that can be drawn.
inline constexpr std::array<const char*, 6> wild_joints{"tee", "inside_corner", "outside_corner",
                                                        "lap", "butt",          "v"};

// The same arguments draw the same scene on every machine. Throws SceneError where there is no such
// joint.
WildScene draw_wild_scene(const std::string& joint, std::uint64_t seed);

}  // namespace arcstart::cell_simulator
