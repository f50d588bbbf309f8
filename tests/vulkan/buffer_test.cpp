#include "vulkan/buffer.h"

#include "renderengine/error.h"
#include "test_device.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace antipode {
namespace {

class BufferTest : public DeviceTest, public testing::WithParamInterface<Residency> {};

TEST_P(BufferTest, RoundTripsAtOffset) {
    std::vector<uint32_t> values(100001);
    std::iota(values.begin(), values.end(), 0u);
    Buffer buffer(*device, values.size() * 4 + 8, GetParam());
    buffer.upload(values.data(), values.size() * 4, 8);
    std::vector<uint32_t> back(values.size() - 1);
    buffer.download(back.data(), back.size() * 4, 12);
    EXPECT_TRUE(std::equal(back.begin(), back.end(), values.begin() + 1));
}

TEST_P(BufferTest, Fills) {
    Buffer buffer(*device, 4000, GetParam());
    buffer.fill(0x01020304);
    std::vector<uint32_t> back(1000);
    buffer.download(back.data(), 4000);
    EXPECT_EQ(back, std::vector<uint32_t>(1000, 0x01020304));
}

TEST_P(BufferTest, RefusesTransfersPastItsEnd) {
    Buffer buffer(*device, 100, GetParam());
    char bytes[101] = {};
    EXPECT_THROW(buffer.upload(bytes, 101), std::out_of_range);
    EXPECT_THROW(buffer.download(bytes, 2, 99), std::out_of_range);
    EXPECT_THROW(buffer.download(bytes, 0, 101), std::out_of_range);
    EXPECT_NO_THROW(buffer.upload(bytes, 100));
}

TEST_P(BufferTest, CountsLiveBytes) {
    {
        Buffer first(*device, 1 << 20, GetParam());
        Buffer second(*device, 1 << 20, GetParam());
        EXPECT_GE(device->allocatedBytes(), 2u << 20);
        first = std::move(second);
        Buffer third(std::move(first));
        EXPECT_EQ(third.bytes(), VkDeviceSize(1) << 20);
    }
    EXPECT_EQ(device->allocatedBytes(), 0u);
}

TEST_P(BufferTest, MayBeEmpty) {
    Buffer buffer(*device, 0, GetParam());
    buffer.fill(0);
    buffer.upload(nullptr, 0);
    EXPECT_NE(buffer.texelView(VK_FORMAT_R32G32B32A32_SFLOAT), VkBufferView(VK_NULL_HANDLE));
}

INSTANTIATE_TEST_SUITE_P(Residencies, BufferTest, testing::Values(Residency::DeviceOnly, Residency::HostVisible));

TEST_F(DeviceTest, BufferKeepsTexelViews) {
    const Buffer buffer(*device, 40, Residency::DeviceOnly);
    const VkBufferView view = buffer.texelView(VK_FORMAT_R32_UINT);
    EXPECT_EQ(buffer.texelView(VK_FORMAT_R32_UINT), view);
    EXPECT_NE(buffer.texelView(VK_FORMAT_R32G32_SFLOAT), view);
    EXPECT_THROW(buffer.texelView(VK_FORMAT_R8_UNORM), std::invalid_argument);
}

TEST_F(DeviceTest, BufferReportsMemoryExhausted) {
    try {
        Buffer(*device, uint64_t(1) << 60, Residency::DeviceOnly);
        FAIL() << "a buffer of an exbibyte was made";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Device);
        EXPECT_NE(std::string(error.what()).find("1.0 EiB"), std::string::npos) << error.what();
    }
    EXPECT_EQ(device->allocatedBytes(), 0u);
}

TEST(FormatBytes, ChoosesUnit) {
    EXPECT_EQ(formatBytes(0), "0 bytes");
    EXPECT_EQ(formatBytes(1023), "1023 bytes");
    EXPECT_EQ(formatBytes(1536), "1.5 KiB");
    EXPECT_EQ(formatBytes(uint64_t(3) << 40), "3.0 TiB");
    EXPECT_EQ(formatBytes(UINT64_MAX), "16.0 EiB");
}

}  // namespace
}  // namespace antipode
