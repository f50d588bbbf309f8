#include <fstream>

#include <gtest/gtest.h>

#include "tests/client/run_client.h"
#include "tests/film/temporary_folder.h"

using antipode::test::ClientRun;
using antipode::test::runClient;
using antipode::test::TemporaryFolder;

namespace {

/// A wrong command line: exit code 2, these words on stderr, nothing on stdout, no file.
void expectUsageError(const std::string& arguments, const std::string& words) {
    const TemporaryFolder folder;
    const ClientRun run = runClient(folder.file("."), arguments);
    EXPECT_EQ(run.exitCode, 2) << arguments << "\n" << run.errors;
    EXPECT_NE(run.errors.find(words), std::string::npos) << arguments << "\n" << run.errors;
    EXPECT_EQ(run.output, "") << arguments;
    EXPECT_TRUE(folder.names().empty()) << arguments;
}

/// A failure that is not the command line's: exit code 1, one line on stderr with these words, no file.
void expectFailure(const std::string& arguments, const std::string& words) {
    const TemporaryFolder folder;
    const ClientRun run = runClient(folder.file("."), arguments);
    EXPECT_EQ(run.exitCode, 1) << arguments << "\n" << run.errors;
    EXPECT_NE(run.errors.find(words), std::string::npos) << arguments << "\n" << run.errors;
    EXPECT_EQ(run.errors.find('\n'), run.errors.size() - 1) << arguments << "\n" << run.errors;
    EXPECT_TRUE(folder.names().empty()) << arguments;
}

}  // namespace

TEST(ClientUsage, CommandsAreSuggested) {
    expectUsageError("", "A command is needed");
    expectUsageError("rendr s.textproto", "Did you mean 'render'?");
    expectUsageError("--help-format troff", "--help-format takes one of man, bash, zsh, not 'troff'.");
    expectUsageError("xyzzy", "the commands are render, explain, devices, compare, study, tonemap.");
}

TEST(ClientUsage, UnknownOptionsAreSuggested) {
    expectUsageError("render s.textproto --widht 5", "'--widht'. Did you mean '--width'?");
    expectUsageError("render --widht 5 s.textproto", "'--widht'. Did you mean '--width'?");
    expectUsageError("render --iteration=5 s.textproto", "'--iteration'. Did you mean '--iterations'?");
    expectUsageError("render --widht", "Did you mean '--width'?");
    expectUsageError("render s.textproto --hlep", "Did you mean '--help'?");
    expectUsageError("devices --jsn", "Did you mean '--json'?");
    expectUsageError("compare a.exr b.exr --frobnicate", "no option '--frobnicate'.\n");
}

TEST(ClientUsage, UnknownTechniquesAreSuggested) {
    expectUsageError("render s.textproto --technique vcn", "Did you mean 'vcm'?");
    expectUsageError("render s.textproto --technique path-tracing", "takes one of vcm, ");
}

TEST(ClientUsage, UnknownPrecisionsAreSuggested) {
    expectUsageError("render s.textproto --precision doble",
                     "--precision takes one of float, double, not 'doble'. Did you mean 'double'?");
    expectUsageError("render s.textproto --precision half", "takes one of float, double, not 'half'.\n");
    expectUsageError("render s.textproto --precision ''", "takes one of float, double, not ''.");
}

TEST(ClientUsage, ArgumentsAreCounted) {
    expectUsageError("render", "needs the argument SCENE");
    expectUsageError("render a.json b.json", "no use for the argument 'b.json'");
    expectUsageError("compare a.exr", "needs the argument B.exr");
    expectUsageError("devices x", "no use for the argument 'x'");
    expectUsageError("render ''", "does not name a file");
}

TEST(ClientUsage, NumbersAreCheckedInFull) {
    expectUsageError("render s.textproto --width 0", "--width takes a whole number from 1 to 65536, not '0'");
    expectUsageError("render s.textproto --width -5", "not '-5'");
    expectUsageError("render s.textproto --width 5px", "not '5px'");
    expectUsageError("render s.textproto --width 0x10", "not '0x10'");
    expectUsageError("render s.textproto --width 4294967297", "not '4294967297'");
    expectUsageError("render s.textproto --seed 18446744073709551616", "not '18446744073709551616'");
    expectUsageError("render s.textproto --iterations 0", "--iterations takes");
    expectUsageError("render s.textproto --iterations 1.5", "not '1.5'");
    expectUsageError("render s.textproto --seed ''", "not ''");
    expectUsageError("render s.textproto --time 0", "--time takes a number above 0, not '0'");
    expectUsageError("render s.textproto --time nan", "not 'nan'");
    expectUsageError("render s.textproto --time inf", "not 'inf'");
    expectUsageError("render s.textproto --alpha 1.01", "--alpha takes a number above 0 and up to 1, not '1.01'");
    expectUsageError("render s.textproto --radius-factor 0", "--radius-factor takes");
    expectUsageError("render s.textproto --max-path-length 0", "--max-path-length takes");
    expectUsageError("render s.textproto --max-path-length 65536", "takes a whole number from 1 to 65535, not '65536'");
    expectUsageError("render s.textproto --light-paths few", "--light-paths takes");
    expectUsageError("render s.textproto --light-paths 300000000", "takes a whole number from 0 to 268435456, not");
    expectUsageError("render s.textproto --connections x", "--connections takes");
    expectUsageError("render s.textproto --connections 17",
                     "--connections takes a whole number from 1 to 16, not '17'");
    for (const char* part : {"", "1,2,3", "1,2,3,4,5", "1,2,3,x", "-1,0,3,4", "1 ,2,3,4"})
        expectUsageError("render s.textproto --crop '" + std::string(part) + "'",
                         "--crop takes four whole numbers X0,Y0,X1,Y1, not '" + std::string(part) + "'");
    expectUsageError("render s.textproto --width", "--width");
    expectUsageError("render s.textproto --width 5 --width 6", "--width");
    expectUsageError("render s.textproto --quiet=no", "quiet");
}

TEST(ClientUsage, OptionsMustFitTogether) {
    expectUsageError("render s.textproto --wait 5", "--wait goes with --server or --servers-file.");
    expectUsageError("render s.textproto --server 127.0.0.1:1 --wait 0", "--wait takes a number above 0, not '0'");
    expectUsageError("render s.textproto -o picture.png", "ends in .exr, not 'picture.png'");
    expectUsageError("render s.textproto --stats s.exr", "would overwrite the image 's.exr'");
    expectUsageError("render s.textproto --stats s.png", "would overwrite the image 's.png'");
}

TEST(ClientUsage, UnwritableOutputsFailBeforeTheSceneIsRead) {
    expectFailure("render s.textproto -o missing/a.exr", "'missing/a.exr': No such file or directory");
    expectFailure("render s.textproto --stats missing/a.json", "'missing/a.json'");
}

TEST(ClientUsage, UnreadableScenesLeaveNothingBehind) {
    expectFailure("render missing.json", "missing.json");
    expectFailure("render missing.glb --stats stats.json", "missing.glb");
    const TemporaryFolder folder;
    std::ofstream(folder.file("broken.glb")) << "no scene";
    const ClientRun run = runClient(folder.file("."), "render broken.glb");
    EXPECT_EQ(run.exitCode, 1) << run.errors;
    EXPECT_NE(run.errors.find("broken.glb"), std::string::npos) << run.errors;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"broken.glb"});
}

TEST(ClientUsage, HelpShowsDefaultsAndUnits) {
    const TemporaryFolder folder;
    const ClientRun render = runClient(folder.file("."), "render --help");
    EXPECT_EQ(render.exitCode, 0);
    EXPECT_EQ(render.errors, "");
    for (const char* text : {"--width PIXELS", "--time SECONDS", "--max-path-length EDGES",
                             "[default: 64, unlimited with --time or --target-error]", "[default: vcm]",
                             "--precision NAME", "[default: float]", "[default: 0.666667]", "Techniques:"})
        EXPECT_NE(render.output.find(text), std::string::npos) << text << "\n" << render.output;
    for (const char* arguments : {"--help", "devices -h", "compare --help", "--version"}) {
        const ClientRun run = runClient(folder.file("."), arguments);
        EXPECT_EQ(run.exitCode, 0) << arguments;
        EXPECT_NE(run.output.find("antipode"), std::string::npos) << run.output;
    }
}

TEST(ClientUsage, TheEnvironmentStandsInForOptions) {
    const TemporaryFolder folder;
    const auto complaint = [&](const std::string& arguments, const std::string& environment) {
        const ClientRun run = runClient(folder.file("."), arguments, environment);
        EXPECT_EQ(run.exitCode, 2) << run.errors;
        return run.errors;
    };
    EXPECT_EQ(complaint("render s.textproto", "ANTIPODE_RENDER_WIDTH=none"),
              "antipode: ANTIPODE_RENDER_WIDTH takes a whole number from 1 to 65536, not 'none'.\n");
    EXPECT_EQ(
        complaint("render s.textproto", "ANTIPODE_RENDER_VERIFY=.5"),
        "antipode: --verify goes with --server or --servers-file. (From the environment: ANTIPODE_RENDER_VERIFY.)\n");
    EXPECT_EQ(complaint("render s.textproto --width 0", "ANTIPODE_RENDER_WIDTH=5"),
              "antipode: --width takes a whole number from 1 to 65536, not '0'.\n");
}

TEST(ClientUsage, OthersSeeARenderWithATokenOnly) {
    expectUsageError("render s.textproto --view 0.0.0.0:0",
                     "--view 0.0.0.0:0 can be reached by others: add --view-token FILE; only loopback goes without.");
    expectUsageError("render s.textproto --view '[::]:0'", "can be reached by others");
    expectUsageError("render s.textproto --view-token t", "--view-token goes with --view.");
    expectUsageError("render s.textproto --view 127.0.0.1:x", "a port is a number from 0 to 65535");
    expectFailure("render s.textproto --view 0.0.0.0:0 --view-token no/such/file", "no/such/file");
}

TEST(ClientUsage, AViewsTokenIsStrongAndFitsIntoAnAddress) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& token, const std::string& words) {
        std::ofstream(folder.file("token")) << token;
        const ClientRun run = runClient(folder.file("."), "render s.textproto --view 0 --view-token token",
                                        "umask 077; chmod 600 token;");
        EXPECT_EQ(run.exitCode, 1) << run.errors;
        EXPECT_NE(run.errors.find(words), std::string::npos) << run.errors;
    };
    refused("short", "at least 16 bytes");
    refused("0000000000000000", "easy to guess");
    refused("9f2c7be1538d4a60 c1e7f0b3", "a token has to fit into an address");
}
