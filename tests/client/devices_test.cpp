#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/client/run_client.h"
#include "tests/film/temporary_folder.h"

using antipode::test::ClientRun;
using antipode::test::runClient;
using antipode::test::TemporaryFolder;

TEST(ClientDevices, JsonAndTextListTheSameDevices) {
    const TemporaryFolder folder;
    const ClientRun json = runClient(folder.file("."), "devices --json"), text = runClient(folder.file("."), "devices");
    EXPECT_EQ(json.exitCode, text.exitCode);
    const auto devices = nlohmann::json::parse(json.output);
    if (devices.empty()) GTEST_SKIP() << "This machine has no Vulkan device.";
    for (const auto& device : devices) {
        EXPECT_EQ(device["uuid"].get<std::string>().size(), 32u);
        EXPECT_NE(device["usable"].get<bool>(), !device["reason"].get<std::string>().empty());
        EXPECT_NE(text.output.find(device["name"].get<std::string>()), std::string::npos);
        EXPECT_NE(text.output.find(device["uuid"].get<std::string>()), std::string::npos);
    }
}

TEST(ClientDevices, WithoutADriverTheExitCodeSaysSo) {
    const TemporaryFolder folder;
    // Both names: older loaders know only the first.
    const std::string noDriver = "VK_ICD_FILENAMES=/nonexistent.json VK_DRIVER_FILES=/nonexistent.json";
    const ClientRun run = runClient(folder.file("."), "devices", noDriver);
    EXPECT_EQ(run.exitCode, 1) << run.output;
    EXPECT_EQ(run.output, "");
    EXPECT_NE(run.errors.find("Vulkan driver"), std::string::npos) << run.errors;
}
