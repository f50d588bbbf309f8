#include "farm/nodes/servers_file.h"

#include <sstream>

#include "renderengine/error.h"
#include "renderengine/io/files.h"

namespace antipode {
namespace {

std::vector<wire::Endpoint> parse(const std::string& path, const std::string& content) {
    std::vector<wire::Endpoint> servers;
    std::istringstream lines(content);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        line.erase(std::min(line.find('#'), line.size()));
        std::istringstream words(line);
        std::string address, rest;
        if (!(words >> address)) continue;
        const std::string where = path + ":" + std::to_string(number);
        if (words >> rest) throw Error(ErrorCode::Input, where + ": one HOST:PORT a line, not '" + line + "'.");
        try {
            servers.push_back(wire::parseEndpoint(where, address));
        } catch (const Error& error) {
            throw Error(ErrorCode::Input, error.what());
        }
    }
    return servers;
}

std::string contentOf(const std::string& path) {
    const std::vector<uint8_t> bytes = readFileBytes(path);
    return {bytes.begin(), bytes.end()};
}

}  // namespace

ServersFile::ServersFile(std::string path)
    : path_(std::move(path)), content_(contentOf(path_)), servers_(parse(path_, content_)) {}

bool ServersFile::reread(std::string& problem) {
    try {
        std::string content = contentOf(path_);
        const bool changed = content != content_;
        if (changed) servers_ = parse(path_, content);
        content_ = std::move(content);
        lastProblem_.clear();
        return changed;
    } catch (const Error& error) {
        if (lastProblem_ != error.what()) problem = error.what();
        lastProblem_ = error.what();
        return false;
    }
}

}  // namespace antipode
