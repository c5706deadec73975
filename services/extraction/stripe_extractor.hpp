// The stripe in an image: ridge points, chains, selection, quality; and the scale at which to look
// for it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/extraction/centres/centre_noise.hpp"
#include "services/extraction/centres/stripe_centre.hpp"
#include "services/extraction/centres/stripe_smoother.hpp"
#include "services/extraction/empty_stripe.hpp"
#include "services/extraction/extraction_settings.hpp"
#include "services/extraction/image/grey_image.hpp"
#include "services/extraction/lines/course_evidence.hpp"
#include "services/extraction/lines/linking.hpp"
#include "services/extraction/lines/scale_merge.hpp"
#include "services/extraction/lines/stripe_path.hpp"
#include "services/extraction/ridge/ridge.hpp"

namespace arcstart::extraction {

struct Stripe {
  std::vector<StripeCentre> centres;     // segment by segment, in order along each
  float sigma = 0;                       // of the kernels used; px
  float noise = 0;                       // standard deviation where nothing is lit; grey values
  float saturated_share = 0;             // of the chosen centres, on pixels at 255
  EmptyStripe why = EmptyStripe::kNone;  // there are no centres
  std::string empty;                     // the same in words
};

// Times the usual least strength, the next where the image is full of lines with the one before.
constexpr double kRaised[] = {1, 2, 4, 8};
// A course so many times as strong as the other lines in the image is no line of its texture.
constexpr double kStandsOut = 1.7;

constexpr double kLeastSigma = 1.2, kLargestSigma = 12;  // px, followed
constexpr double kBesideCourse = 10;  // px within which a line is the course's own at another scale

class StripeExtractor {
 public:
  explicit StripeExtractor(const ExtractionSettings& settings)
      : settings_(settings), detector_(settings.threads) {}
  StripeExtractor(const StripeExtractor&) = delete;
  StripeExtractor& operator=(const StripeExtractor&) = delete;

  Stripe extract(const GreyImage& image) {
    Stripe stripe;
    extract(image, stripe);
    return stripe;
  }
  void extract(const GreyImage& image, Stripe& stripe);  // takes no memory that it has already

  // Forgets the scale: the next image is looked at as if it were the first.
  void restart() { sigma_ = 0, since_refused_ = 0; }

  double active_share() const { return detector_.active_share(); }  // of the last image's blocks

 private:
  void find_lines(const GreyImage& image, double sigma);
  void choose_course(const GreyImage& image);  // among those lines
  // Both. False where the image is full of lines: not all of them were followed.
  bool look_at(const GreyImage& image, double sigma);
  // stripe_extractor_scale.cpp
  void find_scale(const GreyImage& image);
  void find_scale_in_texture(const GreyImage& image);
  bool correct_scale(const GreyImage& image, int corrected);
  bool in_texture() const;
  double chosen_strength() const;
  CourseEvidence evidence();
  void drop_texture();
  bool outdoes_the_rest(const GreyImage& image);  // leaves no course
  void refuse();

  // stripe_extractor_mixed.cpp
  void look_at_all_scales(const GreyImage& image);
  void try_all_scales(const GreyImage& image);
  // Strength of the middle one of the lines beside the course at each scale; a point's scale's.
  std::array<double, 4> others_of_scales();
  double others_of(const std::array<double, 4>& others, int point) const;
  bool widths_differ();  // along the course, by more than one sigma does for
  void measure_by_width(const GreyImage& image);

  void follow(const GreyImage& image);
  void follow_scale();
  double wanted_sigma();                        // from the widths seen; px, 0 where too few
  double strong_curvature(double sigma) const;  // of what starts a segment; grey values / px^2
  void measure(const GreyImage& image);
  void measure_at(const GreyImage& image, double sigma);
  double sigma_of(int point) const;  // of the kernels that found it; px
  int border() const;                // px, in which nothing is looked for
  void set_out(const GreyImage& image, const Branch& branch);
  void describe(const GreyImage& image, Stripe& stripe);

  ExtractionSettings settings_;
  double sigma_ = 0;  // followed; 0: not known yet
  // What starts a segment has this strength at least where the surface's texture is full of lines;
  // found with the scale, 0 elsewhere.
  double least_strength_ = 0;
  int since_refused_ = 0;                   // images since a search in texture that found no stripe
  bool mixed_ = false;                      // the stripe is looked for at several scales at once
  std::array<double, 4> least_of_scale_{};  // least_strength_ at each of them
  std::optional<bool> along_rows_;          // likewise: the texture has a direction of its own

  // Of the image looked at last. The memory is given up last: chains and branches lie in it.
  FrameArena memory_;
  double noise_ = 0;
  double used_sigma_ = 0;
  int lines_ = 0;         // columns or rows, whichever are more
  bool refused_ = false;  // for its texture, in which nothing is the stripe alone
  bool crowded_ = false;  // by more ridge points than a stripe can be told from
  RidgeDetector detector_;
  Linker linker_;
  Selector selector_;
  GaussianKernels kernels_;
  std::vector<RidgePoint> points_;
  ScaledLines merged_;  // its sigmas are those of points_, where mixed_
  std::vector<Chain> chains_;
  std::vector<MeasuredCentre> centres_, finer_;  // of each point
  std::vector<float> end_deviations_;  // of the last points, which follow_blunt_ends has added; px
  CentreNoise scatter_;
  GaussianKernels measuring_kernels_;
  std::vector<RidgePoint> about_, measured_;
  std::vector<float> no_widths_;
  std::vector<float> wanted_sigmas_, sigmas_;  // measure_by_width: of each point, and each once
  std::vector<float> widths_;                  // of each point; px, 0 where not measured
  StripePath selection_;
  StripeSmoother course_;
  std::vector<SmoothedPoint> course_points_;  // of a branch
};

}  // namespace arcstart::extraction
