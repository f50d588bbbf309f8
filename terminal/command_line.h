// Command lines from binding tables: one row per option is parser, help, default and variable of the environment at
// once.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace antipode {

/// Takes the option's name, for messages, and its value as typed ("" for a flag). Throws Error(Usage).
using AssignValue = std::function<void(const std::string& option, const std::string& value)>;

struct OptionRow {
    std::string names;      ///< "-o,--output" for an option, "SCENE" for a required argument
    std::string valueName;  ///< what the help shows for the value, with its unit; empty for a flag
    std::string help;
    std::string defaultText;  ///< what holds without the option; empty where that needs no words
    AssignValue assign;
    bool repeatable = false;  ///< may be given more than once; `assign` is called for each
    /// Which values there are, where not each of its kind is one; of a LIST, parted by commas, any number.
    std::vector<std::string> choices = {};
    bool action = false;  ///< is done instead of the program's work, as --version: no variable stands for it
};

/// The variable that stands for an option: ("antipode render", "--light-paths") is ANTIPODE_RENDER_LIGHT_PATHS. Named
/// by the command, so that what one needs is no news to another.
std::string variableName(const std::string& program, const std::string& option);

/// Parses the arguments that follow the command's name ("antipode render", as the help shows it); what they leave open
/// is taken from the environment, where a variable that is empty is none. False where --help was asked for and has been
/// printed, with `footer` below the options. Throws Error(Usage), with the nearest name where an option is unknown.
/// `makeConsistent` looks at all values together; where it throws Error(Usage), the variables are named, too.
bool parseCommandLine(const std::string& program, const std::string& description, const std::vector<OptionRow>& rows,
                      const std::vector<std::string>& arguments, const std::string& footer = "",
                      const std::function<void()>& makeConsistent = {});

AssignValue assignText(std::string& target);
AssignValue assignText(std::optional<std::string>& target);
/// Appends; for repeatable options.
AssignValue assignText(std::vector<std::string>& target);
/// Sets `target` to `value` where the flag is given.
AssignValue assignFlag(bool& target, bool value);
/// Accepts whole numbers from `atLeast` to `atMost`.
template <class Target>
AssignValue assignWhole(Target& target, uint64_t atLeast, uint64_t atMost);
/// Accepts finite numbers in (moreThan, atMost].
template <class Target>
AssignValue assignReal(Target& target, double moreThan, double atMost = std::numeric_limits<double>::max());

/// Accepts sizes in bytes: whole numbers, with K, M, G or T for powers of 1024.
AssignValue assignBytes(uint64_t& target);

/// A decimal number without sign in [atLeast, atMost]. Throws Error(Usage) that names the option.
uint64_t parseWhole(const std::string& option, const std::string& value, uint64_t atLeast, uint64_t atMost);
/// A finite decimal number in (moreThan, atMost]. Throws Error(Usage) that names the option.
double parseReal(const std::string& option, const std::string& value, double moreThan, double atMost);

template <class Target>
AssignValue assignWhole(Target& target, uint64_t atLeast, uint64_t atMost) {
    return [&target, atLeast, atMost](const std::string& option, const std::string& value) {
        const uint64_t number = parseWhole(option, value, atLeast, atMost);
        if constexpr (requires { typename Target::value_type; })
            target = typename Target::value_type(number);
        else
            target = Target(number);
    };
}

template <class Target>
AssignValue assignReal(Target& target, double moreThan, double atMost) {
    return [&target, moreThan, atMost](const std::string& option, const std::string& value) {
        target = parseReal(option, value, moreThan, atMost);
    };
}

}  // namespace antipode
