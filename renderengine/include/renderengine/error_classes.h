// The classes of iterations that a job's error is estimated from, where the client sums them up itself: nothing of them
// crosses the wire and no device knows of them.
//
// A block of iterations comes as one film, so that all of it must be of one class; and which, its iterations alone must
// decide, or two farms would tell two errors. So iterations are parted into runs, aligned and a power of two long: four
// to each octave [2^m, 2^(m+1)), single iterations below 8. Runs take the classes in turns, upwards and downwards in
// every other octave, so that classes have like numbers of iterations and like radii. A lease stays within a run.
#pragma once

#include <cstdint>

#include "renderengine/film.h"
#include "renderengine/iteration_range.h"

namespace antipode {

inline constexpr uint32_t errorClasses = 4;

/// The run that iteration `index` (from 0) is in.
IterationRange errorRun(uint64_t index);
/// In which of the classes the run is.
uint32_t errorClass(uint64_t index);
/// How many iterations before `index` are of its class. A run begins at a multiple of its length.
uint64_t errorClassIndex(uint64_t index);

/// The film of a job with its image in classes, which bear no names: files do not show them. So is its blur, where it
/// has that.
FilmLayout withErrorClasses(const FilmLayout& layout);
/// The reverse.
FilmLayout withoutErrorClasses(const FilmLayout& layout);
/// Whether a film is in such classes.
bool hasErrorClasses(const FilmLayout& layout);
/// `part`, whose image is in one layer and whose iterations are all of the run of `first`, as a film in classes.
/// Throws Error(Usage) where its image comes in several layers already.
FilmSums inErrorClasses(const FilmSums& part, uint64_t first);
/// The reverse of any number of them, merged. Throws Error(Device) where a sum does not fit.
FilmSums outOfErrorClasses(const FilmSums& whole);

}  // namespace antipode
