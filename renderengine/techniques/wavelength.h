// The wavelength that all paths of an iteration have, where glass disperses light.
#pragma once

#include <cstdint>

#include "renderengine/vec.h"

namespace antipode {

struct Wavelength {
    double nanometres = 0;
    /// What red, green and blue see of it, over the density that it is drawn with: at least 0, of mean 1 each over all
    /// wavelengths, and in sum 3 at each of them.
    Vec3d response;
    /// How far an index that follows Cauchy's A + B/λ² is from n_d, in units of n_F − n_C: 0 at 587.6 nm, and from F
    /// (486.1 nm) to C (656.3 nm) a difference of 1.
    double dispersion = 0;
};

/// That of an iteration, counted from 1: a pure function of both. Over the seeds each is drawn from one density; over
/// the iterations of a seed they are stratified: of any 2^m that begin at a multiple of 2^m, counted from 0, and of
/// those every 2^k-th, 2^m in number, just one has its number in each 2^m-th of [0,1).
Wavelength wavelengthOf(uint64_t seed, uint64_t iteration);

/// The number in [0,1) whose inverse cumulative density the wavelength is.
double wavelengthNumber(uint64_t seed, uint64_t iteration);

/// The wavelength of a number in [0,1).
Wavelength wavelengthAt(double number);

}  // namespace antipode
