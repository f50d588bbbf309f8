#include "techniques/film_buffer.h"

#include "kernels/shared/layout.h"

namespace antipode {

FilmBuffer::FilmBuffer(Device& device, const FilmLayout& layout)
    : low_(device, 4 * layout.values(), Residency::DeviceOnly),
      high_(device, 4 * layout.values(), Residency::DeviceOnly) {
    clear();
}

void FilmBuffer::bind(BindingTable& table) const {
    table.set(shared::BIND_FILM_LOW, low_);
    table.set(shared::BIND_FILM_HIGH, high_);
}

void FilmBuffer::clear() {
    low_.fill(0);
    high_.fill(0);
}

std::vector<int64_t> FilmBuffer::download() const {
    const size_t words = low_.bytes() / 4;
    std::vector<uint32_t> low(words), high(words);
    low_.download(low.data(), low_.bytes());
    high_.download(high.data(), high_.bytes());
    std::vector<int64_t> sums(words);
    for (size_t i = 0; i < words; ++i) sums[i] = int64_t(uint64_t(high[i]) << 32 | low[i]);
    return sums;
}

}  // namespace antipode
