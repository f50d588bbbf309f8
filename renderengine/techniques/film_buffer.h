// The film on the device: the int64 sums of all layers, as low and high words in two buffers.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderengine/film_layout.h"
#include "vulkan/bindings.h"

namespace antipode {

class FilmBuffer {
public:
    FilmBuffer(Device& device, const FilmLayout& layout);

    /// Binds the image's sums of one residue class, and all other layers'.
    void bind(BindingTable& table, uint32_t residueClass = 0) const;
    void clear();
    /// The sums, in the layout's order.
    std::vector<int64_t> download() const;

private:
    struct Words {
        Buffer low, high;
    };
    Words words(Device& device, uint64_t count) const;

    const uint64_t classValues_, classes_, otherValues_;
    const uint64_t classStride_;  ///< words between residue classes: each can be bound by itself
    Words image_;
    std::optional<Words> others_;
};

}  // namespace antipode
