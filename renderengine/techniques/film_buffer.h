// The film on the device: int64 sums per channel, as low and high words in two buffers.
#pragma once

#include <cstdint>
#include <vector>

#include "vulkan/bindings.h"

namespace antipode {

class FilmBuffer {
public:
    FilmBuffer(Device& device, uint32_t pixels);

    void bind(BindingTable& table) const;
    void clear();
    /// The sums, row-major, channels interleaved.
    std::vector<int64_t> download() const;

private:
    Buffer low_, high_;
};

}  // namespace antipode
