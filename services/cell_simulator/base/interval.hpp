// The part of a segment in which linear conditions hold.
#pragma once

namespace arcstart::cell_simulator {

// Shares of the way from a segment's begin (0) to its end (1).
struct Interval {
  double begin = 0, end = 1;

  bool empty() const { return !(begin < end); }

  // Keeps where a quantity that is linear along the segment, given at 0 and at 1, is not below 0.
  void keep(double at_begin, double at_end) {
    if (at_begin < 0 && at_end < 0) {
      begin = end;
      return;
    }
    if (at_begin < 0) {
      const double zero = at_begin / (at_begin - at_end);
      if (zero > begin) begin = zero;
    } else if (at_end < 0) {
      const double zero = at_begin / (at_begin - at_end);
      if (zero < end) end = zero;
    }
  }
};

}  // namespace arcstart::cell_simulator
