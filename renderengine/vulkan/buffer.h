// Device memory with a buffer over it.
#pragma once

#include "vulkan/device.h"

#include <map>
#include <string>

namespace antipode {

/// Where a buffer should live. Either may be mapped, as on a CPU device, whose memory is all the host's.
enum class Residency {
    DeviceOnly,   ///< fastest for the kernels; the host's transfers pass through a staging buffer where they must
    HostVisible,  ///< mapped for good; for what the host reads or writes often
};

/// A buffer that kernels may use as storage or uniform texel buffer and as indirect arguments, and that can be copied.
/// Its contents are undefined until written. The host must not touch it while commands that use it run.
class Buffer {
public:
    /// `bytes` may be 0. Throws Error(Device) where the device has not that much memory left.
    Buffer(Device& device, VkDeviceSize bytes, Residency residency);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    VkBuffer handle() const { return buffer_; }
    VkDeviceSize bytes() const { return bytes_; }
    const Device& device() const { return *device_; }
    /// The buffer's bytes where the host can see them, else null.
    void* mapped() const { return mapped_; }

    /// Copies `bytes` bytes into the buffer. Throws std::out_of_range where they do not fit.
    void upload(const void* source, size_t bytes, VkDeviceSize offset = 0);

    /// Copies `bytes` bytes out of the buffer. Throws std::out_of_range where it has not that many.
    void download(void* target, size_t bytes, VkDeviceSize offset = 0) const;

    /// Sets every 32-bit word to `value`.
    void fill(uint32_t value);

    /// A view of the whole buffer as texels; one of the R32 to R32G32B32A32 formats, uint or sfloat, or RGBA16F. Valid
    /// as long as the buffer. Throws Error(Device) where it holds more texels than the device can address.
    VkBufferView texelView(VkFormat format) const;

private:
    void allocate(Residency residency);
    void release() noexcept;
    void requireRange(VkDeviceSize offset, size_t bytes) const;

    Device* device_;
    VkDeviceSize bytes_;
    VkDeviceSize allocatedBytes_ = 0;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    void* mapped_ = nullptr;
    mutable std::map<VkFormat, VkBufferView> views_;
};

/// "1.5 GiB", for messages.
std::string formatBytes(uint64_t bytes);

}  // namespace antipode
