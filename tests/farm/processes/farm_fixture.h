// A folder with a scene, and the ways to run servers and clients in it.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderengine/settings.h"
#include "tests/support/process.h"
#include "tests/film/temporary_folder.h"

namespace antipode::test {

class FarmProcesses : public testing::Test {
protected:
    void SetUp() override;

    /// A server whose renderer counts; `behaviour`: honest, liar, black, hanging or failing
    /// (after five iterations).
    ServerProcess countingServer(const std::string& name, double secondsPerIteration = 0.01,
                                 const std::string& behaviour = "honest", const std::vector<std::string>& options = {},
                                 int port = 0);
    /// One that has others render.
    ServerProcess relay(const std::string& name, const std::vector<ServerProcess*>& servers,
                        const std::vector<std::string>& options = {}, int port = 0);
    /// A real one; needs a device.
    ServerProcess realServer(const std::string& name, const std::vector<std::string>& options = {}, int port = 0);

    /// `antipode render scene.textproto` with these options, its statistics to NAME.json and its image to NAME.exr.
    Process client(const std::string& name, const std::vector<std::string>& options);
    nlohmann::json stats(const std::string& name) const;
    /// The client's hash after it has ended with exit code 0 within `seconds`.
    std::string hashOf(const std::string& name, Process& client, double seconds = 60);

    /// What an image of [0, iterations) must hash to on counting servers.
    static std::string countedHash(uint64_t iterations);
    /// What the standalone binary renders with the same options. Skips the test where there is no device.
    std::string standaloneHash(const std::vector<std::string>& options);
    bool hasDevice() const;

    static constexpr uint32_t width = 24, height = 16;
    TemporaryFolder folder;
};

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b);

}  // namespace antipode::test
