// What takes a pixel's squared error to its part of relMSE, for want of a reference.
#pragma once

#include <span>

#include "film/class_contrasts.h"

namespace antipode {

inline constexpr uint32_t relativeCellSide = 4;
inline constexpr uint32_t relativeCellPixels = relativeCellSide * relativeCellSide;

/// 1/(reference² + ε) of each pixel of a cell of neighbours, at most relativeCellPixels of them, in one channel; `cell`
/// holds the means of their classes, and so many `weights` are written.
///
/// A pixel's weight is the mean over all differences a − b between its classes, weighted by their squares, of
/// 1/(reference² + ε), where the reference is that of the other classes: a bright outlier in a or b does not excuse
/// itself. Of two classes it is that of both.
///
/// Those other classes are noisy, too. Where their noise explains how the cell's references differ they are drawn
/// towards the cell's mean, in full where it explains two thirds of it or more: the positive part of James and Stein's
/// estimator, a little stronger (Efron & Morris 1973). What variance is left is taken out of the quotient to the
/// second order; without drawing, that order would not do where a pixel is a fifth off and more. Three classes leave
/// one, of unknown variance: it is taken as it is.
void relativeWeights(const ClassContrasts& contrasts, std::span<const ClassContrasts::Means> cell,
                     std::span<double> weights);

}  // namespace antipode
