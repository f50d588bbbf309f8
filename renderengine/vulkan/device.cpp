#include "vulkan/device.h"

#include "renderengine/error.h"
#include "vulkan/barrier.h"
#include "vulkan/buffer.h"
#include "vulkan/check.h"
#include "vulkan/physical_device.h"

namespace antipode {

namespace {

constexpr VkDeviceSize stagingBytes = VkDeviceSize(16) << 20;

/// The device that `info` was read from. Drivers keep their order between instances; the UUID guards against one that
/// came or went in between.
VkPhysicalDevice findPhysical(const Instance& instance, const DeviceInfo& info) {
    const std::vector<VkPhysicalDevice> devices = instance.physicalDevices();
    if (info.index >= devices.size() || describeDevice(devices[info.index], info.index).uuid != info.uuid)
        throw Error(ErrorCode::Device, "The device " + info.name + " is no longer there.");
    return devices[info.index];
}

}  // namespace

Device::Device(const DeviceInfo& info) : info_(info), physical_(findPhysical(instance_, info)) {
    if (!info.usable)
        throw Error(ErrorCode::Device, "The device " + info.name + " is not usable: " + info.reason + ".");
    try {
        open();
    } catch (...) {
        close();
        throw;
    }
}

Device::~Device() { close(); }

void Device::open() {
    const uint32_t family = computeQueueFamily(physical_).value();

    VkPhysicalDeviceSubgroupProperties subgroup{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &subgroup;
    vkGetPhysicalDeviceProperties2(physical_, &properties);
    limits_ = properties.properties.limits;
    subgroupSize_ = subgroup.subgroupSize;
    isCpu_ = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);

    uint32_t familyCount = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical_, &familyCount, nullptr);
    std::vector<VkQueueFamilyProperties> families(familyCount);
    vkGetPhysicalDeviceQueueFamilyProperties(physical_, &familyCount, families.data());
    if (const uint32_t bits = families[family].timestampValidBits) {
        timestampPeriodSeconds_ = double(limits_.timestampPeriod) * 1e-9;
        timestampMask_ = bits >= 64 ? ~uint64_t(0) : (uint64_t(1) << bits) - 1;
    }

    VkPhysicalDeviceFeatures offered{};
    vkGetPhysicalDeviceFeatures(physical_, &offered);
    hasFloat64_ = offered.shaderFloat64;
    VkPhysicalDeviceFeatures wanted{};
    wanted.shaderFloat64 = hasFloat64_;

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queueInfo.queueFamilyIndex = family;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    deviceInfo.pEnabledFeatures = &wanted;
    deviceInfo.queueCreateInfoCount = 1;
    deviceInfo.pQueueCreateInfos = &queueInfo;
    check(vkCreateDevice(physical_, &deviceInfo, nullptr, &device_), "open the device");
    vkGetDeviceQueue(device_, family, 0, &queue_);

    VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    poolInfo.queueFamilyIndex = family;
    check(vkCreateCommandPool(device_, &poolInfo, nullptr, &commandPool_), "create a command pool");
    const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vkCreateFence(device_, &fenceInfo, nullptr, &fence_), "create a fence");
}

void Device::close() noexcept {
    if (!device_) return;
    staging_.reset();
    vkDestroyFence(device_, fence_, nullptr);
    vkDestroyCommandPool(device_, commandPool_, nullptr);
    vkDestroyDevice(device_, nullptr);
}

void Device::submitAndWait(VkCommandBuffer commands) {
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    check(vkResetFences(device_, 1, &fence_), "reset a fence");
    check(vkQueueSubmit(queue_, 1, &submit, fence_), "submit commands");
    check(vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX), "wait for the device");
}

void Device::runNow(const std::function<void(VkCommandBuffer)>& record) {
    VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocation.commandPool = commandPool_;
    allocation.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocation.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(device_, &allocation, &commands), "allocate a command buffer");
    const auto free = [&](VkCommandBuffer* buffer) { vkFreeCommandBuffers(device_, commandPool_, 1, buffer); };
    const std::unique_ptr<VkCommandBuffer, decltype(free)> guard(&commands, free);

    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &begin), "begin a command buffer");
    recordDeviceBarrier(commands);
    record(commands);
    recordHostBarrier(commands);
    check(vkEndCommandBuffer(commands), "end a command buffer");
    submitAndWait(commands);
}

const Buffer& Device::staging() {
    if (!staging_) staging_ = std::make_unique<Buffer>(*this, stagingBytes, Residency::HostVisible);
    return *staging_;
}

}  // namespace antipode
