// What takes a pixel's squared error to its part of relMSE, for want of a reference.
#pragma once

#include <vector>

#include "film/class_contrasts.h"

namespace antipode {

/// Of every value of the image, by 3·pixel + channel.
struct RelativeWeights {
    std::vector<float> values;       ///< 1/(reference² + ε)
    std::vector<float> unconfirmed;  ///< the same, where only what other classes have met counts as light; no smaller
};

/// A value's weight is the mean over all differences a − b between its classes, weighted by their squares, of
/// 1/(reference² + ε), where the reference is that of the other classes: a bright outlier in a or b does not excuse
/// itself. Of two classes it is that of both.
///
/// Those other classes are noisy, too, and where light is seldom met they are often dark, which would make 1/reference²
/// too large by orders of magnitude. So three kinds of evidence are added:
///
/// - Neighbours. The classes are smoothed by shrinking differences between means over windows of 17², 9², 5², 3² and 1
///   pixels, from the mean of the image on: each by the positive part of James and Stein's factor, 1 − λ·noise²/size²,
///   over the three channels together (Efron & Morris 1973; as wavelets are shrunk: Donoho & Johnstone 1995). How
///   large the noise is all classes tell; so where one class alone has met light its neighbours decide.
/// - Confirmation. Some brightness is met again by other classes wherever it is met (the edge of a lamp), some never
///   (a firefly). Over all values of the image as bright as a or b, the share that the other classes have of it is
///   measured, and of what that lets expect the reference has a part at least.
/// - What variance is left to the reference is taken out of the quotient to the second order, in part, since seldom
///   and bright samples have less of it than that order has.
RelativeWeights relativeWeights(const FilmLayout& layout, const ClassContrasts& contrasts);

}  // namespace antipode
