// Device memory for an iteration's light vertices and for the grid over them.
#pragma once

#include "techniques/job.h"
#include "vulkan/bindings.h"

namespace antipode {

class VertexBuffers {
public:
    /// `merging`: also what the sort and the grid need.
    VertexBuffers(Device& device, uint32_t capacity, uint32_t batchSize, bool merging);

    void bind(BindingTable& table) const;
    uint32_t capacity() const { return capacity_; }
    uint32_t bucketCount() const { return bucketCount_; }
    /// Radix passes that a bucket number takes.
    uint32_t sortPasses() const;
    const Buffer& cells() const { return cells_; }

    /// The most vertices that one device can bind.
    static uint64_t greatestCapacity(const Device& device);

private:
    uint32_t capacity_, bucketCount_;
    bool merging_;
    Buffer positions_, data_, sortedPositions_, sortedData_, keys_, cells_, scan_;
};

}  // namespace antipode
