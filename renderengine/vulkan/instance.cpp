#include "vulkan/instance.h"

#include "renderengine/error.h"
#include "vulkan/check.h"

#include <cstdlib>
#include <cstring>

namespace antipode {

namespace {

constexpr const char* validationLayer = "VK_LAYER_KHRONOS_validation";

enum class Validation { Off, Usual, Synchronisation };

Validation validationFromEnvironment() {
    const char* value = std::getenv("ANTIPODE_VALIDATION");
    const std::string setting = value ? value : "";
    if (setting.empty() || setting == "0") return Validation::Off;
    if (setting == "1") return Validation::Usual;
    if (setting == "sync") return Validation::Synchronisation;
    throw Error(ErrorCode::Usage, "ANTIPODE_VALIDATION is \"" + setting + "\"; use 0, 1 or sync.");
}

bool hasValidationLayer() {
    uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "count its layers");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "list its layers");
    for (const VkLayerProperties& layer : layers)
        if (std::strcmp(layer.layerName, validationLayer) == 0) return true;
    return false;
}

template <class Function>
Function instanceFunction(VkInstance instance, const char* name) {
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

}  // namespace

VkBool32 VKAPI_CALL Instance::onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                        const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
    auto& messageLog = *static_cast<MessageLog*>(log);
    const std::lock_guard lock(messageLog.mutex);
    messageLog.messages.emplace_back(data->pMessage);
    return VK_FALSE;
}

Instance::Instance() {
    const Validation validation = validationFromEnvironment();
    if (validation != Validation::Off && !hasValidationLayer())
        throw Error(ErrorCode::Device, std::string("ANTIPODE_VALIDATION asks for the Vulkan layer ") + validationLayer +
                                           ", which is not installed; install it or unset the variable.");

    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "antipode";
    application.apiVersion = VK_API_VERSION_1_2;

    const VkValidationFeatureEnableEXT synchronisation = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = validation == Validation::Synchronisation ? 1 : 0;
    features.pEnabledValidationFeatures = &synchronisation;

    VkDebugUtilsMessengerCreateInfoEXT messages{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messages.pNext = &features;
    messages.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messages.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messages.pfnUserCallback = &onMessage;
    messages.pUserData = log_.get();

    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    if (validation != Validation::Off) {
        info.pNext = &messages;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &validationLayer;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = extensions;
    }
    const VkResult result = vkCreateInstance(&info, nullptr, &instance_);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        throw Error(ErrorCode::Device,
                    "No Vulkan driver is installed; install the GPU's driver, or Mesa's for the CPU.");
    check(result, "start");

    if (validation == Validation::Off) return;
    messages.pNext = nullptr;
    const auto create =
        instanceFunction<PFN_vkCreateDebugUtilsMessengerEXT>(instance_, "vkCreateDebugUtilsMessengerEXT");
    const VkResult created =
        create ? create(instance_, &messages, nullptr, &messenger_) : VK_ERROR_EXTENSION_NOT_PRESENT;
    if (created != VK_SUCCESS) {
        vkDestroyInstance(instance_, nullptr);
        check(created, "listen to the validation layer");
    }
}

Instance::~Instance() {
    if (messenger_)
        instanceFunction<PFN_vkDestroyDebugUtilsMessengerEXT>(instance_, "vkDestroyDebugUtilsMessengerEXT")(
            instance_, messenger_, nullptr);
    vkDestroyInstance(instance_, nullptr);
}

std::vector<VkPhysicalDevice> Instance::physicalDevices() const {
    uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "count the devices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance_, &count, devices.data()), "list the devices");
    return devices;
}

std::vector<std::string> Instance::validationMessages() const {
    const std::lock_guard lock(log_->mutex);
    return log_->messages;
}

}  // namespace antipode
