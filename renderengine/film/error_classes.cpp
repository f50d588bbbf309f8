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

FilmLayout withErrorClasses(const FilmLayout& layout) {
    FilmLayout classes = layout;
    classes.layers.insert(classes.layers.begin(), errorClasses - 1, layout.layers.at(0));
    return classes;
}

bool hasErrorClasses(const FilmLayout& layout) {
    return layout.residueClasses() > 1 && layout.layers.front().name.empty();
}

FilmSums inErrorClasses(FilmSums part, uint64_t first) {
    if (part.layout.residueClasses() != 1)
        throw Error(ErrorCode::Usage, "A film whose image comes in classes cannot be parted into others.");
    const uint32_t own = errorClass(first);
    part.residueIterations.assign(errorClasses, 0);
    part.residueIterations[own] = part.iterations;
    const uint64_t image = part.layout.offset(1);
    part.layout = withErrorClasses(part.layout);
    part.values.insert(part.values.begin(), own * image, 0);
    part.values.insert(part.values.begin() + ptrdiff_t((own + 1) * image), (errorClasses - 1 - own) * image, 0);
    return part;
}

FilmSums outOfErrorClasses(FilmSums whole) {
    const FilmSums image = whole.imageAlone();
    const auto others = whole.values.begin() + ptrdiff_t(whole.layout.offset(errorClasses));
    whole.values.erase(std::copy(image.values.begin(), image.values.end(), whole.values.begin()), others);
    whole.layout.layers.erase(whole.layout.layers.begin(), whole.layout.layers.begin() + (errorClasses - 1));
    whole.residueIterations.clear();
    return whole;
}

}  // namespace antipode
