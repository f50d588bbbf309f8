#include "renderengine/error_classes.h"

#include <algorithm>
#include <bit>

#include "renderengine/error.h"

namespace antipode {

IterationRange errorRun(uint64_t index) {
    const uint64_t length = index < 2 * errorClasses ? 1 : std::bit_floor(index) / errorClasses;
    return {index / length * length, length};
}

uint32_t errorClass(uint64_t index) {
    if (index < errorClasses) return uint32_t(index);
    const uint32_t run = uint32_t((index - std::bit_floor(index)) / errorRun(index).count);
    return std::countr_zero(std::bit_floor(index)) % 2 == 0 ? errorClasses - 1 - run : run;
}

uint64_t errorClassIndex(uint64_t index) {
    if (index < errorClasses) return 0;
    const IterationRange run = errorRun(index);
    return std::bit_floor(index) / errorClasses + index - run.first;
}

FilmLayout withErrorClasses(const FilmLayout& layout) { return inClasses(layout, errorClasses); }

FilmLayout withoutErrorClasses(const FilmLayout& layout) {
    FilmLayout single{layout.width, layout.height, {}};
    for (const FilmLayer& layer : layout.layers)
        if (single.count(layer.kind) == 0) single.layers.push_back(layer);
    return single;
}

bool hasErrorClasses(const FilmLayout& layout) {
    return layout.residueClasses() > 1 && layout.layers.front().name.empty();
}

FilmSums inErrorClasses(const FilmSums& part, uint64_t first) {
    if (part.layout.residueClasses() != 1)
        throw Error(ErrorCode::Usage, "A film whose image comes in classes cannot be parted into others.");
    FilmSums whole;
    whole.layout = withErrorClasses(part.layout);
    whole.values.resize(whole.layout.values());
    whole.residueIterations.assign(errorClasses, 0);
    whole.merge(part, errorClass(first));
    return whole;
}

FilmSums outOfErrorClasses(const FilmSums& whole) {
    FilmSums single{withoutErrorClasses(whole.layout), whole.iterations, {}, whole.events};
    single.values.reserve(single.layout.values());
    for (const FilmLayer& layer : single.layout.layers) {
        const std::vector<int64_t> sums = whole.summed(layer.kind);
        single.values.insert(single.values.end(), sums.begin(), sums.end());
    }
    return single;
}

}  // namespace antipode
