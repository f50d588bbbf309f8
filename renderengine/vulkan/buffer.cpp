#include "vulkan/buffer.h"

#include "renderengine/error.h"
#include "vulkan/check.h"
#include "vulkan/staging.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <utility>

namespace antipode {

namespace {

constexpr VkMemoryPropertyFlags deviceLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags mappable = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

/// The first memory type, in the driver's order, that has all of `required` and none of `forbidden`.
std::optional<uint32_t> findType(const Device& device, uint32_t allowed, VkMemoryPropertyFlags required,
                                 VkMemoryPropertyFlags forbidden) {
    const VkPhysicalDeviceMemoryProperties& memory = device.memory();
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
        if ((allowed >> i & 1) && (flags & required) == required && !(flags & forbidden)) return i;
    }
    return std::nullopt;
}

/// Uncached mapped memory is left out for DeviceOnly: the host reads it far slower than it copies through staging.
uint32_t chooseType(const Device& device, uint32_t allowed, Residency residency) {
    struct Wish {
        VkMemoryPropertyFlags required, forbidden;
    };
    const std::initializer_list<Wish> deviceWishes = {{deviceLocal | mappable | cached, 0},
                                                      {deviceLocal, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT},
                                                      {deviceLocal, 0},
                                                      {0, 0}};
    const std::initializer_list<Wish> hostWishes = {{mappable | cached, 0}, {mappable, 0}};
    for (const Wish& wish : residency == Residency::DeviceOnly ? deviceWishes : hostWishes)
        if (const auto type = findType(device, allowed, wish.required, wish.forbidden)) return *type;
    throw Error(ErrorCode::Device, "The device " + device.info().name + " has no memory that the host can map.");
}

VkDeviceSize texelBytes(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R32_SFLOAT:
        case VK_FORMAT_R32_UINT: return 4;
        case VK_FORMAT_R16G16B16A16_SFLOAT:
        case VK_FORMAT_R32G32_SFLOAT:
        case VK_FORMAT_R32G32_UINT: return 8;
        case VK_FORMAT_R32G32B32A32_SFLOAT:
        case VK_FORMAT_R32G32B32A32_UINT: return 16;
        default: throw std::invalid_argument("texelView: format " + std::to_string(format) + " is not supported");
    }
}

}  // namespace

std::string formatBytes(uint64_t bytes) {
    const char* const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    double value = double(bytes);
    int unit = 0;
    for (; value >= 1024.0; value /= 1024.0) ++unit;
    char text[32];
    std::snprintf(text, sizeof text, unit == 0 ? "%.0f %s" : "%.1f %s", value, units[unit]);
    return text;
}

Buffer::Buffer(Device& device, VkDeviceSize bytes, Residency residency) : device_(&device), bytes_(bytes) {
    try {
        allocate(residency);
    } catch (...) {
        release();
        throw;
    }
}

void Buffer::allocate(Residency residency) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    // Whole texels of every format, and at least one, as Vulkan has no empty buffers.
    info.size = std::max<VkDeviceSize>(16, (bytes_ + 15) / 16 * 16);
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                 VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                 VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    VkMemoryRequirements requirements{};
    VkResult result = vkCreateBuffer(device_->handle(), &info, nullptr, &buffer_);
    if (result == VK_SUCCESS) {
        vkGetBufferMemoryRequirements(device_->handle(), buffer_, &requirements);
        VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
        allocation.allocationSize = requirements.size;
        allocation.memoryTypeIndex = chooseType(*device_, requirements.memoryTypeBits, residency);
        result = vkAllocateMemory(device_->handle(), &allocation, nullptr, &memory_);
        const VkMemoryPropertyFlags flags = device_->memory().memoryTypes[allocation.memoryTypeIndex].propertyFlags;
        if (result == VK_SUCCESS) {
            check(vkBindBufferMemory(device_->handle(), buffer_, memory_, 0), "bind a buffer's memory");
            if ((flags & mappable) == mappable)
                check(vkMapMemory(device_->handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped_), "map a buffer's memory");
        }
    }
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
        throw Error(ErrorCode::Device,
                    "The device " + device_->info().name + " has no room for a buffer of " + formatBytes(bytes_) +
                        " beside the " + formatBytes(device_->allocatedBytes()) + " already in use (it has " +
                        formatBytes(device_->info().memoryBytes) + " in all); use a smaller scene or image.");
    check(result, "create a buffer");
    allocatedBytes_ = requirements.size;
    device_->allocatedBytes_ += allocatedBytes_;
}

void Buffer::release() noexcept {
    for (const auto& [format, view] : views_) vkDestroyBufferView(device_->handle(), view, nullptr);
    views_.clear();
    vkDestroyBuffer(device_->handle(), std::exchange(buffer_, VK_NULL_HANDLE), nullptr);
    vkFreeMemory(device_->handle(), std::exchange(memory_, VK_NULL_HANDLE), nullptr);
    device_->allocatedBytes_ -= std::exchange(allocatedBytes_, 0);
}

Buffer::~Buffer() { release(); }

Buffer::Buffer(Buffer&& other) noexcept
    : device_(other.device_),
      bytes_(std::exchange(other.bytes_, 0)),
      allocatedBytes_(std::exchange(other.allocatedBytes_, 0)),
      buffer_(std::exchange(other.buffer_, VK_NULL_HANDLE)),
      memory_(std::exchange(other.memory_, VK_NULL_HANDLE)),
      mapped_(std::exchange(other.mapped_, nullptr)),
      views_(std::exchange(other.views_, {})) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(bytes_, other.bytes_);
    std::swap(allocatedBytes_, other.allocatedBytes_);
    std::swap(buffer_, other.buffer_);
    std::swap(memory_, other.memory_);
    std::swap(mapped_, other.mapped_);
    std::swap(views_, other.views_);
    return *this;
}

void Buffer::requireRange(VkDeviceSize offset, size_t bytes) const {
    if (offset > bytes_ || bytes > bytes_ - offset)
        throw std::out_of_range("Buffer: " + std::to_string(bytes) + " bytes from " + std::to_string(offset) +
                                " on are not within its " + std::to_string(bytes_));
}

void Buffer::upload(const void* source, size_t bytes, VkDeviceSize offset) {
    requireRange(offset, bytes);
    if (bytes == 0) return;
    if (mapped_)
        std::memcpy(static_cast<std::byte*>(mapped_) + offset, source, bytes);
    else
        uploadStaged(*device_, buffer_, offset, source, bytes);
}

void Buffer::download(void* target, size_t bytes, VkDeviceSize offset) const {
    requireRange(offset, bytes);
    if (bytes == 0) return;
    if (mapped_)
        std::memcpy(target, static_cast<const std::byte*>(mapped_) + offset, bytes);
    else
        downloadStaged(*device_, buffer_, offset, target, bytes);
}

void Buffer::fill(uint32_t value) {
    if (mapped_)
        std::fill_n(static_cast<uint32_t*>(mapped_), (bytes_ + 3) / 4, value);
    else
        device_->runNow([&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, buffer_, 0, VK_WHOLE_SIZE, value); });
}

VkBufferView Buffer::texelView(VkFormat format) const {
    if (const auto found = views_.find(format); found != views_.end()) return found->second;
    const VkDeviceSize texels = (bytes_ + texelBytes(format) - 1) / texelBytes(format);
    if (texels > device_->limits().maxTexelBufferElements)
        throw Error(ErrorCode::Device, "A buffer of " + std::to_string(texels) + " texels (" + formatBytes(bytes_) +
                                           ") has more than the " +
                                           std::to_string(device_->limits().maxTexelBufferElements) +
                                           " that the device " + device_->info().name + " can address.");
    VkBufferViewCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
    info.buffer = buffer_;
    info.format = format;
    info.range = std::max<VkDeviceSize>(texels, 1) * texelBytes(format);
    VkBufferView view = VK_NULL_HANDLE;
    check(vkCreateBufferView(device_->handle(), &info, nullptr, &view), "create a texel view");
    views_.emplace(format, view);
    return view;
}

}  // namespace antipode
