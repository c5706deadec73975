// Section `seam_finding` of cell.yaml.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "common/configuration.hpp"

namespace arcstart::seam_finding {

enum class BackgroundRule { kSurface, kNeighbours };
enum class PlaneRule { kRanked, kLargest };
enum class StartRule { kEdges, kStripe, kCentroid };
enum class WeldStart { kNear, kFar };

struct SeamFindingSettings {
  // Background. `surface`: nearer than the distance to the background's local surface.
  // `neighbours`: the paper's rule, the K-th nearest background point is nearer than that; it needs
  // stripes closer together than the distance.
  BackgroundRule background_rule = BackgroundRule::kSurface;
  // 0: by the rule. `neighbours`: the paper's 1.5. `surface`: 0.7, for the thinnest sheet that lies
  // on the table, of 0.8 mm, is thicker, and what two scans of one table differ by is less.
  double background_distance_mm = 0;
  double background_distance() const {
    if (background_distance_mm > 0) return background_distance_mm;
    return background_rule == BackgroundRule::kNeighbours ? 1.5 : 0.7;
  }
  int background_neighbours = 3;  // K

  // Planes. `ranked`: all planes of what is left, and of all their pairs the best joint. `largest`:
  // the paper's way, the largest plane and the largest second one under Eq. 6; it takes a large box
  // for the workpiece.
  PlaneRule plane_rule = PlaneRule::kRanked;
  int planes_max = 16;
  int plane_points_min = 30;  // a plane of fewer points is none
  double plane_tolerance_mm =
      0;  // a point on a plane lies no farther from it; 0: from the cloud's own noise

  // Joint wanted. `tee`: a fillet. `corner`: the same between two edges, seen from inside; its
  // points do not tell the two apart. `outside_corner`: seen from outside; its points do not tell
  // it from the edge of a box, so that there must be none. `lap`, `butt`, `v` (groove). `any`: tee,
  // lap, butt or v.
  std::string joint_type = "tee";
  // Theta of Eq. 6 between the plates of a tee or corner, and its epsilon: fillet welds join faces
  // under 60 to 120 deg (EN 1993-1-8, 4.3.2.1).
  double angle_deg = 90;
  double angle_tolerance_deg = 30;
  double outside_corner_angle_deg = 90;
  double outside_corner_tolerance_deg = 30;
  double parallel_tolerance_deg = 4;  // epsilon of lap, butt and v, whose theta is 0
  double lap_thickness_min_mm = 1.5;  // of the upper plate, where other parallel joints are wanted,
                                      // too: a smaller step is taken for none
  double lap_thickness_max_mm = 12;
  double butt_gap_max_mm = 4;
  // Of a butt joint's or a groove's tops, where they alone are wanted. From above a lap of sheet as
  // thin looks no different where both touch: set it below the thinnest sheet that may lie there by
  // mistake. ISO 5817, 507, level B: a tenth of the thickness; of plates of 10 mm.
  double mismatch_max_mm = 1;
  double v_angle_deg = 60;  // between the two slants
  double v_angle_tolerance_deg = 35;
  double v_width_max_mm = 44;  // of the groove at its top: plates of 20 mm that open by 95 deg

  double refit_distance_mm = 60;  // plates are fitted again to what lies so near the seam
  int outlier_neighbours =
      10;  // statistical outlier removal in that fit, of points 1.5 mm apart; 0: none. Not of ends
  double outlier_deviations =
      3;  // a point is dropped whose mean distance to them is so far above the plate's mean

  // Start. `edges`: from the edges of both plates, each drawn through the places where stripes
  // leave it, at their full resolution. `stripe`: half-way between the first stripe that crosses
  // both plates and the one before it. `centroid`: the paper's way, the centroid of the first x
  // points of both plates along the seam.
  StartRule start_rule = StartRule::kEdges;
  int start_points = 10;  // x
  // So many pixels before the edge of what it lies on a segment ends, square to the edge in the
  // image, whatever the slant at which the stripe crosses it. The extraction puts them at the edge;
  // for stripes that come from elsewhere.
  double edge_shortening_px = 0;
  // How far plates' edges are out of square to the seam, mm over 100 mm, two standard deviations:
  // ISO 2768-2 allows 0.2 in class H, 0.4 in K, 0.6 in L. The less, the more a place away from the
  // seam tells of the start; places in larger number tell an edge's slope themselves.
  double edge_squareness_mm = 0.2;
  // The same as a standard deviation: mm along the seam for each mm away from it.
  double edge_slope() const { return edge_squareness_mm / (2 * 100); }

  // What the robot's positions err by in the base's frame, each axis, standard deviation: smoothly
  // along a scan, so that no stripe shows it. ISO 9283, pose accuracy, of the data sheet or better
  // measured in the cell. 0: deviations hold in the robot's own coordinates, in which it welds,
  // too.
  double robot_accuracy_mm = 0;

  // Torch.
  double torch_work_angle_deg = 0;     // between it and the flatter plate; 0: in the middle of both
  double torch_travel_angle_deg = 10;  // leaning back, so that the wire points ahead
  double approach_mm = 100;            // from the start back along the torch
  // Its orientation as taught: of the tool in base, W P R in deg, z along the wire into the joint.
  // Empty: by the angles above.
  std::vector<double> torch_wpr_deg;
  // Of the wire's tip from the start, not of the start itself: along the weld, z half-way between
  // the plates' normals out of the joint, and y = z x x; x, y, z in mm.
  std::array<double, 3> bias_mm = {0, 0, 0};

  // Where the seam is looked for, and at which end it starts. Mostly a job's.
  // x, y, z of two corners in base: the start and the end of the seam lie between them. A joint
  // whose middle does not is none of the candidates. Empty: anywhere.
  std::vector<double> search_box_mm;
  // x, y, z in base, any length: what near and far are counted along. Empty: the tool's own way in
  // the scan, so that a scan run backwards gives the other end.
  std::vector<double> search_direction;
  // The weld starts at that end of the seam which a search comes to first, or at the far one.
  WeldStart weld_start = WeldStart::kNear;
  // An end that is known less well is not determined; random part, standard deviation along its
  // worst axis. 0: no limit but the stripes' own spacing.
  double end_deviation_max_mm = 0;
  // Background scans count that were made for this job (arcstart scan --kind background --job
  // NAME); empty: any.
  std::string background_job = "";

  // When to refuse.
  // A shorter seam is none: the edge of a block, of a clamp's jaw, of a bar's end. EN 1993-1-8,
  // 4.5.1: a fillet weld of less than 30 mm carries no load. 0: any length.
  double seam_length_min_mm = 30;
  int stripes_min = 5;  // with points of both plates at the seam
  double ambiguity_ratio =
      1.5;  // a second joint whose score comes within this factor makes it ambiguous
  double lost_share_max =
      0.25;  // of a scan's images without a profile, or with one of unknown position
  double dead_chain_s =
      5;  // real time without a word from the chain before an open scan is given up

  // The clocks that stamp images and positions may displace a seam by the tool's speed times their
  // difference. By more than this surely, or by ten times as much perhaps: the scan is refused. By
  // more than this perhaps, or where they were not compared: the seam is found, and `usable` says
  // CLOCKS_APART. A seam's start is known to a tenth of a millimetre where it was seen.
  double clock_displacement_max_mm = 0.1;

  int backgrounds_kept = 5;  // newest background scans kept in the state folder
  // Newest answers kept there: the history (arcstart history). Some 10 KB each.
  int results_kept = 1000;

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("background_rule", background_rule, Names{{"surface", "neighbours"}});
    visitor("background_distance_mm", background_distance_mm, between(0, 20));
    visitor("background_neighbours", background_neighbours, between(1, 50));
    visitor("plane_rule", plane_rule, Names{{"ranked", "largest"}});
    visitor("planes_max", planes_max, between(2, 64));
    visitor("plane_points_min", plane_points_min, between(10, 100000));
    visitor("plane_tolerance_mm", plane_tolerance_mm, between(0, 20));
    visitor("joint_type", joint_type,
            one_of({"any", "tee", "corner", "outside_corner", "lap", "butt", "v"}));
    visitor("angle_deg", angle_deg, between(30, 150));
    visitor("angle_tolerance_deg", angle_tolerance_deg, between(1, 45));
    visitor("outside_corner_angle_deg", outside_corner_angle_deg, between(30, 150));
    visitor("outside_corner_tolerance_deg", outside_corner_tolerance_deg, between(1, 60));
    visitor("parallel_tolerance_deg", parallel_tolerance_deg, between(0.5, 20));
    visitor("lap_thickness_min_mm", lap_thickness_min_mm, between(0.2, 100));
    visitor("lap_thickness_max_mm", lap_thickness_max_mm, between(0.2, 100));
    visitor("butt_gap_max_mm", butt_gap_max_mm, between(0.2, 20));
    visitor("mismatch_max_mm", mismatch_max_mm, between(0.2, 20));
    visitor("v_angle_deg", v_angle_deg, between(20, 150));
    visitor("v_angle_tolerance_deg", v_angle_tolerance_deg, between(1, 60));
    visitor("v_width_max_mm", v_width_max_mm, between(1, 100));
    visitor("refit_distance_mm", refit_distance_mm, between(5, 500));
    visitor("outlier_neighbours", outlier_neighbours, between(0, 100));
    visitor("outlier_deviations", outlier_deviations, between(0.5, 20));
    visitor("start_rule", start_rule, Names{{"edges", "stripe", "centroid"}});
    visitor("start_points", start_points, between(1, 1000));
    visitor("edge_shortening_px", edge_shortening_px, between(0, 20));
    visitor("edge_squareness_mm", edge_squareness_mm, between(0.01, 5));
    visitor("robot_accuracy_mm", robot_accuracy_mm, between(0, 5));
    visitor("torch_work_angle_deg", torch_work_angle_deg, between(0, 150));
    visitor("torch_travel_angle_deg", torch_travel_angle_deg, between(-45, 45));
    visitor("approach_mm", approach_mm, between(10, 1000));
    visitor("torch_wpr_deg", torch_wpr_deg, is_turn_or_empty);
    visitor("bias_mm", bias_mm, is_near);
    visitor("search_box_mm", search_box_mm, is_box_or_empty);
    visitor("search_direction", search_direction, is_direction_or_empty);
    visitor("weld_start", weld_start, Names{{"near", "far"}});
    visitor("end_deviation_max_mm", end_deviation_max_mm, between(0, 20));
    visitor("background_job", background_job);
    visitor("seam_length_min_mm", seam_length_min_mm, between(0, 1000));
    visitor("stripes_min", stripes_min, between(3, 1000));
    visitor("ambiguity_ratio", ambiguity_ratio, between(1, 10));
    visitor("lost_share_max", lost_share_max, between(0, 0.5));
    visitor("dead_chain_s", dead_chain_s, between(0.5, 600));
    visitor("clock_displacement_max_mm", clock_displacement_max_mm, between(0.01, 10));
    visitor("backgrounds_kept", backgrounds_kept, between(1, 1000));
    visitor("results_kept", results_kept, between(1, 10000));
  }

  static std::string is_turn_or_empty(const std::vector<double>& wpr) {
    return wpr.empty() || wpr.size() == 3 ? "" : "must be three numbers W P R, or none";
  }
  static std::string is_near(const std::array<double, 3>& bias) {
    for (const double number : bias)
      if (!(std::abs(number) <= 50)) return "must lie within 50 mm";
    return "";
  }
  static std::string is_box_or_empty(const std::vector<double>& box) {
    if (box.empty()) return "";
    if (box.size() != 6) return "must be six numbers, x y z of two corners, or none";
    for (int axis = 0; axis < 3; ++axis)
      if (!(box[axis] < box[axis + 3])) return "must have its lower corner first";
    return "";
  }
  static std::string is_direction_or_empty(const std::vector<double>& direction) {
    if (direction.empty()) return "";
    if (direction.size() != 3) return "must be three numbers x y z, or none";
    return std::hypot(direction[0], direction[1], direction[2]) > 1e-6 ? "" : "must not be 0";
  }
};

}  // namespace arcstart::seam_finding
