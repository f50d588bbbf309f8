// A logical device with one compute queue.
#pragma once

#include "renderengine/devices.h"
#include "vulkan/instance.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <memory>

namespace antipode {

class Buffer;

/// Owns its instance, the device, the compute queue and a command pool. Must outlive everything made from it. Not
/// thread safe: a device and all that is made from it belong to one thread at a time.
class Device {
public:
    /// Throws Error(Device) where the device is gone, is not usable or cannot be opened.
    explicit Device(const DeviceInfo& info);
    /// The device that `selector` names, see `selectDevice`, whose errors it throws.
    explicit Device(const std::string& selector) : Device(selectDevice(selector)) {}
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const { return info_; }
    const Instance& instance() const { return instance_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkDevice handle() const { return device_; }
    VkQueue queue() const { return queue_; }
    VkCommandPool commandPool() const { return commandPool_; }
    const VkPhysicalDeviceLimits& limits() const { return limits_; }
    const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }

    uint32_t subgroupSize() const { return subgroupSize_; }
    /// Seconds that a timestamp's unit lasts; 0 where the queue has no timestamps.
    double timestampPeriodSeconds() const { return timestampPeriodSeconds_; }
    /// The bits of a timestamp that count; it wraps around beyond them.
    uint64_t timestampMask() const { return timestampMask_; }

    bool hasFloat64() const { return hasFloat64_; }
    bool isCpu() const { return isCpu_; }

    /// Bytes of device memory that live buffers hold.
    uint64_t allocatedBytes() const { return allocatedBytes_; }

    /// Records commands, runs them after all earlier work and waits until the host sees their writes. Throws
    /// Error(Device).
    void runNow(const std::function<void(VkCommandBuffer)>& record);

    /// Submits a recorded command buffer and waits for it. Throws Error(Device), also where the device is lost.
    void submitAndWait(VkCommandBuffer commands);

    /// A host-visible buffer through which transfers to memory that the host cannot see pass; made at first use.
    const Buffer& staging();

private:
    friend class Buffer;  // counts its bytes

    void open();
    void close() noexcept;

    Instance instance_;
    DeviceInfo info_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkPhysicalDeviceLimits limits_{};
    VkPhysicalDeviceMemoryProperties memory_{};
    uint32_t subgroupSize_ = 0;
    double timestampPeriodSeconds_ = 0.0;
    uint64_t timestampMask_ = 0;
    bool hasFloat64_ = false, isCpu_ = false;

    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool commandPool_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    uint64_t allocatedBytes_ = 0;
    std::unique_ptr<Buffer> staging_;
};

}  // namespace antipode
