#pragma once

#include "common/configuration.hpp"

namespace arcstart::reconstruction {

// Section `reconstruction` of cell.yaml.
struct ReconstructionSettings {
  // M of the down-sampling: of each segment the centres 0, M, 2M ... and the last are kept; 1 keeps
  // all.
  int keep_every = 15;
  // A centre between two that are kept is kept as well where the stripe departs so far from the
  // straight line between them; px, 0 for none. A gap narrower than M centres shows in no other
  // way.
  double keep_bend_px = 0.5;
  // How long positions are kept for stripes that come late.
  double keep_positions_s = 10;
  // The two positions around a stripe may be so far apart; above it the profile is empty.
  double largest_gap_ms = 100;
  // How far positions may run ahead of a stripe before a calibration is known. Less than
  // keep_positions_s.
  double wait_for_calibration_s = 3;
  // Most stripes that wait for a position; above it the oldest is given up.
  int waiting_stripes = 1000;
  // Working range of the sensor, depth along the optical axis; points outside are dropped.
  double nearest_mm = 50;
  double farthest_mm = 1000;
  // A stripe that waits longer than this is told in STATUS; it changes no result.
  double silence_warning_s = 2;

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("keep_every", keep_every, between(1, 10000));
    visitor("keep_bend_px", keep_bend_px, between(0, 100));
    visitor("keep_positions_s", keep_positions_s, between(0.5, 60));
    visitor("largest_gap_ms", largest_gap_ms, between(1, 1000));
    visitor("wait_for_calibration_s", wait_for_calibration_s, between(0, 30));
    visitor("waiting_stripes", waiting_stripes, between(1, 100000));
    visitor("nearest_mm", nearest_mm, between(1, 100000));
    visitor("farthest_mm", farthest_mm, between(1, 100000));
    visitor("silence_warning_s", silence_warning_s, between(0.1, 3600));
  }
};

}  // namespace arcstart::reconstruction
