#include "tests/client/run_client.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <sys/wait.h>

#include "tests/film/temporary_folder.h"

namespace antipode::test {
namespace {

std::string contentOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

ClientRun runClient(const std::string& folder, const std::string& arguments, const std::string& environment) {
    const TemporaryFolder streams;
    const std::string command = "cd '" + folder + "' || exit 127; " + environment + " '" ANTIPODE_BINARY "' " +
                                arguments + " >'" + streams.file("out") + "' 2>'" + streams.file("err") + "'";
    const int status = std::system(command.c_str());
    if (status == -1) throw std::runtime_error("Cannot start a shell.");
    const int exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return {exitCode, contentOf(streams.file("out")), contentOf(streams.file("err"))};
}

}  // namespace antipode::test
