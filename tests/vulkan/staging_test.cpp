#include "vulkan/staging.h"

#include "test_device.h"
#include "vulkan/buffer.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace antipode {
namespace {

/// Calls the staged path itself, which `Buffer` takes only on devices whose memory the host cannot see.
TEST_F(DeviceTest, StagingMovesMoreThanItHolds) {
    const size_t count = size_t(device->staging().bytes()) / 4 * 5 / 2 + 1;
    std::vector<uint32_t> values(count);
    std::iota(values.begin(), values.end(), 0u);
    const Buffer buffer(*device, count * 4 + 8, Residency::DeviceOnly);
    uploadStaged(*device, buffer.handle(), 8, values.data(), count * 4);

    std::vector<uint32_t> direct(count), staged(count);
    buffer.download(direct.data(), count * 4, 8);
    EXPECT_TRUE(std::equal(direct.begin(), direct.end(), values.begin()));
    downloadStaged(*device, buffer.handle(), 8, staged.data(), count * 4);
    EXPECT_TRUE(std::equal(staged.begin(), staged.end(), values.begin()));
}

}  // namespace
}  // namespace antipode
