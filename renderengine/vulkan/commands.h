// A reusable list of dispatches, copies and barriers.
#pragma once

#include "vulkan/pipeline.h"

#include <array>
#include <cstddef>
#include <string>

namespace antipode {

/// A moment in the last run of a `Commands`.
struct Timestamp {
    std::string label;
    double seconds;  ///< since the run's first timestamp, on the device's clock
};

/// Records commands and runs them, any number of times. Between `begin` and `submitAndWait` nothing runs. Commands do
/// not wait for one another unless a `barrier` stands between them; runs do.
class Commands {
public:
    explicit Commands(Device& device);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    /// Starts a new list; what was recorded before is forgotten.
    void begin();

    /// The bindings of the dispatches that follow. Must outlive the run and not change before it is done.
    void bind(const BindingTable& table);

    /// Largest number of workgroups per dimension of a dispatch (at least 65535); the caller splits larger grids.
    std::array<uint32_t, 3> maxGroups() const;

    /// Runs groupsX × groupsY workgroups; none where either is 0. `push` is at most the table's pushConstantBytes long,
    /// in whole 32-bit words; a kernel sees what an earlier dispatch of the list pushed beyond it. Throws Error(Device)
    /// where the grid exceeds `maxGroups`, std::logic_error where no table is bound or `push` does not fit it.
    void dispatch(const ComputePipeline& pipeline, uint32_t groupsX, std::span<const std::byte> push = {},
                  uint32_t groupsY = 1);

    /// As `dispatch`, with the three group counts read from `arguments` at `offset` (a multiple of 4) when it runs.
    void dispatchIndirect(const ComputePipeline& pipeline, const Buffer& arguments, VkDeviceSize offset,
                          std::span<const std::byte> push = {});

    /// All that was recorded before is done, and its writes are seen, before anything recorded after starts.
    void barrier();

    /// Sets 32-bit words; `offset` and `bytes` are multiples of 4.
    void fill(const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes, uint32_t value);

    void copy(const Buffer& source, VkDeviceSize sourceOffset, const Buffer& target, VkDeviceSize targetOffset,
              VkDeviceSize bytes);

    /// Marks the moment when all that was recorded before is done (nothing where the device has no timestamps).
    void timestamp(const std::string& label);

    /// Runs the list and waits; the host sees what it wrote. Throws Error(Device), also where the device is lost.
    void submitAndWait();

    /// The timestamps of the last run, in the order recorded.
    std::vector<Timestamp> timestampSeconds() const;

private:
    void prepareDispatch(const ComputePipeline& pipeline, std::span<const std::byte> push);

    Device& device_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    const BindingTable* table_ = nullptr;
    std::vector<VkQueryPool> queryPools_;  ///< of equal size, grown when needed
    std::vector<std::string> labels_;
};

}  // namespace antipode
