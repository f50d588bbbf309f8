#include "techniques/vertex_buffers.h"

#include <bit>

namespace antipode {

using namespace shared;

namespace {

/// Counts of a compaction's chunks (two each), or of a radix pass's chunks (one a digit), and the total.
uint64_t scanEntries(uint32_t capacity, uint32_t batchSize, bool merging) {
    const uint64_t compaction = 2ull * (batchSize / COMPACT_CHUNK + 1) + 1;
    const uint64_t sort = merging ? uint64_t(SORT_DIGITS) * (capacity / SORT_CHUNK + 1) + 1 : 0;
    return std::max(compaction, sort);
}

}  // namespace

VertexBuffers::VertexBuffers(Device& device, uint32_t capacity, uint32_t batchSize, uint32_t buckets,
                             Precision precision)
    : capacity_(capacity),
      bucketCount_(buckets),
      positions_(device, recordBytes(precision) * capacity, Residency::DeviceOnly),
      data_(device, recordBytes(precision) * 2 * capacity, Residency::DeviceOnly),
      sortedPositions_(device, recordBytes(precision) * (buckets ? capacity : 1), Residency::DeviceOnly),
      sortedData_(device, recordBytes(precision) * 2 * (buckets ? capacity : 1), Residency::DeviceOnly),
      keys_(device, buckets ? 16ull * capacity : 16, Residency::DeviceOnly),
      cells_(device, 8ull * std::max(buckets, 1u), Residency::DeviceOnly),
      scan_(device, 4ull * scanEntries(capacity, batchSize, buckets > 0), Residency::DeviceOnly) {}

void VertexBuffers::bind(BindingTable& table) const {
    table.set(BIND_VERTEX_POSITIONS_OUT, positions_);
    table.set(BIND_VERTEX_DATA_OUT, data_);
    table.set(BIND_SORTED_POSITIONS_OUT, sortedPositions_);
    table.set(BIND_SORTED_DATA_OUT, sortedData_);
    table.set(BIND_SORT_KEYS, keys_);
    table.set(BIND_CELLS_OUT, cells_);
    table.set(BIND_SCAN, scan_);
    table.set(BIND_VERTEX_POSITIONS, bucketCount_ ? sortedPositions_ : positions_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_VERTEX_DATA, bucketCount_ ? sortedData_ : data_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_CELLS, cells_, VK_FORMAT_R32G32_UINT);
}

uint32_t VertexBuffers::sortPasses() const {
    return (uint32_t(std::countr_zero(bucketCount_)) + SORT_DIGIT_BITS - 1) / SORT_DIGIT_BITS;
}

uint64_t VertexBuffers::greatestCapacity(const Device& device, Precision precision) {
    const uint64_t bytes = 2 * recordBytes(precision);  // of the data, the larger array
    return std::min<uint64_t>(device.limits().maxStorageBufferRange / bytes,
                              device.limits().maxTexelBufferElements / (bytes / sizeof(uvec4)));
}

}  // namespace antipode
