#include "vulkan/pipeline.h"

#include "vulkan/check.h"

namespace antipode {

ComputePipeline::ComputePipeline(Device& device, const BindingTable& bindings, std::span<const uint32_t> spirv,
                                 const std::vector<std::pair<uint32_t, uint32_t>>& specialisation)
    : device_(&device) {
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<uint32_t> values;
    for (const auto& [id, value] : specialisation) {
        entries.push_back({id, static_cast<uint32_t>(values.size() * sizeof value), sizeof value});
        values.push_back(value);
    }
    VkSpecializationInfo constants{};
    constants.mapEntryCount = static_cast<uint32_t>(entries.size());
    constants.pMapEntries = entries.data();
    constants.dataSize = values.size() * sizeof(uint32_t);
    constants.pData = values.data();

    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    moduleInfo.codeSize = spirv.size_bytes();
    moduleInfo.pCode = spirv.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.handle(), &moduleInfo, nullptr, &module), "load a kernel");

    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &constants;
    info.layout = bindings.pipelineLayout();
    const VkResult result = vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
    vkDestroyShaderModule(device.handle(), module, nullptr);
    check(result, "compile a kernel");
}

ComputePipeline::~ComputePipeline() { vkDestroyPipeline(device_->handle(), pipeline_, nullptr); }

ComputePipeline::ComputePipeline(ComputePipeline&& other) noexcept
    : device_(other.device_), pipeline_(std::exchange(other.pipeline_, VK_NULL_HANDLE)) {}

ComputePipeline& ComputePipeline::operator=(ComputePipeline&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(pipeline_, other.pipeline_);
    return *this;
}

}  // namespace antipode
