// The one descriptor set that all kernels of an engine share.
#pragma once

#include "vulkan/buffer.h"

#include <vector>

namespace antipode {

struct Binding {
    uint32_t index;         ///< `binding = index` in the kernels, in set 0
    VkDescriptorType type;  ///< STORAGE_BUFFER or UNIFORM_TEXEL_BUFFER
};

/// Layout and contents of descriptor set 0, and the pipeline layout over it. Every binding that a kernel uses must be
/// set before commands that run it are recorded, and set again before recording where its buffer was replaced.
class BindingTable {
public:
    /// `pushConstantBytes` is a multiple of 4, at most 128. Throws Error(Device) where the device has too few bindings.
    BindingTable(Device& device, std::vector<Binding> bindings, uint32_t pushConstantBytes);
    ~BindingTable();
    BindingTable(const BindingTable&) = delete;
    BindingTable& operator=(const BindingTable&) = delete;

    /// Binds the whole of a storage buffer. Throws Error(Device) where it is larger than the device can bind at once;
    /// bind a part of it then. Throws std::invalid_argument where the table has no such storage binding.
    void set(uint32_t index, const Buffer& buffer);

    /// Binds `bytes` bytes from `offset`, a multiple of the device's minStorageBufferOffsetAlignment (at most 256).
    void set(uint32_t index, const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes);

    /// Binds the whole of a texel buffer. Throws as `Buffer::texelView` does, and std::invalid_argument as above.
    void set(uint32_t index, const Buffer& buffer, VkFormat format);

    VkDescriptorSet descriptorSet() const { return set_; }
    VkPipelineLayout pipelineLayout() const { return pipelineLayout_; }
    uint32_t pushConstantBytes() const { return pushConstantBytes_; }

private:
    void create();
    void release() noexcept;
    void requireBinding(uint32_t index, VkDescriptorType type) const;

    Device& device_;
    std::vector<Binding> bindings_;
    uint32_t pushConstantBytes_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout pipelineLayout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace antipode
