// How the server logs: what, and as what.
#pragma once

#include <memory>
#include <string>

namespace spdlog {
class formatter;
}

namespace antipode {

struct LogOptions {
    std::string level = "info";  ///< the least that is logged: info, warning or error
    bool json = false;           ///< lines of JSON instead of text
};

/// Each entry a line of JSON: {"time":"2026-01-31T12:00:00.123Z","level":"info","message":"…"}, with bytes that are no
/// UTF-8 replaced.
std::unique_ptr<spdlog::formatter> jsonLines();

/// Makes spdlog's default logger one on stderr.
void setUpLog(const LogOptions& options);

}  // namespace antipode
