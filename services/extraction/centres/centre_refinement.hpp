// Centres measured once more at another sigma.
#pragma once

#include <vector>

#include "services/extraction/ridge/ridge_point.hpp"

namespace arcstart::extraction {

// Ridge points found at another sigma, sorted so that the one beside a place is quickly found.
class MeasuredAgain {
 public:
  // measured: in any order; sorted, and must outlive this.
  MeasuredAgain(std::vector<RidgePoint>& measured, bool along_rows);

  // Of those in its column (row) the nearest within reach; px. Null where there is none.
  const RidgePoint* beside(const RidgePoint& point, int reach) const;

 private:
  int line(const RidgePoint& p) const { return along_rows_ ? p.row : p.column; }
  float across(const RidgePoint& p) const { return along_rows_ ? p.u : p.v; }
  bool before(const RidgePoint& a, const RidgePoint& b) const {
    return line(a) != line(b) ? line(a) < line(b) : across(a) < across(b);
  }

  const std::vector<RidgePoint>& measured_;
  bool along_rows_;
};

}  // namespace arcstart::extraction
