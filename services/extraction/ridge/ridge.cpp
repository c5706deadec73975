#include "services/extraction/ridge/ridge.hpp"

#include <algorithm>
#include <cmath>

#include "services/extraction/ridge/ridge_tile.hpp"

namespace arcstart::extraction {
namespace {

static_assert(kTileWidth == BlockRejection::kWidth);

}  // namespace

double strength_factor(double sigma, double exponent) { return std::pow(sigma, exponent); }

int RidgeDetector::margin(const GaussianKernels& kernels) {
  return static_cast<int>(std::ceil(2 * kernels.sigma));
}

void RidgeDetector::detect(const GreyImage& image, const GaussianKernels& kernels,
                           double least_curvature, std::vector<RidgePoint>& points) {
  look(image, kernels, {least_curvature, kOwnPixel, margin(kernels)}, least_curvature, points,
       std::numeric_limits<std::size_t>::max());
}

bool RidgeDetector::detect_lines(const GreyImage& image, const GaussianKernels& kernels,
                                 double least_curvature, double strong_curvature, int border,
                                 std::vector<RidgePoint>& points, std::size_t most_points) {
  const bool all_found = look(image, kernels, {least_curvature, kFarthest, border},
                              strong_curvature, points, most_points);
  drop_twice_found(points);
  return all_found;
}

bool RidgeDetector::look(const GreyImage& image, const GaussianKernels& kernels,
                         const Sought& sought, double strong_curvature,
                         std::vector<RidgePoint>& points, std::size_t most_points) {
  active_share_ = 0;
  if (std::min(image.width, image.height) <= 2 * kernels.half_width + 1) {
    points.clear();
    return true;
  }
  rejection_.mark(image, kernels, strong_curvature, pool_);
  use(kernels, image.height);

  const int columns = rejection_.columns(), rows = rejection_.rows();
  wanted_.clear();
  is_wanted_.assign(static_cast<std::size_t>(columns) * rows, 0);
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < rows; ++row)
      if (rejection_.active(column, row)) want(column, row);
  bool all_found = true;
  while (all_found && !wanted_.empty()) {
    all_found = look_at_wanted(image, kernels, sought, most_points);
    wanted_.clear();
    const bool more = std::find(is_wanted_.begin(), is_wanted_.end(), 0) != is_wanted_.end();
    if (all_found && more && sought.least_curvature < strong_curvature)
      for (Strip& strip : strips_)
        for (; strip.followed < strip.found.size(); ++strip.followed)
          want_about(strip.found[strip.followed], kLineReach, image);
    std::sort(wanted_.begin(), wanted_.end());
  }
  int looked_at = 0;
  for (const Strip& strip : strips_) looked_at += strip.looked_at;
  active_share_ = static_cast<double>(looked_at) / static_cast<double>(is_wanted_.size());
  if (all_found)
    collect_in_raster_order(image.height, points);
  else
    points.clear();
  return all_found;
}

void RidgeDetector::detect_about(const GreyImage& image, const GaussianKernels& kernels,
                                 double least_curvature, int border,
                                 const std::vector<RidgePoint>& about, int reach,
                                 std::vector<RidgePoint>& points) {
  if (std::min(image.width, image.height) <= 2 * kernels.half_width + 1) return points.clear();
  use(kernels, image.height);
  wanted_.clear();
  is_wanted_.assign(static_cast<std::size_t>(rejection_.columns()) * rejection_.rows(), 0);
  for (const RidgePoint& point : about) want_about(point, reach, image);
  std::sort(wanted_.begin(), wanted_.end());
  look_at_wanted(image, kernels, {least_curvature, kFarthest, border},
                 std::numeric_limits<std::size_t>::max());
  collect_in_raster_order(image.height, points);
  drop_twice_found(points);
}

void RidgeDetector::use(const GaussianKernels& kernels, int rows) {
  found_ = 0;
  smooth_.assign(kernels.smooth.begin(), kernels.smooth.end());
  first_.assign(kernels.first.begin(), kernels.first.end());
  second_.assign(kernels.second.begin(), kernels.second.end());
  for (Strip& strip : strips_) {
    strip.work.resize(ridge_tile_work(kernels.half_width));
    strip.found.clear();
    strip.of_row.assign(static_cast<std::size_t>(rows), 0);
    strip.followed = 0;
    strip.looked_at = 0;
  }
}

void RidgeDetector::want(int column, int row) {
  const int block = column * rejection_.rows() + row;
  if (is_wanted_[block] != 0) return;
  is_wanted_[block] = 1;
  wanted_.push_back(block);
}

// A tile has as many of the wanted blocks as touch down the image, so that its halo is filtered
// once.
bool RidgeDetector::begins_tile(int i) const {
  return i == 0 || wanted_[i] != wanted_[i - 1] + 1 || wanted_[i] % rejection_.rows() == 0;
}

// The tiles are the same for any number of strips, and so is what rounding does in them. So is the
// answer: points found are never fewer for looking further, and only more than most_points stop it.
bool RidgeDetector::look_at_wanted(const GreyImage& image, const GaussianKernels& kernels,
                                   const Sought& sought, std::size_t most_points) {
  const auto count = static_cast<int>(wanted_.size());
  const auto next_tile = [&](int i) {
    while (i < count && !begins_tile(i)) ++i;
    return i;
  };
  pool_.run([&](int index) {
    const StripRange share(count, index, pool_.size());
    Strip& strip = strips_[index];
    for (int i = next_tile(share.begin), end = 0; i < share.end && found_ <= most_points; i = end) {
      end = next_tile(i + 1);
      strip.looked_at += end - i;
      const int column = wanted_[i] / rejection_.rows(), row = wanted_[i] % rejection_.rows();
      const int first_row = std::max(row * BlockRejection::kHeight, sought.border);
      const int end_row =
          std::min((row + end - i) * BlockRejection::kHeight, image.height - sought.border);
      if (first_row >= end_row) continue;
      const std::size_t before = strip.found.size();
      find_ridge_points(
          {image, smooth_.data(), first_.data(), second_.data(), kernels.half_width,
           static_cast<float>(sought.least_curvature), static_cast<float>(sought.farthest),
           column * BlockRejection::kWidth, first_row, end_row - first_row, sought.border,
           image.width - 1 - sought.border, strip.work.data()},
          strip.found);
      for (std::size_t k = before; k < strip.found.size(); ++k) ++strip.of_row[strip.found[k].row];
      found_ += strip.found.size() - before;
    }
  });
  return found_ <= most_points;
}

void RidgeDetector::want_about(const RidgePoint& p, int reach, const GreyImage& image) {
  const auto block_of = [](int at, int size, int block) {
    return std::clamp(at, 0, size - 1) / block;
  };
  const int left = block_of(p.column - reach, image.width, BlockRejection::kWidth),
            right = block_of(p.column + reach, image.width, BlockRejection::kWidth);
  const int top = block_of(p.row - reach, image.height, BlockRejection::kHeight),
            bottom = block_of(p.row + reach, image.height, BlockRejection::kHeight);
  for (const int column : {left, right})
    for (const int row : {top, bottom}) want(column, row);
}

// Found tile by tile: sorted by row in one go, where most follow on those of their row that came
// before, several at a time.
void RidgeDetector::collect_in_raster_order(int height, std::vector<RidgePoint>& points) {
  row_begin_.assign(height + 1, 0);
  for (int row = 0; row < height; ++row) {
    row_begin_[row + 1] = row_begin_[row];
    for (const Strip& strip : strips_) row_begin_[row + 1] += strip.of_row[row];
  }
  points.resize(static_cast<std::size_t>(row_begin_[height]));  // what it held is written over
  row_end_.assign(row_begin_.begin(), row_begin_.end());
  const auto follows = [](const RidgePoint& p, const RidgePoint& before) {
    return p.row == before.row && p.column > before.column;
  };
  for (const Strip& strip : strips_)
    for (auto run = strip.found.begin(), end = run; run != strip.found.end(); run = end) {
      end = run + 1;
      while (end != strip.found.end() && follows(*end, *(end - 1))) ++end;
      const auto row_begin = points.begin() + row_begin_[run->row];
      auto at = points.begin() + row_end_[run->row];
      row_end_[run->row] += static_cast<int>(end - run);
      if (at == row_begin || follows(*run, *(at - 1)))
        std::copy(run, end, at);
      else
        for (; run != end; ++run, ++at) {
          const auto place =
              std::upper_bound(row_begin, at, run->column,
                               [](int column, const RidgePoint& p) { return column < p.column; });
          std::move_backward(place, at, at + 1);
          *place = *run;
        }
    }
}

// Between two pixels a line is a little farther from each than it truly is. Of the pixels that
// claim it, the one it is nearest to keeps it: none keeps a point beyond its own border whose
// neighbour there has one.
void RidgeDetector::drop_twice_found(std::vector<RidgePoint>& points) {
  constexpr float kDropped = -1;  // curvature
  const auto beyond = [](float offset) {
    return offset > kOwnPixel ? 1 : offset < -kOwnPixel ? -1 : 0;
  };
  bool any = false;
  for (RidgePoint& point : points) {
    const int right = beyond(point.u - static_cast<float>(point.column)),
              below = beyond(point.v - static_cast<float>(point.row));
    if (right == 0 && below == 0) continue;
    const int row = point.row + below;
    if (row < 0 || row + 1 >= std::ssize(row_begin_)) continue;
    const auto end = points.begin() + row_begin_[row + 1];
    const auto neighbour =
        std::lower_bound(points.begin() + row_begin_[row], end, point.column + right,
                         [](const RidgePoint& p, int column) { return p.column < column; });
    if (neighbour == end || neighbour->column != point.column + right ||
        neighbour->curvature == kDropped)
      continue;
    point.curvature = kDropped;
    any = true;
  }
  if (any) std::erase_if(points, [](const RidgePoint& p) { return p.curvature == kDropped; });
}

}  // namespace arcstart::extraction
