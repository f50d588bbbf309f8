// How bright a picture is shown.
#pragma once

#include "renderengine/film.h"

namespace antipode {

/// The image × 2^stops.
Image exposed(Image image, double stops);

/// The exposure at which an image can be looked at, in tenths of a stop, from its relative luminances: the median of
/// those that are not black, m, and the 98th percentile, p. 0 where m lies in [.02, .9] and p in [.3, 4], so that what
/// is made to be seen as it is stays as it is; else the mean of what brings m to .2 and p to 1: dark rooms with a lamp
/// in sight are lifted less than dark rooms. 0 for black images. Pixels that are not finite do not count.
double autoExposure(const Image& image);

}  // namespace antipode
