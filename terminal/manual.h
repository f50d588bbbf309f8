// What a binding table tells besides its command line: a page of the manual, and what a shell may complete.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "terminal/command_line.h"

namespace antipode {

struct CommandManual {
    std::string program;  ///< "antipode render"
    std::string description;
    std::vector<OptionRow> rows;
    std::string footer;  ///< of the help
};

/// A name and what it does.
using CommandSummary = std::pair<std::string, std::string>;

/// The option, not shown in the help, that prints the following: "--help-format man".
inline constexpr const char* helpFormatOption = "--help-format";
std::vector<std::string> helpFormats();

/// `format`: "man" (a page for man(1)), "bash" or "zsh" (a function that completes the command; with what registers it
/// where the command is a program). Throws Error(Usage) for others.
std::string manualOf(const CommandManual& command, const std::string& format);

/// The same for a program that consists of commands; `functions`: those of its commands, for "bash" and "zsh".
std::string manualOf(const std::string& program, const std::string& description,
                     const std::vector<CommandSummary>& commands, const std::string& functions,
                     const std::string& format);

}  // namespace antipode
