// What takes a pixel's squared error to its part of relMSE, for want of a reference.
#pragma once

#include <vector>

#include "film/class_contrasts.h"

namespace antipode {

/// Of every value of the image, by 3·pixel + channel, or of every pixel.
struct RelativeWeights {
    std::vector<float> values;       ///< 1/(reference² + ε)
    std::vector<float> unconfirmed;  ///< the same, where only what other classes have met counts as light; no smaller
    /// What takes the square of a luminance's error there, from all classes, where it has the pixel's colour.
    std::vector<float> luminances;
};

/// A value's weight is the mean over all differences a − b between its classes, weighted by their squares, of
/// 1/(reference² + ε), where the reference is that of the other classes: a bright outlier in a or b does not excuse
/// itself. Of two classes it is that of both.
///
/// Those other classes are noisy, too, and where light is seldom met they are often dark, which would make 1/reference²
/// too large by orders of magnitude. So three kinds of evidence are added:
///
/// - Neighbours. The classes are smoothed (film/class_smoother.h). How large the noise is all classes tell; so where
///   one class alone has met light its neighbours decide.
/// - Confirmation. Some brightness is met again by other classes wherever it is met (the edge of a lamp), some never
///   (a firefly). Over all values of the image as bright as a or b, the share that the other classes have of it is
///   measured, and of what that lets expect the reference has a part at least.
/// - What variance is left to the reference is taken out of the quotient to the second order, in part, since seldom
///   and bright samples have less of it than that order has.
RelativeWeights relativeWeights(const FilmLayout& layout, const ClassContrasts& contrasts);

}  // namespace antipode
