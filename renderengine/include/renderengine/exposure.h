// How bright a picture is shown.
#pragma once

#include "renderengine/film.h"

namespace antipode {

/// The image × 2^stops.
Image exposed(Image image, double stops);

/// What whiteBalanced() leaves as it is: the white of Rec. 709.
inline constexpr double daylightKelvin = 6504;

/// The image as an eye sees it that takes a light of this colour temperature, 1667 to 25,000 K, for white: by scaling
/// cone responses (von Kries, in Bradford's space). Saturated colours may become negative, which the tone curve shows
/// as 0.
Image whiteBalanced(Image image, double kelvin);

/// The exposure at which an image can be looked at, in tenths of a stop, from its relative luminances: the median of
/// those that are not black, m, and the 98th percentile, p. 0 where m lies in [.02, .9] and p in [.3, 4], so that what
/// is made to be seen as it is stays as it is; else the mean of what brings m to .2 and p to 1: dark rooms with a lamp
/// in sight are lifted less than dark rooms. 0 for black images. Pixels that are not finite do not count.
double autoExposure(const Image& image);

}  // namespace antipode
