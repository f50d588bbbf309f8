// The film on the device: the int64 sums of all layers, as low and high words in two buffers.
#pragma once

#include <cstdint>
#include <vector>

#include "renderengine/film_layout.h"
#include "vulkan/bindings.h"

namespace antipode {

class FilmBuffer {
public:
    FilmBuffer(Device& device, const FilmLayout& layout);

    void bind(BindingTable& table) const;
    void clear();
    /// The sums, in the layout's order.
    std::vector<int64_t> download() const;

private:
    Buffer low_, high_;
};

}  // namespace antipode
