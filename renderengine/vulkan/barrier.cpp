#include "vulkan/barrier.h"

namespace antipode {

namespace {

void recordBarrier(VkCommandBuffer commands, VkPipelineStageFlags targetStages, VkAccessFlags targetAccess) {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = targetAccess;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, targetStages, 0, 1, &barrier, 0, nullptr, 0,
                         nullptr);
}

}  // namespace

void recordDeviceBarrier(VkCommandBuffer commands) {
    recordBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT);
}

void recordHostBarrier(VkCommandBuffer commands) {
    recordBarrier(commands, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT | VK_ACCESS_HOST_WRITE_BIT);
}

}  // namespace antipode
