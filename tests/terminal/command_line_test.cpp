#include "terminal/command_line.h"

#include <gtest/gtest.h>

#include "renderengine/error.h"
#include "tests/terminal/variable.h"

using namespace antipode;
using antipode::test::Variable;

namespace {

/// What `antipode paint` is asked for.
struct Paint {
    std::string canvas;
    uint64_t strokeCount = 1;
    std::string style = "oil";
    std::vector<std::string> colours;
    bool wet = false, version = false;
    std::optional<std::string> easel;

    std::vector<OptionRow> rows() {
        return {
            {"CANVAS", "", "what to paint on", "", assignText(canvas)},
            {"-n,--stroke-count", "COUNT", "strokes", "1", assignWhole(strokeCount, 1, 9)},
            {"--style", "NAME", "how", style, assignText(style), false, {"oil", "chalk"}},
            {"--colours", "LIST", "with what", "", assignText(colours), true, {"red", "blue"}},
            {"--wet", "", "do not wait", "", assignFlag(wet, true)},
            {"--easel", "FILE", "a stand", "none", assignText(easel)},
            {"--version", "", "print the version", "", assignFlag(version, true), false, {}, true},
        };
    }
    bool parse(std::vector<std::string> arguments, const std::function<void()>& makeConsistent = {}) {
        arguments.insert(arguments.begin(), "linen");
        return parseCommandLine("antipode paint", "Paints.", rows(), arguments, "", makeConsistent);
    }
};

std::string complaintOf(const std::vector<std::string>& arguments, const std::function<void()>& makeConsistent = {}) {
    try {
        Paint().parse(arguments, makeConsistent);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
        return error.what();
    }
    return "none";
}

}  // namespace

TEST(Environment, NamesVariablesByCommandAndOption) {
    EXPECT_EQ(variableName("antipode paint", "--stroke-count"), "ANTIPODE_PAINT_STROKE_COUNT");
    EXPECT_EQ(variableName("antipode-server", "--wet"), "ANTIPODE_SERVER_WET");
}

TEST(Environment, FillsWhatTheCommandLineLeavesOpen) {
    const Variable count("ANTIPODE_PAINT_STROKE_COUNT", "7"), easel("ANTIPODE_PAINT_EASEL", "oak");
    const Variable style("ANTIPODE_PAINT_STYLE", "chalk"), other("ANTIPODE_SCULPT_STYLE", "marble");
    Paint paint;
    ASSERT_TRUE(paint.parse({"--style", "oil"}));
    EXPECT_EQ(paint.strokeCount, 7u);
    EXPECT_EQ(paint.easel, "oak");
    EXPECT_EQ(paint.style, "oil") << "the command line wins";
    EXPECT_EQ(paint.canvas, "linen");
}

TEST(Environment, AnEmptyVariableIsNone) {
    const Variable count("ANTIPODE_PAINT_STROKE_COUNT", ""), wet("ANTIPODE_PAINT_WET", "");
    Paint paint;
    ASSERT_TRUE(paint.parse({}));
    EXPECT_EQ(paint.strokeCount, 1u);
    EXPECT_FALSE(paint.wet);
}

TEST(Environment, FlagsAreOneOrZero) {
    const auto wetness = [](const std::string& value) {
        const Variable wet("ANTIPODE_PAINT_WET", value);
        Paint paint;
        paint.parse({});
        return paint.wet;
    };
    EXPECT_TRUE(wetness("1"));
    EXPECT_FALSE(wetness("0"));
    const Variable wet("ANTIPODE_PAINT_WET", "soaking");
    EXPECT_EQ(complaintOf({}), "ANTIPODE_PAINT_WET takes 1 or 0, not 'soaking'.");
    EXPECT_EQ(complaintOf({"--wet"}), "none") << "the command line wins";
}

TEST(Environment, PartsWhatMayBeGivenSeveralTimesBySemicolons) {
    const Variable colours("ANTIPODE_PAINT_COLOURS", "red;blue,red");
    Paint paint;
    ASSERT_TRUE(paint.parse({}));
    EXPECT_EQ(paint.colours, (std::vector<std::string>{"red", "blue,red"}));
    Paint other;
    ASSERT_TRUE(other.parse({"--colours", "blue"}));
    EXPECT_EQ(other.colours, std::vector<std::string>{"blue"}) << "the command line replaces all of them";
}

TEST(Environment, ErrorsNameTheVariable) {
    {
        const Variable count("ANTIPODE_PAINT_STROKE_COUNT", "10");
        EXPECT_EQ(complaintOf({}), "ANTIPODE_PAINT_STROKE_COUNT takes a whole number from 1 to 9, not '10'.");
        EXPECT_EQ(complaintOf({"-n", "11"}), "--stroke-count takes a whole number from 1 to 9, not '11'.");
    }
    const Variable style("ANTIPODE_PAINT_STYLE", "oli");
    EXPECT_EQ(complaintOf({}), "ANTIPODE_PAINT_STYLE takes one of oil, chalk, not 'oli'. Did you mean 'oil'?");
}

TEST(Environment, WhatDoesNotFitTogetherNamesTheVariablesButNotTheirValues) {
    const auto refuse = [] { throw Error(ErrorCode::Usage, "--wet needs --easel."); };
    EXPECT_EQ(complaintOf({"--wet"}, refuse), "--wet needs --easel.");
    const Variable wet("ANTIPODE_PAINT_WET", "1"), count("ANTIPODE_PAINT_STROKE_COUNT", "5");
    EXPECT_EQ(complaintOf({}, refuse),
              "--wet needs --easel. (From the environment: ANTIPODE_PAINT_STROKE_COUNT, ANTIPODE_PAINT_WET.)");
}

TEST(Environment, HasNoVariableForWhatEndsTheProgramAndForArguments) {
    const Variable version("ANTIPODE_PAINT_VERSION", "1"), canvas("ANTIPODE_PAINT_CANVAS", "silk");
    Paint paint;
    ASSERT_TRUE(paint.parse({}));
    EXPECT_FALSE(paint.version);
    EXPECT_EQ(paint.canvas, "linen");
}

TEST(Environment, IsInTheHelp) {
    testing::internal::CaptureStdout();
    EXPECT_FALSE(Paint().parse({"--help"}));
    const std::string help = testing::internal::GetCapturedStdout();
    EXPECT_NE(help.find("--stroke-count as ANTIPODE_PAINT_STROKE_COUNT"), std::string::npos) << help;
    EXPECT_NE(help.find("The command line wins."), std::string::npos) << help;
}

TEST(CommandLine, TakesOnlyTheChoicesThereAre) {
    EXPECT_EQ(complaintOf({"--style", "chalk"}), "none");
    EXPECT_EQ(complaintOf({"--style", "chlak"}), "--style takes one of oil, chalk, not 'chlak'. Did you mean 'chalk'?");
    EXPECT_EQ(complaintOf({"--style", "oil,chalk"}), "--style takes one of oil, chalk, not 'oil,chalk'.");
    EXPECT_EQ(complaintOf({"--colours", "red,blue"}), "none") << "of a list any number";
    EXPECT_EQ(complaintOf({"--colours", "red,pink"}), "--colours takes one of red, blue, not 'pink'.");
    EXPECT_EQ(complaintOf({"--colours", ""}), "--colours takes one of red, blue, not ''.");
}
