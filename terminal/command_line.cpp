#include "terminal/command_line.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <sstream>

#include <CLI/CLI.hpp>

#include "renderengine/io/suggest.h"
#include "renderengine/error.h"
#include "terminal/manual.h"

namespace antipode {
namespace {

bool isPositional(const OptionRow& row) { return row.names.front() != '-'; }

/// The row's option as messages name it: the long name of several.
std::string displayName(const OptionRow& row) { return row.names.substr(row.names.rfind(',') + 1); }

[[noreturn]] void failUsage(const std::string& message) { throw Error(ErrorCode::Usage, message); }

CLI::Option* addOption(CLI::App& app, const OptionRow& row) {
    const std::string help = row.help + (row.defaultText.empty() ? "" : " [default: " + row.defaultText + "]");
    if (row.valueName.empty() && !isPositional(row)) return app.add_flag(row.names, help)->disable_flag_override();
    CLI::Option* option = app.add_option(row.names, help);
    if (row.repeatable)
        option->expected(isPositional(row) ? -1 : 1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    return isPositional(row) ? option->type_name("")->required() : option->type_name(row.valueName);
}

/// Complains about the first argument that no row takes; an unknown option rather than a stray word, since the word is
/// likely its value.
void rejectUnknown(const std::string& command, const std::vector<OptionRow>& rows,
                   const std::vector<std::string>& unknown) {
    for (const std::string& argument : unknown) {
        if (argument.front() != '-') continue;
        std::vector<std::string> known{"--help"};
        for (const OptionRow& row : rows)
            if (!isPositional(row)) known.push_back(displayName(row));
        const std::string name = argument.substr(0, argument.find('='));
        failUsage("'" + command + "' has no option '" + name + "'." + suggestion(name, known));
    }
    if (!unknown.empty()) failUsage("'" + command + "' has no use for the argument '" + unknown.front() + "'.");
}

std::vector<std::string> parted(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text + separator);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

void requireChoice(const OptionRow& row, const std::string& option, const std::string& value) {
    const std::vector<std::string>& choices = row.choices;
    if (choices.empty()) return;
    for (const std::string& name : row.valueName == "LIST" ? parted(value, ',') : std::vector<std::string>{value})
        if (std::find(choices.begin(), choices.end(), name) == choices.end())
            failUsage(option + " takes one of " + joined(choices) + ", not '" + name + "'." +
                      suggestion(name, choices));
}

/// Whether the option can be given by a variable.
bool hasVariable(const OptionRow& row) { return !isPositional(row) && !row.action; }

/// What the environment says of the row's option, as the command line would have it: nothing for a flag that is off.
std::vector<std::string> valuesOfVariable(const OptionRow& row, const std::string& variable) {
    const char* text = std::getenv(variable.c_str());
    if (!text || !*text) return {};
    const std::string value = text;
    if (row.valueName.empty()) {
        if (value != "0" && value != "1") failUsage(variable + " takes 1 or 0, not '" + value + "'.");
        return value == "1" ? std::vector<std::string>{""} : std::vector<std::string>{};
    }
    return row.repeatable ? parted(value, ';') : std::vector<std::string>{value};
}

std::string helpOnVariables(const std::string& program, const std::vector<OptionRow>& rows) {
    const auto row = std::find_if(rows.begin(), rows.end(), hasVariable);
    if (row == rows.end()) return "";
    const std::string name = displayName(*row);
    return "Each option can stand in the environment, too: " + name + " as " + variableName(program, name) +
           ", and so on.\nThe command line wins. Flags take 1 or 0; what may be given several times is parted by "
           "semicolons.";
}

template <class T>
bool parseAll(const std::string& text, T& number) {
    const char* end = text.data() + text.size();
    const auto [position, code] = std::from_chars(text.data(), end, number);
    return code == std::errc() && position == end;
}

std::string decimal(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

}  // namespace

bool parseCommandLine(const std::string& program, const std::string& description, const std::vector<OptionRow>& rows,
                      const std::vector<std::string>& arguments, const std::string& footer,
                      const std::function<void()>& makeConsistent) {
    if (arguments.size() == 2 && arguments.front() == helpFormatOption) {
        std::cout << manualOf({program, description, rows, footer}, arguments.back());
        return false;
    }
    CLI::App app(description, program);
    const std::string command = program.substr(program.rfind(' ') + 1);
    app.footer((footer.empty() ? "" : footer + (footer.ends_with('\n') ? "\n" : "\n\n")) +
               helpOnVariables(program, rows));
    app.allow_extras();
    app.get_formatter()->column_width(30);
    app.get_formatter()->label("REQUIRED", "");
    std::vector<CLI::Option*> options;
    options.reserve(rows.size());
    for (const OptionRow& row : rows) options.push_back(addOption(app, row));
    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 takes the last one first
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        return false;
    } catch (const CLI::RequiredError&) {
        // Said below, after an unknown option, which is the likelier reason.
    } catch (const CLI::ParseError& error) {
        failUsage("'" + command + "': " + error.what() + ".");
    }

    rejectUnknown(command, rows, app.remaining());
    std::vector<std::string> variables;  // that were read
    for (size_t i = 0; i < rows.size(); ++i) {
        std::vector<std::string> values = options[i]->results();
        std::string name = displayName(rows[i]);
        if (values.empty() && hasVariable(rows[i])) {
            const std::string variable = variableName(program, name);
            values = valuesOfVariable(rows[i], variable);
            if (!values.empty()) variables.push_back(name = variable);
        }
        if (values.empty() && isPositional(rows[i]))
            failUsage("'" + command + "' needs the argument " + rows[i].names + ".");
        if (values.size() > 1 && !rows[i].repeatable)
            failUsage(name + " is given " + std::to_string(values.size()) + " times.");
        for (const std::string& value : values) {
            requireChoice(rows[i], name, value);
            rows[i].assign(name, value);
        }
    }
    try {
        if (makeConsistent) makeConsistent();
    } catch (const Error& error) {
        if (error.code() != ErrorCode::Usage || variables.empty()) throw;
        failUsage(std::string(error.what()) + " (From the environment: " + joined(variables) + ".)");
    }
    return true;
}

std::string variableName(const std::string& program, const std::string& option) {
    std::string name = program + "_" + option.substr(option.find_first_not_of('-'));
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? char(std::toupper(c)) : '_';
    return name;
}

AssignValue assignText(std::string& target) {
    return [&target](const std::string&, const std::string& value) { target = value; };
}

AssignValue assignText(std::optional<std::string>& target) {
    return [&target](const std::string&, const std::string& value) { target = value; };
}

AssignValue assignText(std::vector<std::string>& target) {
    return [&target](const std::string&, const std::string& value) { target.push_back(value); };
}

AssignValue assignBytes(uint64_t& target) {
    return [&target](const std::string& option, const std::string& value) {
        constexpr std::string_view suffixes = "KMGT";
        const size_t power = value.empty() ? std::string_view::npos : suffixes.find(value.back());
        const bool suffixed = power != std::string_view::npos;
        const uint64_t unit = suffixed ? uint64_t(1) << (10 * (power + 1)) : 1;
        uint64_t number = 0;
        if (!parseAll(suffixed ? value.substr(0, value.size() - 1) : value, number) || number == 0 ||
            number > std::numeric_limits<uint64_t>::max() / unit)
            failUsage(option + " takes a size in bytes such as 500M or 8G, not '" + value + "'.");
        target = number * unit;
    };
}

AssignValue assignFlag(bool& target, bool value) {
    return [&target, value](const std::string&, const std::string&) { target = value; };
}

uint64_t parseWhole(const std::string& option, const std::string& value, uint64_t atLeast, uint64_t atMost) {
    uint64_t number = 0;
    if (parseAll(value, number) && number >= atLeast && number <= atMost) return number;
    failUsage(option + " takes a whole number from " + std::to_string(atLeast) + " to " + std::to_string(atMost) +
              ", not '" + value + "'.");
}

double parseReal(const std::string& option, const std::string& value, double moreThan, double atMost) {
    double number = 0;
    if (parseAll(value, number) && std::isfinite(number) && number > moreThan && number <= atMost) return number;
    const bool bounded = atMost < std::numeric_limits<double>::max();
    failUsage(option + " takes a number above " + decimal(moreThan) + (bounded ? " and up to " + decimal(atMost) : "") +
              ", not '" + value + "'.");
}

}  // namespace antipode
