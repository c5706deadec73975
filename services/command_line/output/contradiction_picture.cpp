#include "services/command_line/output/contradiction_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "services/command_line/clouds/cloud_picture.hpp"
#include "services/command_line/clouds/picture_text.hpp"
#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/referee/constants.hpp"
#include "services/seam_finding/referee/end_bounds.hpp"

namespace arcstart::command_line {

using namespace contradiction_colours;
using seam_finding::kReferee;
using seam_finding::Look;
using seam_finding::Place;
using seam_finding::PlateView;
using seam_finding::StripeOnPlate;

namespace {

constexpr int kWide = 1500, kHigh = 450;  // of a plate, at most; px
constexpr int kLeast = 1340;              // of the picture's width, for the words; px
constexpr int kMargin = 60, kLine = 22;   // px
constexpr int kTicks = 44;                // between the plates; px
constexpr int kDot = 2;                   // radius; px
constexpr double kBeyond = 20;            // along, of what is shown beyond an end, at least; mm
constexpr double kPast = 10;              // of what is shown past a bound and a plate's width; mm
constexpr int kTickApart = 60;            // px, at least

const cv::Scalar kPaper(35, 30, 30), kText(230, 230, 230);

double shown_beyond(const seam_finding::EndBounds& bounds) {
  double beyond = kBeyond;
  for (const double bound : {bounds.least, bounds.most})
    if (std::isfinite(bound)) beyond = std::max(beyond, bound + kPast);
  return std::min(beyond, kReferee.reach);
}

double shown_away(const PlateView& view) {
  return std::min(std::max(view.width, kBeyond) + kPast, kReferee.reach);
}

// Away from the seam, the part of a stripe's trace that lies on the claimed plate.
std::optional<std::pair<double, double>> within_claim(const StripeOnPlate& stripe,
                                                      const PlateView& view, double length) {
  double from = view.begin, to = view.width;
  if (std::abs(stripe.lean) > 1e-9) {
    const double at_start = -stripe.crossing / stripe.lean;
    const double at_end = (length - stripe.crossing) / stripe.lean;
    from = std::max(from, std::min(at_start, at_end));
    to = std::min(to, std::max(at_start, at_end));
  } else if (stripe.crossing < 0 || stripe.crossing > length) {
    return std::nullopt;
  }
  if (from >= to) return std::nullopt;
  return std::make_pair(from, to);
}

const cv::Scalar& colour_of(Look look) {
  return look == Look::kOn ? kOn : look == Look::kThrough ? kThrough : kBefore;
}

}  // namespace

ContradictionPicture::ContradictionPicture(const ExaminedSeam& seam) {
  lay_out(seam);
  for (int plate = 0; plate < 2; ++plate) draw_panel(plate, seam);
  draw_ticks();
  draw_words(seam);
}

cv::Point ContradictionPicture::pixel(int plate, double along, double away) const {
  const Panel& panel = panels_[plate];
  return {
      panel.frame.x + static_cast<int>(std::lround((along - from_) * px_per_mm_)),
      panel.frame.y + static_cast<int>(std::lround(panel.away0 - panel.up * away * px_per_mm_))};
}

void ContradictionPicture::write(const std::string& path) const {
  if (!cv::imwrite(path, image_)) throw PictureError(path + ": cannot be written as a picture");
}

void ContradictionPicture::lay_out(const ExaminedSeam& seam) {
  const auto& ends = seam.examination.ends;
  from_ = -shown_beyond(ends[0]);
  to_ = (seam.found.end - seam.found.start).norm() + shown_beyond(ends[1]);
  const std::array<double, 2> away = {shown_away(seam.examination.views[0]),
                                      shown_away(seam.examination.views[1])};
  px_per_mm_ =
      std::min(kWide / (to_ - from_), kHigh / (std::max(away[0], away[1]) + kReferee.near_seam));
  const auto px = [&](double mm) { return static_cast<int>(std::lround(mm * px_per_mm_)); };
  int top = kMargin + kLine * static_cast<int>(seam.objections.size());
  for (int plate = 0; plate < 2; ++plate) {
    Panel& panel = panels_[plate];
    panel.frame = {kMargin, top, px(to_ - from_), px(away[plate] + kReferee.near_seam)};
    panel.up = plate == 0 ? 1 : -1;
    panel.away0 = px_per_mm_ * (plate == 0 ? away[0] : kReferee.near_seam);
    top += panel.frame.height + kTicks;
  }
  image_.create(top, std::max(kLeast, panels_[0].frame.width + 2 * kMargin), CV_8UC3);
  image_.setTo(kPaper);
}

void ContradictionPicture::draw_panel(int plate, const ExaminedSeam& seam) {
  const PlateView& view = seam.examination.views[plate];
  const double length = (seam.found.end - seam.found.start).norm();
  draw_bounds(plate, view, length, seam.examination.spacing);
  const cv::Rect& frame = panels_[plate].frame;
  cv::Mat inside = image_(frame);  // nothing is drawn out of it
  const auto at = [&](double along, double away) { return pixel(plate, along, away) - frame.tl(); };
  const double farthest = shown_away(view);
  for (const StripeOnPlate& stripe : view.stripes) {
    const auto trace = within_claim(stripe, view, length);
    if (!trace) continue;
    const auto [from, to] = *trace;
    cv::line(inside, at(stripe.crossing + stripe.lean * from, from),
             at(stripe.crossing + stripe.lean * to, to), kPredicted, 1, cv::LINE_AA);
  }
  for (const StripeOnPlate& stripe : view.stripes)
    for (const Place& place : stripe.places)
      if (place.away < farthest)
        cv::circle(inside, at(place.along, place.away), kDot, colour_of(place.look), cv::FILLED);
  cv::line(inside, at(from_, 0), at(to_, 0), kText, 1);
  for (const double end : {0.0, length})
    cv::line(inside, at(end, -kReferee.near_seam), at(end, farthest), kClaim, 1);
  cv::rectangle(image_, frame, kBefore);
}

void ContradictionPicture::draw_bounds(int plate, const PlateView& view, double length,
                                       double spacing) {
  using seam_finding::SeamSide;
  const cv::Rect& frame = panels_[plate].frame;
  for (const SeamSide side : {SeamSide::kBegin, SeamSide::kEnd}) {
    const double end = side == SeamSide::kBegin ? 0 : length, outward = static_cast<double>(side);
    const auto bounds = seam_finding::bounds_of(view, side, end, spacing);
    if (!bounds.anchored) continue;
    double left = std::clamp(end + outward * bounds.least, from_, to_);
    double right = std::clamp(end + outward * bounds.most, from_, to_);
    if (left > right) std::swap(left, right);
    const int x = pixel(plate, left, 0).x, behind = pixel(plate, right, 0).x;
    cv::rectangle(image_, cv::Rect(x, frame.y, std::max(1, behind - x), frame.height) & frame,
                  kBounds, cv::FILLED);
  }
}

void ContradictionPicture::draw_ticks() {
  double step = 5;
  for (const double next : {10.0, 20.0, 50.0, 100.0, 200.0})
    if (step * px_per_mm_ < kTickApart) step = next;
  const int top = panels_[0].frame.br().y, bottom = panels_[1].frame.y;
  for (double along = std::ceil(from_ / step) * step; along <= to_; along += step) {
    const int x = pixel(0, along, 0).x;
    cv::line(image_, {x, top}, {x, top + 6}, kText);
    cv::line(image_, {x, bottom}, {x, bottom - 6}, kText);
    write_text(image_, fmt::format("{:g}", along), {x - 8, (top + bottom) / 2 + 5}, kText);
  }
  write_text(image_, "mm", {panels_[0].frame.br().x + 24, (top + bottom) / 2 + 5}, kText);
  for (int plate = 0; plate < 2; ++plate)
    for (double away = 0; panels_[plate].frame.contains(pixel(plate, from_, away)); away += step) {
      const cv::Point at = pixel(plate, from_, away);
      cv::line(image_, at, at - cv::Point(6, 0), kText);
      write_text(image_, fmt::format("{:g}", away), {at.x - 40, at.y + 5}, kText);
    }
}

void ContradictionPicture::draw_words(const ExaminedSeam& seam) {
  const cv::Rect &first = panels_[0].frame, &second = panels_[1].frame;
  write_text(image_, "first plate", {first.x, first.y - 6}, kText);
  write_text(image_, "second plate", {second.x, second.br().y + 18}, kText);
  int y = kLine;
  for (const auto& objection : seam.objections) {
    write_text(image_, seam.found.joint_type + ": " + in_words(objection), {kMargin, y}, kText);
    y += kLine;
  }
  int x = kMargin;
  const auto entry = [&](const std::string& text, const cv::Scalar& colour) {
    cv::circle(image_, {x, y - 4}, 5, colour, cv::FILLED, cv::LINE_AA);
    write_text(image_, text, {x + 12, y}, kText);
    x += 12 + 9 * static_cast<int>(text.size()) + 20;
  };
  entry("predicted", kPredicted);
  entry("seen on the plate", kOn);
  entry("seen through it", kThrough);
  entry("seen before it", kBefore);
  entry("claimed start and end", kClaim);
  entry("where its end meets the seam, by the stripes", kBounds);
}

}  // namespace arcstart::command_line
