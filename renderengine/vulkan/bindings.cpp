#include "vulkan/bindings.h"

#include "renderengine/error.h"
#include "vulkan/check.h"

#include <algorithm>
#include <stdexcept>

namespace antipode {

namespace {

uint32_t countOf(const std::vector<Binding>& bindings, VkDescriptorType type) {
    return static_cast<uint32_t>(
        std::count_if(bindings.begin(), bindings.end(), [&](const Binding& binding) { return binding.type == type; }));
}

void requireAtMost(const Device& device, uint32_t wanted, uint32_t limit, const char* what) {
    if (wanted > limit)
        throw Error(ErrorCode::Device, "The renderer needs " + std::to_string(wanted) + " " + what +
                                           ", and the device " + device.info().name + " offers " +
                                           std::to_string(limit) + ".");
}

}  // namespace

BindingTable::BindingTable(Device& device, std::vector<Binding> bindings, uint32_t pushConstantBytes)
    : device_(device), bindings_(std::move(bindings)), pushConstantBytes_(pushConstantBytes) {
    try {
        create();
    } catch (...) {
        release();
        throw;
    }
}

void BindingTable::create() {
    const VkPhysicalDeviceLimits& limits = device_.limits();
    const uint32_t storageCount = countOf(bindings_, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    const uint32_t texelCount = countOf(bindings_, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
    if (bindings_.empty() || storageCount + texelCount != bindings_.size())
        throw std::invalid_argument("BindingTable: only storage and uniform texel buffers, and at least one of them");
    requireAtMost(device_, storageCount, limits.maxPerStageDescriptorStorageBuffers, "storage buffers");
    requireAtMost(device_, texelCount, limits.maxPerStageDescriptorSampledImages, "texel buffers");
    requireAtMost(device_, storageCount + texelCount, limits.maxPerStageResources, "buffers");
    requireAtMost(device_, pushConstantBytes_, limits.maxPushConstantsSize, "bytes of push constants");

    std::vector<VkDescriptorSetLayoutBinding> layout;
    for (const Binding& binding : bindings_)
        layout.push_back({binding.index, binding.type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = static_cast<uint32_t>(layout.size());
    setInfo.pBindings = layout.data();
    check(vkCreateDescriptorSetLayout(device_.handle(), &setInfo, nullptr, &setLayout_), "create a set layout");

    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, pushConstantBytes_};
    VkPipelineLayoutCreateInfo pipelineInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    pipelineInfo.setLayoutCount = 1;
    pipelineInfo.pSetLayouts = &setLayout_;
    pipelineInfo.pushConstantRangeCount = pushConstantBytes_ > 0 ? 1 : 0;
    pipelineInfo.pPushConstantRanges = &range;
    check(vkCreatePipelineLayout(device_.handle(), &pipelineInfo, nullptr, &pipelineLayout_),
          "create a pipeline layout");

    std::vector<VkDescriptorPoolSize> sizes;
    if (storageCount) sizes.push_back({VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, storageCount});
    if (texelCount) sizes.push_back({VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, texelCount});
    VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    poolInfo.maxSets = 1;
    poolInfo.poolSizeCount = static_cast<uint32_t>(sizes.size());
    poolInfo.pPoolSizes = sizes.data();
    check(vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &pool_), "create a descriptor pool");

    VkDescriptorSetAllocateInfo allocation{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocation.descriptorPool = pool_;
    allocation.descriptorSetCount = 1;
    allocation.pSetLayouts = &setLayout_;
    check(vkAllocateDescriptorSets(device_.handle(), &allocation, &set_), "allocate a descriptor set");
}

void BindingTable::release() noexcept {
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    vkDestroyPipelineLayout(device_.handle(), pipelineLayout_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), setLayout_, nullptr);
}

BindingTable::~BindingTable() { release(); }

void BindingTable::requireBinding(uint32_t index, VkDescriptorType type) const {
    for (const Binding& binding : bindings_)
        if (binding.index == index && binding.type == type) return;
    throw std::invalid_argument("BindingTable: no binding " + std::to_string(index) + " of descriptor type " +
                                std::to_string(type));
}

void BindingTable::set(uint32_t index, const Buffer& buffer) { set(index, buffer, 0, buffer.bytes()); }

void BindingTable::set(uint32_t index, const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes) {
    requireBinding(index, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    const VkPhysicalDeviceLimits& limits = device_.limits();
    if (offset > buffer.bytes() || bytes > buffer.bytes() - offset || offset % limits.minStorageBufferOffsetAlignment)
        throw std::invalid_argument("BindingTable: bad range for binding " + std::to_string(index));
    if (bytes > limits.maxStorageBufferRange)
        throw Error(ErrorCode::Device, "Binding " + std::to_string(index) + " needs " + formatBytes(bytes) +
                                           " at once, and the device " + device_.info().name + " binds at most " +
                                           formatBytes(limits.maxStorageBufferRange) +
                                           "; use a smaller image or scene.");
    // An empty buffer has room for one texel, so that there is something to bind.
    const VkDescriptorBufferInfo info{buffer.handle(), offset, std::max<VkDeviceSize>(bytes, 4)};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set_;
    write.dstBinding = index;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = &info;
    vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

void BindingTable::set(uint32_t index, const Buffer& buffer, VkFormat format) {
    requireBinding(index, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
    const VkBufferView view = buffer.texelView(format);
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set_;
    write.dstBinding = index;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    write.pTexelBufferView = &view;
    vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

}  // namespace antipode
