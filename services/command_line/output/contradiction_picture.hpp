// A seam that its scan's stripes contradict, as a picture: what each of them must show of the two
// plates, and what it shows.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>

#include "services/command_line/output/examined_seam.hpp"

namespace arcstart::command_line {

// In BGR.
namespace contradiction_colours {
inline const cv::Scalar kOn(90, 210, 90), kThrough(60, 60, 255), kBefore(150, 150, 150);
inline const cv::Scalar kPredicted(220, 140, 60);  // where a stripe must show a plate
inline const cv::Scalar kClaim(255, 255, 255);     // start and end as they were found
inline const cv::Scalar kBounds(30, 80, 95);       // where the stripes leave an end of a plate
}  // namespace contradiction_colours

// Each plate laid flat, the first above the seam and the second below, both to one scale. Along the
// seam counts from the claimed start to the right.
class ContradictionPicture {
 public:
  // Of a seam that was found, in a cloud with stripes.
  explicit ContradictionPicture(const ExaminedSeam& seam);

  const cv::Mat& image() const { return image_; }  // 8-bit BGR
  // Of a place on a plate, by mm along the seam from the claimed start and mm away from it.
  cv::Point pixel(int plate, double along, double away) const;

  // Throws PictureError where it cannot be written.
  void write(const std::string& path) const;

 private:
  struct Panel {
    cv::Rect frame;    // in the picture
    int up = 1;        // 1: away is up, -1: down
    double away0 = 0;  // px from the frame's top to the seam
  };
  void lay_out(const ExaminedSeam& seam);
  void draw_panel(int plate, const ExaminedSeam& seam);
  void draw_bounds(int plate, const seam_finding::PlateView& view, double length, double spacing);
  void draw_ticks();
  void draw_words(const ExaminedSeam& seam);

  cv::Mat image_;
  std::array<Panel, 2> panels_;
  double from_ = 0, to_ = 0;  // along, what is shown; mm
  double px_per_mm_ = 1;
};

}  // namespace arcstart::command_line
