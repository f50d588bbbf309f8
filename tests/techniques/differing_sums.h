// How far two films are from holding the same bytes.
#pragma once

#include <limits>

#include "renderengine/film.h"

namespace antipode::test {

/// How many of the films' sums differ; infinite where the films themselves are of different kinds.
inline double differingSums(const FilmSums& a, const FilmSums& b) {
    if (a.values.size() != b.values.size() || a.layout != b.layout || a.iterations != b.iterations)
        return std::numeric_limits<double>::infinity();
    double count = 0;
    for (size_t i = 0; i < a.values.size(); ++i) count += a.values[i] != b.values[i];
    return count;
}

}  // namespace antipode::test
