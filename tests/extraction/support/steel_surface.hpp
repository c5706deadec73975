// Reflectance of real surfaces, for images that are to mislead an extraction as steel does. From
// noise and closed forms: nothing of the extraction is used.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace arcstart::extraction {

enum class SteelSurface {
  kGround,
  kMilled,
  kBrushed,
  kShotBlasted,
  kScale,
  kRust,
  kPrimer,
  kOil,
  kGalvanised
};
constexpr SteelSurface kAllSteelSurfaces[] = {
    SteelSurface::kGround,      SteelSurface::kMilled, SteelSurface::kBrushed,
    SteelSurface::kShotBlasted, SteelSurface::kScale,  SteelSurface::kRust,
    SteelSurface::kPrimer,      SteelSurface::kOil,    SteelSurface::kGalvanised};
const char* name_of(SteelSurface surface);

// What a lamp and the laser find on a surface, float, of the image's size.
struct SurfaceLight {
  cv::Mat reflectance;  // of all light, of mean 1
  cv::Mat glints;       // what mirrors the lamp besides, but not the laser; of the lamp's light
};

// angle: of the lay (the direction that grinding, milling or brushing left); radians.
//
// Contrast and grain: on photographs of plates (a butt joint's two plates, the surroundings of two
// calibration sets' stripes; 200 px patches less their mean over 20 px) the deviation is 0.06 to
// 0.27 of the mean, the correlation falls to a half over 2 to 12 px, more along the lay than
// across, and the brightest thousandth stands 3 to 13 deviations above the mean. Each kind takes
// its place in those ranges; which kind has which is our own definition.
SurfaceLight render_surface(SteelSurface surface, cv::Size size, double angle, std::uint64_t seed);

// A chessboard printed on it: fields of this many px, turned by angle, dark ones of this
// reflectance.
cv::Mat render_print(cv::Size size, double field, double angle, double dark);

}  // namespace arcstart::extraction
