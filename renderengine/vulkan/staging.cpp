#include "vulkan/staging.h"

#include "vulkan/buffer.h"

#include <algorithm>
#include <cstring>

namespace antipode {

namespace {

void copyNow(Device& device, VkBuffer source, VkBuffer target, const VkBufferCopy& region) {
    device.runNow([&](VkCommandBuffer commands) { vkCmdCopyBuffer(commands, source, target, 1, &region); });
}

}  // namespace

void uploadStaged(Device& device, VkBuffer target, VkDeviceSize offset, const void* source, size_t bytes) {
    const Buffer& staging = device.staging();
    for (size_t done = 0, part = 0; done < bytes; done += part) {
        part = std::min<size_t>(bytes - done, staging.bytes());
        std::memcpy(staging.mapped(), static_cast<const std::byte*>(source) + done, part);
        copyNow(device, staging.handle(), target, {0, offset + done, part});
    }
}

void downloadStaged(Device& device, VkBuffer source, VkDeviceSize offset, void* target, size_t bytes) {
    const Buffer& staging = device.staging();
    for (size_t done = 0, part = 0; done < bytes; done += part) {
        part = std::min<size_t>(bytes - done, staging.bytes());
        copyNow(device, source, staging.handle(), {offset + done, 0, part});
        std::memcpy(static_cast<std::byte*>(target) + done, staging.mapped(), part);
    }
}

}  // namespace antipode
