#include "vulkan/commands.h"

#include "renderengine/error.h"
#include "test_device.h"
#include "vulkan_test_kernels.h"

#include <numeric>
#include <stdexcept>

namespace antipode {
namespace {

constexpr uint32_t count = 1000;
constexpr uint32_t groups = (count + 63) / 64;

class CommandsTest : public DeviceTest {
protected:
    CommandsTest()
        : bindings(*device, {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}, {1, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER}}, 16),
          values(*device, count * 4, Residency::DeviceOnly),
          table(*device, count * 16, Residency::DeviceOnly),
          commands(*device) {
        std::vector<uint32_t> initial(count);
        std::iota(initial.begin(), initial.end(), 0u);
        values.upload(initial.data(), count * 4);
        bindings.set(0, values);
        bindings.set(1, table, VK_FORMAT_R32G32B32A32_SFLOAT);
    }

    std::span<const std::byte> push() const { return std::as_bytes(std::span(&count, 1)); }

    std::vector<uint32_t> result() const {
        std::vector<uint32_t> words(count);
        values.download(words.data(), count * 4);
        return words;
    }

    void expectTimesIndex(uint32_t factor) const {
        const std::vector<uint32_t> words = result();
        for (uint32_t i = 0; i < count; ++i) ASSERT_EQ(words[i], factor * i) << i;
    }

    BindingTable bindings;
    Buffer values, table;
    Commands commands;
};

TEST_F(CommandsTest, DispatchesAreOrderedByBarriers) {
    const ComputePipeline twice(*device, bindings, test_kernels::double_values());
    const ComputePipeline thrice(*device, bindings, test_kernels::double_values(), {{0, 3}});
    commands.begin();
    commands.bind(bindings);
    commands.dispatch(twice, groups, push());
    commands.barrier();
    commands.dispatch(thrice, groups, push());
    commands.barrier();
    commands.dispatch(twice, 0, push());
    commands.submitAndWait();
    expectTimesIndex(6);
}

TEST_F(CommandsTest, AreReusable) {
    const ComputePipeline twice(*device, bindings, test_kernels::double_values());
    for (int run = 0; run < 3; ++run) {
        commands.begin();
        commands.bind(bindings);
        commands.dispatch(twice, groups, push());
        commands.submitAndWait();
    }
    expectTimesIndex(8);
}

TEST_F(CommandsTest, ReadTexels) {
    std::vector<float> texels;
    for (uint32_t i = 0; i < count; ++i)
        for (const uint32_t value : {i, i, 5u, 2 * i}) texels.push_back(float(value));
    table.upload(texels.data(), texels.size() * 4);
    const ComputePipeline gather(*device, bindings, test_kernels::gather_texels());
    commands.begin();
    commands.bind(bindings);
    commands.dispatch(gather, groups, push());
    commands.submitAndWait();
    const std::vector<uint32_t> words = result();
    for (uint32_t i = 0; i < count; ++i) ASSERT_EQ(words[i], 4 * i + 5) << i;
}

TEST_F(CommandsTest, DispatchIndirectReadsWhatAKernelWrote) {
    BindingTable argumentBindings(*device, {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}}, 16);
    const Buffer arguments(*device, 12, Residency::DeviceOnly);
    argumentBindings.set(0, arguments);
    const ComputePipeline write(*device, argumentBindings, test_kernels::write_groups());
    const ComputePipeline twice(*device, bindings, test_kernels::double_values());
    commands.begin();
    commands.bind(argumentBindings);
    commands.dispatch(write, 1, push());
    commands.barrier();
    commands.bind(bindings);
    commands.dispatchIndirect(twice, arguments, 0, push());
    commands.submitAndWait();
    expectTimesIndex(2);
}

TEST_F(CommandsTest, FillAndCopy) {
    const Buffer copy(*device, count * 4, Residency::HostVisible);
    commands.begin();
    commands.fill(values, 400, 400, 7);
    commands.fill(values, 0, 0, 9);
    commands.barrier();
    commands.copy(values, 0, copy, 40, 960);
    commands.submitAndWait();
    std::vector<uint32_t> words(240);
    copy.download(words.data(), 960, 40);
    for (uint32_t i = 0; i < 240; ++i) ASSERT_EQ(words[i], i >= 100 && i < 200 ? 7 : i);
}

TEST_F(CommandsTest, TimestampsAscendAndOutgrowOnePool) {
    if (device->timestampPeriodSeconds() == 0.0) GTEST_SKIP() << "The device has no timestamps.";
    const ComputePipeline twice(*device, bindings, test_kernels::double_values());
    for (const int stamps : {600, 2}) {
        commands.begin();
        commands.bind(bindings);
        for (int i = 0; i < stamps; ++i) {
            commands.timestamp(std::to_string(i));
            commands.dispatch(twice, groups, push());
            commands.barrier();
        }
        commands.submitAndWait();
        const std::vector<Timestamp> times = commands.timestampSeconds();
        ASSERT_EQ(times.size(), size_t(stamps));
        EXPECT_EQ(times.front().seconds, 0.0);
        EXPECT_EQ(times.back().label, std::to_string(stamps - 1));
        EXPECT_GT(times.back().seconds, 0.0);
        EXPECT_LT(times.back().seconds, 60.0);
        for (int i = 1; i < stamps; ++i) EXPECT_GE(times[i].seconds, times[i - 1].seconds);
    }
}

TEST_F(CommandsTest, RefuseWhatDoesNotFit) {
    const ComputePipeline twice(*device, bindings, test_kernels::double_values());
    commands.begin();
    EXPECT_THROW(commands.dispatch(twice, 1, push()), std::logic_error) << "no table is bound";
    commands.bind(bindings);
    const std::byte tooMany[20] = {};
    EXPECT_THROW(commands.dispatch(twice, 1, tooMany), std::logic_error);
    const uint32_t most = commands.maxGroups()[1];
    if (most < UINT32_MAX) {
        EXPECT_THROW(commands.dispatch(twice, 1, push(), most + 1), Error);
    }
    commands.submitAndWait();
}

TEST_F(CommandsTest, BindingsRefuseWhatDoesNotFit) {
    EXPECT_THROW(bindings.set(2, values), std::invalid_argument);
    EXPECT_THROW(bindings.set(1, values), std::invalid_argument) << "binding 1 is a texel buffer";
    EXPECT_THROW(bindings.set(0, values, VK_FORMAT_R32_UINT), std::invalid_argument);
    EXPECT_THROW(bindings.set(0, values, 1, 4), std::invalid_argument) << "not aligned";
    EXPECT_THROW(bindings.set(0, values, 0, count * 4 + 1), std::invalid_argument);
    EXPECT_THROW(BindingTable(*device, {{0, VK_DESCRIPTOR_TYPE_SAMPLER}}, 0), std::invalid_argument);
    EXPECT_THROW(BindingTable(*device, {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}}, 1 << 20), Error);
}

TEST_F(CommandsTest, BindingsReportStorageBeyondTheDevicesRange) {
    const VkDeviceSize range = device->limits().maxStorageBufferRange;
    if (range > (VkDeviceSize(1) << 30)) GTEST_SKIP() << "The device binds " << formatBytes(range) << " at once.";
    const Buffer large(*device, range + 1024, Residency::DeviceOnly);
    EXPECT_THROW(bindings.set(0, large), Error);
    EXPECT_NO_THROW(bindings.set(0, large, 1024, range));
}

TEST_F(CommandsTest, TexelViewReportsMoreTexelsThanAddressable) {
    const VkDeviceSize most = device->limits().maxTexelBufferElements;
    if (most > (VkDeviceSize(1) << 28)) GTEST_SKIP() << "The device addresses " << most << " texels.";
    Buffer large(*device, most * 4 + 16, Residency::DeviceOnly);
    EXPECT_THROW(large.texelView(VK_FORMAT_R32_UINT), Error);
    EXPECT_NO_THROW(large.texelView(VK_FORMAT_R32G32B32A32_SFLOAT));
}

TEST(EmbeddedKernels, AreListed) {
    const std::vector<test_kernels::Kernel> kernels = test_kernels::all();
    ASSERT_EQ(kernels.size(), 3u);
    EXPECT_EQ(kernels[0].name, "double_values");
    for (const test_kernels::Kernel& kernel : kernels) EXPECT_EQ(kernel.spirv[0], 0x07230203u) << kernel.name;
}

}  // namespace
}  // namespace antipode
