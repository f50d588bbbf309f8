// The connection to the Vulkan loader, with or without the validation layer.
#pragma once

#include <vulkan/vulkan.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace antipode {

/// A Vulkan 1.2 instance. The environment variable ANTIPODE_VALIDATION switches on the Khronos validation layer: "1"
/// for its usual checks, "sync" for missing barriers as well (slower; the layer of Vulkan 1.3.239 sees those of copies
/// and fills, but not those between two dispatches); unset, "" or "0" leaves it off.
class Instance {
public:
    /// Throws Error(Device) where no Vulkan driver is installed or validation is asked for and its layer is missing.
    Instance();
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance handle() const { return instance_; }

    /// In the driver's order, which is what a device's index counts.
    std::vector<VkPhysicalDevice> physicalDevices() const;

    bool validates() const { return messenger_ != VK_NULL_HANDLE; }

    /// Warnings and errors of the validation layer since the instance was made. May be called from any thread.
    std::vector<std::string> validationMessages() const;

private:
    struct MessageLog {
        std::mutex mutex;
        std::vector<std::string> messages;
    };
    static VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT*, void* log);

    std::unique_ptr<MessageLog> log_ = std::make_unique<MessageLog>();
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace antipode
