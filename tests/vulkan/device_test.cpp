#include "vulkan/device.h"

#include "renderengine/error.h"
#include "test_device.h"

namespace antipode {
namespace {

TEST(Devices, ListsUsableDeviceWithUuid) {
    const std::vector<DeviceInfo> devices = listDevices();
    ASSERT_FALSE(devices.empty());
    const DeviceInfo& best = devices.front();
    EXPECT_TRUE(best.usable) << best.reason;
    EXPECT_EQ(best.uuid.size(), 32u);
    EXPECT_GT(best.memoryBytes, 0u);
    EXPECT_FALSE(best.driver.empty());
    EXPECT_EQ(selectDevice(best.uuid).index, best.index);
}

TEST(Devices, ReportsUnknownSelector) { EXPECT_THROW(selectDevice("999"), Error); }

TEST(Devices, ReportsDeviceThatIsGone) {
    DeviceInfo info = selectDevice("");
    info.uuid = std::string(32, '0');
    EXPECT_THROW(Device{info}, Error);
}

TEST(Devices, RefusesUnknownValidationSetting) {
    setenv("ANTIPODE_VALIDATION", "yes", 1);
    EXPECT_THROW(Instance{}, Error);
}

TEST_F(DeviceTest, OpensWithLimits) {
    EXPECT_TRUE(device->instance().validates());
    EXPECT_GE(device->subgroupSize(), 1u);
    EXPECT_GE(device->limits().maxComputeWorkGroupCount[0], 65535u);
    EXPECT_EQ(device->isCpu(), device->info().kind == "CPU");
    EXPECT_EQ(device->allocatedBytes(), 0u);
}

/// Proves that the other tests would see a message: the layer must complain about a buffer of no size.
TEST(Validation, CollectsMessages) {
    setenv("ANTIPODE_VALIDATION", "1", 1);
    const Device device("");
    VkBufferCreateInfo empty{};
    empty.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    empty.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    const VkResult result = vkCreateBuffer(device.handle(), &empty, nullptr, &buffer);
    if (result == VK_SUCCESS) vkDestroyBuffer(device.handle(), buffer, nullptr);
    EXPECT_FALSE(device.instance().validationMessages().empty());
}

}  // namespace
}  // namespace antipode
