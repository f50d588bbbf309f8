#include "vulkan/selection.h"

#include "renderengine/error.h"

#include <gtest/gtest.h>

namespace antipode {
namespace {

DeviceInfo device(uint32_t index, const std::string& kind, const std::string& uuid, uint64_t memoryBytes) {
    DeviceInfo info;
    info.index = index;
    info.name = kind + " " + std::to_string(index);
    info.kind = kind;
    info.uuid = uuid;
    info.memoryBytes = memoryBytes;
    info.usable = true;
    return info;
}

std::vector<DeviceInfo> fourDevices() {
    std::vector<DeviceInfo> devices = {
        device(0, "CPU", "6d657361000000000000000000000000", 64u << 20),
        device(1, "discrete GPU", "abcd0000000000000000000000000001", 8u << 20),
        device(2, "integrated GPU", "12340000000000000000000000000000", 32u << 20),
        device(3, "discrete GPU", "abcd0000000000000000000000000002", 16u << 20),
    };
    devices[1].pciId = "0000:01:00.0";
    devices[3].pciId = "0000:0a:00.0";
    sortByRank(devices);
    return devices;
}

template <class Function>
ErrorCode codeOf(Function function) {
    try {
        function();
    } catch (const Error& error) {
        return error.code();
    }
    ADD_FAILURE() << "no error";
    return ErrorCode::Output;
}

TEST(Selection, RanksByKindThenMemory) {
    std::vector<uint32_t> order;
    for (const DeviceInfo& info : fourDevices()) order.push_back(info.index);
    EXPECT_EQ(order, (std::vector<uint32_t>{3, 1, 2, 0}));
}

TEST(Selection, RanksUnusableLast) {
    std::vector<DeviceInfo> devices = fourDevices();
    devices[0].usable = false;
    sortByRank(devices);
    EXPECT_EQ(devices.front().index, 1u);
    EXPECT_EQ(devices.back().index, 3u);
}

TEST(Selection, FindsByIndexPciAndUuid) {
    const auto devices = fourDevices();
    EXPECT_EQ(chooseDevice(devices, "").index, 3u);
    EXPECT_EQ(chooseDevice(devices, "0").index, 0u);
    EXPECT_EQ(chooseDevice(devices, "0000:0A:00.0").index, 3u);
    EXPECT_EQ(chooseDevice(devices, "0a:00.0").index, 3u) << "as lspci tells it";
    EXPECT_EQ(chooseDevice(devices, "00000000:0A:00.0").index, 3u) << "as nvidia-smi tells it";
    EXPECT_EQ(chooseDevice(devices, "GPU-abcd0000-0000-0000-0000-000000000001").index, 1u) << "as nvidia-smi tells it";
    EXPECT_EQ(chooseDevice(devices, "6D65").index, 0u);
    EXPECT_EQ(chooseDevice(devices, "1234").index, 2u) << "four digits are a UUID's beginning, not an index";
    EXPECT_EQ(chooseDevice(devices, "abcd0000-0000-0000-0000-000000000001").index, 1u);
}

TEST(Selection, RefusesWhatIsMissingOrAmbiguous) {
    const auto devices = fourDevices();
    for (const char* selector : {"4", "999", "abcd", "abc", "ffff", "0000:02:00.0", "0001:0a:00.0", "0000:0a:00.1",
                                 "0000:0a:00.0x", ":", "llvmpipe", "-1"})
        EXPECT_EQ(codeOf([&] { chooseDevice(devices, selector); }), ErrorCode::Usage) << selector;
}

TEST(Selection, RefusesWhatIsNotUsable) {
    std::vector<DeviceInfo> devices = fourDevices();
    for (DeviceInfo& info : devices) info.usable = false;
    EXPECT_EQ(codeOf([&] { chooseDevice(devices, ""); }), ErrorCode::Device);
    EXPECT_EQ(codeOf([&] { chooseDevice(devices, "2"); }), ErrorCode::Device);
    EXPECT_EQ(codeOf([] { chooseDevice({}, ""); }), ErrorCode::Device);
    EXPECT_EQ(codeOf([] { chooseDevice({}, "0"); }), ErrorCode::Usage);
}

}  // namespace
}  // namespace antipode
