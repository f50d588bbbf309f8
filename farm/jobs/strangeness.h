// What honest results rarely look like, and those of broken devices often do.
#pragma once

#include <string>

#include "renderengine/film.h"

namespace antipode {

/// Whether the image holds no light at all. True of empty sums. Ends at the first sum that is not 0.
bool isBlack(const FilmSums& sums);

/// What is strange about the image of a block beside the rest of `all`, the sums that it has been added to: "is below
/// 0", "is more than four times as bright as the rest". Empty where nothing is. It proves nothing (a caustic may come
/// in one iteration of a hundred): it is a reason to have the block rendered again.
std::string strangeness(const FilmSums& block, const FilmSums& all);

}  // namespace antipode
