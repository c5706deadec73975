// What a centre is worth: noise of the image, width of the stripe, standard deviation of the
// centre.
#pragma once

#include <span>
#include <vector>

#include "services/extraction/image/frame_arena.hpp"
#include "services/extraction/image/grey_image.hpp"
#include "services/extraction/ridge/ridge.hpp"

namespace arcstart::extraction {

// Standard deviation of the grey values where the image is flat: the median over patches spread
// over the image of what a mask that sees neither slope nor curvature gives (Immerkaer 1996); at
// least that of rounding, 0.29. 0 for an image below 18 x 18.
double noise_of(const GreyImage& image);

// Standard deviation of the stripe's profile across each point of a chain, px, into widths[point];
// 0 where none stands out from its surroundings by twice the noise. From its width at half its
// height above the line that joins the grey values on both sides: a halo does not count; a top
// clipped at white is allowed for. The profile is the mean over the neighbours along the chain, so
// that speckle does not cut it in two. sigma: of the kernels, sets how far away the sides are.
void measure_widths(const GreyImage& image, const std::vector<RidgePoint>& points,
                    std::span<const int> chain, double sigma, double noise,
                    std::vector<float>& widths, Memory memory = heap());

// White-noise law of the centre: 0.1995 noise (w^2 + s^2)^(3/2) / (A w s^2), where A w / (w^2 +
// s^2)^(3/2) is the curvature.
double centre_deviation(double curvature, double sigma, double noise);

bool is_saturated(const GreyImage& image, double u, double v);  // the nearest pixel is at 255

// Width of a stripe along the image that would hold all its white pixels; px.
double white_width(const GreyImage& image);

}  // namespace arcstart::extraction
