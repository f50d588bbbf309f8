#include "techniques/film_buffer.h"

#include "kernels/shared/layout.h"

namespace antipode {
namespace {

/// No device asks for offsets of bindings that are multiples of more than 256 bytes.
constexpr uint64_t offsetWords = 64;

uint64_t roundedUp(uint64_t words) { return (words + offsetWords - 1) / offsetWords * offsetWords; }

}  // namespace

FilmBuffer::FilmBuffer(Device& device, const FilmLayout& layout)
    : classValues_(layout.offset(1)),
      classes_(layout.residueClasses()),
      otherValues_(layout.values() - classes_ * classValues_),
      classStride_(classes_ == 1 ? classValues_ : roundedUp(classValues_)),
      image_(words(device, classes_ * classStride_)) {
    if (otherValues_ > 0) others_.emplace(words(device, otherValues_));
    clear();
}

FilmBuffer::Words FilmBuffer::words(Device& device, uint64_t count) const {
    return {Buffer(device, 4 * count, Residency::DeviceOnly), Buffer(device, 4 * count, Residency::DeviceOnly)};
}

void FilmBuffer::bind(BindingTable& table, uint32_t residueClass) const {
    table.set(shared::BIND_FILM_LOW, image_.low, 4 * residueClass * classStride_, 4 * classValues_);
    table.set(shared::BIND_FILM_HIGH, image_.high, 4 * residueClass * classStride_, 4 * classValues_);
    // What no kernel touches has to be bound all the same.
    const Words& others = others_ ? *others_ : image_;
    const uint64_t values = others_ ? otherValues_ : classValues_;
    table.set(shared::BIND_LAYERS_LOW, others.low, 0, 4 * values);
    table.set(shared::BIND_LAYERS_HIGH, others.high, 0, 4 * values);
}

void FilmBuffer::clear() {
    image_.low.fill(0);
    image_.high.fill(0);
    if (!others_) return;
    others_->low.fill(0);
    others_->high.fill(0);
}

std::vector<int64_t> FilmBuffer::download() const {
    std::vector<int64_t> sums;
    sums.reserve(classes_ * classValues_ + otherValues_);
    std::vector<uint32_t> low, high;
    const auto append = [&](const Words& words, uint64_t first, uint64_t count) {
        low.resize(count), high.resize(count);
        words.low.download(low.data(), 4 * count, 4 * first);
        words.high.download(high.data(), 4 * count, 4 * first);
        for (size_t i = 0; i < count; ++i) sums.push_back(int64_t(uint64_t(high[i]) << 32 | low[i]));
    };
    for (uint64_t k = 0; k < classes_; ++k) append(image_, k * classStride_, classValues_);
    if (others_) append(*others_, 0, otherValues_);
    return sums;
}

}  // namespace antipode
