#include "server/log.h"

#include <cstdio>
#include <ctime>

#include <nlohmann/json.hpp>
#include <spdlog/formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace antipode {
namespace {

/// spdlog's patterns escape nothing.
class JsonLines : public spdlog::formatter {
public:
    void format(const spdlog::details::log_msg& entry, spdlog::memory_buf_t& out) override {
        const spdlog::string_view_t level = spdlog::level::to_string_view(entry.level);
        const nlohmann::ordered_json line{{"time", utc(entry.time)},
                                          {"level", std::string(level.data(), level.size())},
                                          {"message", std::string(entry.payload.data(), entry.payload.size())}};
        const std::string text = line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
        out.append(text.data(), text.data() + text.size());
    }
    std::unique_ptr<spdlog::formatter> clone() const override { return std::make_unique<JsonLines>(); }

private:
    static std::string utc(spdlog::log_clock::time_point time) {
        const auto milliseconds =
            std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
        const std::time_t seconds = milliseconds / 1000;
        std::tm parts{};
        ::gmtime_r(&seconds, &parts);
        char date[32], text[40];
        std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%S", &parts);
        std::snprintf(text, sizeof text, "%s.%03dZ", date, int(milliseconds % 1000));
        return text;
    }
};

}  // namespace

std::unique_ptr<spdlog::formatter> jsonLines() { return std::make_unique<JsonLines>(); }

void setUpLog(const LogOptions& options) {
    spdlog::set_default_logger(spdlog::stderr_color_mt("antipode-server"));
    if (options.json)
        spdlog::set_formatter(jsonLines());
    else
        spdlog::set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %^%l%$ %v");
    spdlog::set_level(spdlog::level::from_str(options.level));
}

}  // namespace antipode
