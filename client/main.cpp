// antipode: renders scenes, lists devices, compares, shows and studies images.
#include <cstdio>
#include <iostream>
#include <sstream>

#include <google/protobuf/stubs/logging.h>

#include "client/commands.h"
#include "renderengine/version.h"
#include "terminal/manual.h"
#include "terminal/program.h"
#include "renderengine/io/suggest.h"
#include "renderengine/error.h"

namespace {

using namespace antipode;

struct Command {
    const char* name;
    const char* summary;
    void (*run)(const std::vector<std::string>& arguments);
};

constexpr Command commands[] = {
    {"render", "render a scene to an OpenEXR image and a PNG", renderCommand},
    {"explain", "tell what a scene has, what is simulated and what it costs", explainCommand},
    {"devices", "list the devices of this machine", devicesCommand},
    {"compare", "measure an image against a reference", compareCommand},
    {"study", "measure what accuracy costs in time", studyCommand},
    {"tonemap", "show an OpenEXR image as a PNG", tonemapCommand},
};

void printHelp(std::ostream& out) {
    out << "Usage: antipode COMMAND [OPTIONS]\n\n";
    for (const Command& command : commands) out << "  antipode " << command.name << "\t" << command.summary << "\n";
    out << "\n'antipode COMMAND --help' lists a command's options, 'antipode --version' prints the version.\n"
           "Exit codes: 0 done, 1 an input, output or device failed, 2 the command line is wrong.\n";
}

/// Runs all commands and returns what they print.
std::string printedByAll(const std::vector<std::string>& arguments) {
    std::ostringstream printed;
    struct Redirection {
        std::streambuf* const standard;
        ~Redirection() { std::cout.rdbuf(standard); }
    } const redirection{std::cout.rdbuf(printed.rdbuf())};
    for (const Command& command : commands) command.run(arguments);
    return printed.str();
}

void printManual(const std::string& format) {
    std::vector<CommandSummary> summaries;
    for (const Command& command : commands) summaries.emplace_back(command.name, command.summary);
    std::cout << manualOf("antipode", "Renders light that takes difficult paths.", summaries,
                          format == "man" ? "" : printedByAll({helpFormatOption, format}), format);
}

void run(const std::vector<std::string>& arguments) {
    if (arguments.empty()) {
        printHelp(std::cerr);
        throw Error(ErrorCode::Usage, "A command is needed.");
    }
    const std::string& name = arguments.front();
    if (name == "--help" || name == "-h") return printHelp(std::cout);
    if (name == "--version") {
        std::cout << "antipode " << versionText << std::endl;
        return;
    }
    if (name == helpFormatOption && arguments.size() == 2) return printManual(arguments[1]);
    std::vector<std::string> names;
    for (const Command& command : commands) {
        if (name == command.name) return command.run({arguments.begin() + 1, arguments.end()});
        names.push_back(command.name);
    }
    throw Error(ErrorCode::Usage, "There is no command '" + name + "'; the commands are " + joined(names) + "." +
                                      suggestion(name, names));
}

/// Standard output can be a full disk or a closed pipe.
void requireOutputWritten() {
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout))
        throw Error(ErrorCode::Output, "Standard output cannot be written.");
}

}  // namespace

int main(int argc, char** argv) {
    google::protobuf::SetLogHandler(nullptr);  // it complains of peers' bad texts on stderr; we do, where it matters
    return antipode::runProgram("antipode", [&] {
        run({argv + 1, argv + argc});
        requireOutputWritten();
    });
}
