#include "server/log.h"

#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spdlog/logger.h>
#include <spdlog/sinks/ostream_sink.h>

using namespace antipode;

namespace {

/// What is written of these messages, all warnings.
std::vector<nlohmann::json> linesOf(const std::vector<std::string>& messages) {
    std::ostringstream written;
    spdlog::logger logger("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(written));
    logger.set_formatter(jsonLines());
    for (const std::string& message : messages) logger.warn("{}", message);
    std::vector<nlohmann::json> lines;
    std::istringstream read(written.str());
    for (std::string line; std::getline(read, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
}

}  // namespace

TEST(JsonLog, IsAnObjectALineWhateverAMessageHolds) {
    const std::vector<std::string> messages{"plain", "say \"no\" to C:\\", "two\nlines\tand a bell\a", "größer {}", ""};
    const std::vector<nlohmann::json> lines = linesOf(messages);
    ASSERT_EQ(lines.size(), messages.size());
    for (size_t i = 0; i < lines.size(); ++i) {
        EXPECT_EQ(lines[i].at("message"), messages[i]);
        EXPECT_EQ(lines[i].at("level"), "warning");
        EXPECT_EQ(lines[i].size(), 3u);
        const std::string time = lines[i].at("time");
        EXPECT_EQ(time.size(), std::string("2026-01-31T12:00:00.123Z").size()) << time;
    }
}

TEST(JsonLog, ReplacesWhatIsNoText) {
    const std::vector<nlohmann::json> lines = linesOf({"a\xffz"});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].at("message"), "a\xef\xbf\xbdz");
}
