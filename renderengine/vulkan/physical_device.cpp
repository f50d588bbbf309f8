#include "vulkan/physical_device.h"

#include "renderengine/io/text.h"
#include "vulkan/check.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace antipode {

namespace {

// What the kernels and buffers are laid out for. Every desktop GPU and Mesa's CPU device offer it.
constexpr uint32_t requiredTexelElements = 1u << 26;
constexpr uint32_t requiredStorageRange = 1u << 27;
constexpr uint32_t requiredStorageBuffers = 16;
constexpr uint32_t requiredTexelBuffers = 16;
constexpr uint32_t requiredWorkgroup = 64;
constexpr uint32_t requiredSharedBytes = 16384;

std::string kindName(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return "discrete GPU";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return "integrated GPU";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return "virtual GPU";
        case VK_PHYSICAL_DEVICE_TYPE_CPU: return "CPU";
        default: return "other";
    }
}

bool hasExtension(VkPhysicalDevice physical, const char* name) {
    uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr), "count a device's extensions");
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data()),
          "list a device's extensions");
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

uint64_t largestLocalHeap(VkPhysicalDevice physical) {
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    uint64_t largest = 0;
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            largest = std::max<uint64_t>(largest, memory.memoryHeaps[i].size);
    return largest;
}

/// Why the renderer cannot use the device; empty where it can.
std::string whyUnusable(VkPhysicalDevice physical, const VkPhysicalDeviceProperties& properties) {
    if (properties.apiVersion < VK_API_VERSION_1_2)
        return "it offers Vulkan " + std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) + "." +
               std::to_string(VK_API_VERSION_MINOR(properties.apiVersion)) + ", and 1.2 is needed";
    if (!computeQueueFamily(physical)) return "it has no compute queue";

    VkPhysicalDeviceSubgroupProperties subgroup{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceProperties2 extended{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    extended.pNext = &subgroup;
    vkGetPhysicalDeviceProperties2(physical, &extended);
    constexpr VkSubgroupFeatureFlags neededOperations = VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT;
    if (!(subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) ||
        (subgroup.supportedOperations & neededOperations) != neededOperations)
        return "its compute shaders have no subgroup ballots";

    const VkPhysicalDeviceLimits& limits = properties.limits;
    const struct {
        const char* name;
        uint32_t offered, needed;
    } requirements[] = {
        {"maxTexelBufferElements", limits.maxTexelBufferElements, requiredTexelElements},
        {"maxStorageBufferRange", limits.maxStorageBufferRange, requiredStorageRange},
        {"maxPerStageDescriptorStorageBuffers", limits.maxPerStageDescriptorStorageBuffers, requiredStorageBuffers},
        {"maxPerStageDescriptorSampledImages", limits.maxPerStageDescriptorSampledImages, requiredTexelBuffers},
        {"maxComputeWorkGroupInvocations", limits.maxComputeWorkGroupInvocations, requiredWorkgroup},
        {"maxComputeSharedMemorySize", limits.maxComputeSharedMemorySize, requiredSharedBytes},
    };
    for (const auto& requirement : requirements)
        if (requirement.offered < requirement.needed)
            return std::string("its ") + requirement.name + " is " + std::to_string(requirement.offered) + ", and " +
                   std::to_string(requirement.needed) + " is needed";
    return "";
}

}  // namespace

std::optional<uint32_t> computeQueueFamily(VkPhysicalDevice physical) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());

    std::optional<uint32_t> best;
    for (uint32_t i = 0; i < count; ++i) {
        if (!(families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) || families[i].queueCount == 0) continue;
        if (!(families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT)) return i;
        if (!best) best = i;
    }
    return best;
}

DeviceInfo describeDevice(VkPhysicalDevice physical, uint32_t index) {
    DeviceInfo info;
    info.index = index;
    info.memoryBytes = largestLocalHeap(physical);

    VkPhysicalDeviceProperties basic{};
    vkGetPhysicalDeviceProperties(physical, &basic);
    info.name = basic.deviceName;
    info.kind = kindName(basic.deviceType);
    info.bindingBytes = basic.limits.maxStorageBufferRange;
    info.reason = whyUnusable(physical, basic);
    info.usable = info.reason.empty();
    // Version 1.2 brought the driver's name; asking a device of an older version for it is an error.
    if (basic.apiVersion < VK_API_VERSION_1_2) return info;

    const bool tellsPci = hasExtension(physical, VK_EXT_PCI_BUS_INFO_EXTENSION_NAME);
    VkPhysicalDevicePCIBusInfoPropertiesEXT pci{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PCI_BUS_INFO_PROPERTIES_EXT};
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    driver.pNext = tellsPci ? &pci : nullptr;
    VkPhysicalDeviceIDProperties id{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES};
    id.pNext = &driver;
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &id;
    vkGetPhysicalDeviceProperties2(physical, &properties);

    info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
    info.uuid = hexadecimal({reinterpret_cast<const char*>(id.deviceUUID), VK_UUID_SIZE});
    if (tellsPci) {
        char text[32];
        std::snprintf(text, sizeof text, "%04x:%02x:%02x.%x", pci.pciDomain, pci.pciBus, pci.pciDevice,
                      pci.pciFunction);
        info.pciId = text;
    }
    return info;
}

}  // namespace antipode
