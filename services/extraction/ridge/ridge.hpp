// Steger's ridge points in an image (Eq. 2 and 3).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "services/extraction/image/gaussian_kernels.hpp"
#include "services/extraction/image/grey_image.hpp"
#include "services/extraction/image/thread_pool.hpp"
#include "services/extraction/rejection/block_rejection.hpp"
#include "services/extraction/ridge/ridge_point.hpp"

namespace arcstart::extraction {

// Factor from curvature to the ridge strength N of Eq. 3, sigma^exponent. A Gaussian stripe of
// amplitude A and width w has curvature A w / (w^2 + sigma^2)^(3/2); times sigma^(3/2) that is
// largest where sigma = w, there A / (2^(3/2) sqrt(w)), so that with 3/2 the best scale is the
// stripe's own. The position never depends on it.
double strength_factor(double sigma, double exponent);

class RidgeDetector {
 public:
  // px, in columns and in rows: pixels of neighbouring points of a line lie no farther apart.
  static constexpr int kLineReach = 3;
  // px, of a point from its pixel's middle, in u and in v: within its own pixel, and where no other
  // has it.
  static constexpr float kOwnPixel = 0.5, kFarthest = 0.6f;

  // threads: that work on an image at once, each on a strip of it. The points do not depend on how
  // many.
  explicit RidgeDetector(int threads = 1)
      : pool_(threads), strips_(static_cast<std::size_t>(threads)) {}

  // Every pixel whose Hessian (greys smoothed with the kernels, mirrored at the border) has a
  // negative eigenvalue of at least least_curvature in size, no smaller than the other's, and whose
  // extremum along the eigenvector lies within half a pixel in u and in v. In raster order of the
  // pixels. Pixels nearer than margin(kernels) to the border are left out: there the mirror image
  // bends the line. Exact: blocks are skipped only where they cannot hold such a pixel. An image no
  // larger than the kernels has none.
  void detect(const GreyImage& image, const GaussianKernels& kernels, double least_curvature,
              std::vector<RidgePoint>& points);

  // By that a line midway between two rows of pixels has no point: beside its crest it is curved
  // less, so that the extremum seems farther than it is. So from here on it may lie a tenth of a
  // pixel farther, where the pixel that it lies in does not have it.
  //
  // Of those points all that hang together with one of at least strong_curvature, neighbours being
  // kLineReach apart at most, and some others: what hysteresis needs. Blocks without a strong point
  // are looked at only where a line leads into them. border: instead of the margin; px. False, with
  // no points, where they and the others, some found twice, are more than most_points: no further
  // blocks are looked at then.
  bool detect_lines(const GreyImage& image, const GaussianKernels& kernels, double least_curvature,
                    double strong_curvature, int border, std::vector<RidgePoint>& points,
                    std::size_t most_points = std::numeric_limits<std::size_t>::max());

  // The points in the blocks within reach (px) of those named, and others. The image is the one
  // looked at last.
  void detect_about(const GreyImage& image, const GaussianKernels& kernels, double least_curvature,
                    int border, const std::vector<RidgePoint>& about, int reach,
                    std::vector<RidgePoint>& points);

  // At two sigma the mirrored half shifts a line by less than 0.02 px per px of sigma and unit of
  // slope.
  static int margin(const GaussianKernels& kernels);

  // Of the blocks of detect's or detect_lines' last image: those looked at.
  double active_share() const { return active_share_; }

 private:
  // What one thread works with.
  struct Strip {
    std::vector<float> work;
    std::vector<RidgePoint> found;  // block by block
    std::vector<int> of_row;        // how many of them, for each of the image's rows
    std::size_t followed = 0;       // of those found: the blocks around them are wanted
    int looked_at = 0;              // blocks
  };
  // Which pixels.
  struct Sought {
    double least_curvature;  // grey values / px^2
    double farthest;         // px
    int border;              // px
  };
  // False as detect_lines.
  bool look(const GreyImage& image, const GaussianKernels& kernels, const Sought& sought,
            double strong_curvature, std::vector<RidgePoint>& points, std::size_t most_points);
  void want(int column, int row);
  // False where the strips have found more than most_points together.
  bool look_at_wanted(const GreyImage& image, const GaussianKernels& kernels, const Sought& sought,
                      std::size_t most_points);
  bool begins_tile(int i) const;  // the i-th wanted block
  void use(const GaussianKernels& kernels, int rows);
  void want_about(const RidgePoint& point, int reach, const GreyImage& image);
  void collect_in_raster_order(int height, std::vector<RidgePoint>& points);
  void drop_twice_found(std::vector<RidgePoint>& points);

  ThreadPool pool_;
  std::vector<Strip> strips_;
  std::atomic<std::size_t> found_ = 0;  // points, in all strips
  BlockRejection rejection_;
  std::vector<float> smooth_, first_, second_;
  std::vector<int> wanted_;  // blocks to be looked at, column by column
  std::vector<std::uint8_t> is_wanted_;
  std::vector<int> row_begin_, row_end_;  // in the points, of each row
  double active_share_ = 0;
};

}  // namespace arcstart::extraction
