#include "vulkan/commands.h"

#include "renderengine/error.h"
#include "vulkan/barrier.h"
#include "vulkan/check.h"

#include <algorithm>
#include <stdexcept>

namespace antipode {

namespace {

constexpr uint32_t queriesPerPool = 256;

}  // namespace

Commands::Commands(Device& device) : device_(device) {
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = device_.commandPool();
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device_.handle(), &info, &commands_), "allocate a command buffer");
}

Commands::~Commands() {
    for (const VkQueryPool pool : queryPools_) vkDestroyQueryPool(device_.handle(), pool, nullptr);
    vkFreeCommandBuffers(device_.handle(), device_.commandPool(), 1, &commands_);
}

void Commands::begin() {
    table_ = nullptr;
    labels_.clear();
    const VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    check(vkBeginCommandBuffer(commands_, &info), "begin a command buffer");
    recordDeviceBarrier(commands_);  // a fence orders runs, but does not show the writes of one to the next
    for (const VkQueryPool pool : queryPools_) vkCmdResetQueryPool(commands_, pool, 0, queriesPerPool);
}

void Commands::bind(const BindingTable& table) {
    table_ = &table;
    const VkDescriptorSet set = table.descriptorSet();
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, table.pipelineLayout(), 0, 1, &set, 0, nullptr);
}

std::array<uint32_t, 3> Commands::maxGroups() const {
    const uint32_t* const count = device_.limits().maxComputeWorkGroupCount;
    return {count[0], count[1], count[2]};
}

void Commands::prepareDispatch(const ComputePipeline& pipeline, std::span<const std::byte> push) {
    if (!table_) throw std::logic_error("Commands: a dispatch without a binding table");
    if (push.size() > table_->pushConstantBytes() || push.size() % 4)
        throw std::logic_error("Commands: " + std::to_string(push.size()) +
                               " bytes of push constants, but the table has " +
                               std::to_string(table_->pushConstantBytes()));
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle());
    if (!push.empty())
        vkCmdPushConstants(commands_, table_->pipelineLayout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                           static_cast<uint32_t>(push.size()), push.data());
}

void Commands::dispatch(const ComputePipeline& pipeline, uint32_t groupsX, std::span<const std::byte> push,
                        uint32_t groupsY) {
    const auto most = maxGroups();
    if (groupsX > most[0] || groupsY > most[1])
        throw Error(ErrorCode::Device, "A dispatch of " + std::to_string(groupsX) + " x " + std::to_string(groupsY) +
                                           " workgroups is more than the " + std::to_string(most[0]) + " x " +
                                           std::to_string(most[1]) + " that the device " + device_.info().name +
                                           " runs.");
    prepareDispatch(pipeline, push);
    if (groupsX > 0 && groupsY > 0) vkCmdDispatch(commands_, groupsX, groupsY, 1);
}

void Commands::dispatchIndirect(const ComputePipeline& pipeline, const Buffer& arguments, VkDeviceSize offset,
                                std::span<const std::byte> push) {
    prepareDispatch(pipeline, push);
    vkCmdDispatchIndirect(commands_, arguments.handle(), offset);
}

void Commands::barrier() { recordDeviceBarrier(commands_); }

void Commands::fill(const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes, uint32_t value) {
    if (bytes > 0) vkCmdFillBuffer(commands_, buffer.handle(), offset, bytes, value);
}

void Commands::copy(const Buffer& source, VkDeviceSize sourceOffset, const Buffer& target, VkDeviceSize targetOffset,
                    VkDeviceSize bytes) {
    if (bytes == 0) return;
    const VkBufferCopy region{sourceOffset, targetOffset, bytes};
    vkCmdCopyBuffer(commands_, source.handle(), target.handle(), 1, &region);
}

void Commands::timestamp(const std::string& label) {
    if (device_.timestampPeriodSeconds() == 0.0) return;
    const auto query = static_cast<uint32_t>(labels_.size());
    if (query / queriesPerPool >= queryPools_.size()) {
        VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
        info.queryType = VK_QUERY_TYPE_TIMESTAMP;
        info.queryCount = queriesPerPool;
        VkQueryPool pool = VK_NULL_HANDLE;
        check(vkCreateQueryPool(device_.handle(), &info, nullptr, &pool), "create a query pool");
        queryPools_.push_back(pool);
        vkCmdResetQueryPool(commands_, pool, 0, queriesPerPool);
    }
    vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queryPools_[query / queriesPerPool],
                        query % queriesPerPool);
    labels_.push_back(label);
}

void Commands::submitAndWait() {
    recordHostBarrier(commands_);
    check(vkEndCommandBuffer(commands_), "end a command buffer");
    device_.submitAndWait(commands_);
}

std::vector<Timestamp> Commands::timestampSeconds() const {
    std::vector<uint64_t> ticks(labels_.size());
    for (size_t first = 0; first < ticks.size(); first += queriesPerPool) {
        const size_t count = std::min<size_t>(queriesPerPool, ticks.size() - first);
        check(vkGetQueryPoolResults(device_.handle(), queryPools_[first / queriesPerPool], 0,
                                    static_cast<uint32_t>(count), count * sizeof(uint64_t), &ticks[first],
                                    sizeof(uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
              "read timestamps");
    }
    std::vector<Timestamp> result;
    for (size_t i = 0; i < ticks.size(); ++i)
        result.push_back(
            {labels_[i], double((ticks[i] - ticks[0]) & device_.timestampMask()) * device_.timestampPeriodSeconds()});
    return result;
}

}  // namespace antipode
