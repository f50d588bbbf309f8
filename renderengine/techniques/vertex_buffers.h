// Device memory for an iteration's light vertices and for the grid over them.
#pragma once

#include "techniques/job.h"
#include "vulkan/bindings.h"

namespace antipode {

class VertexBuffers {
public:
    /// `buckets` of the hash grid, a power of two of at least 64; 0 without merging, which needs no grid and no sort.
    VertexBuffers(Device& device, uint32_t capacity, uint32_t batchSize, uint32_t buckets, Precision precision);

    void bind(BindingTable& table) const;
    uint32_t capacity() const { return capacity_; }
    uint32_t bucketCount() const { return bucketCount_; }
    /// Radix passes that a bucket number takes.
    uint32_t sortPasses() const;
    const Buffer& cells() const { return cells_; }

    /// The most vertices that one device can bind.
    static uint64_t greatestCapacity(const Device& device, Precision precision);

private:
    uint32_t capacity_, bucketCount_;
    Buffer positions_, data_, sortedPositions_, sortedData_, keys_, cells_, scan_;
};

}  // namespace antipode
