#include "terminal/manual.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "renderengine/error.h"
#include "renderengine/io/suggest.h"
#include "renderengine/version.h"
#include "terminal/exit_codes.h"

namespace antipode {
namespace {

/// "antipode render" as one word, with this between its parts.
std::string oneWord(std::string program, char between) {
    for (char& c : program)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = between;
    return program;
}

bool isPositional(const OptionRow& row) { return row.names.front() != '-'; }
bool takesValue(const OptionRow& row) { return !row.valueName.empty(); }
bool isList(const OptionRow& row) { return row.valueName == "LIST"; }
bool takesFile(const OptionRow& row) {
    const auto begins = [&](const char* word) { return row.valueName.starts_with(word); };
    return begins("FILE") || begins("DIR") || begins("FOLDER");
}

std::vector<std::string> namesOf(const OptionRow& row) {
    const size_t comma = row.names.find(',');
    if (comma == std::string::npos) return {row.names};
    return {row.names.substr(0, comma), row.names.substr(comma + 1)};
}

/// The choices; those of a value such as "y|z" are its name.
std::vector<std::string> choicesOf(const OptionRow& row) {
    if (!row.choices.empty() || row.valueName.find('|') == std::string::npos) return row.choices;
    const size_t bar = row.valueName.find('|');
    std::vector<std::string> choices;
    for (const std::string& name : {row.valueName.substr(0, bar), row.valueName.substr(bar + 1)})
        if (!std::isupper(static_cast<unsigned char>(name.front()))) choices.push_back(name);  // capitals: any value
    return choices;
}

std::string separated(const std::vector<std::string>& words, const std::string& separator) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
    return text;
}

// --- man(7)
// -----------------------------------------------------------------------------------------------------------

/// Text as roff takes it: hyphens as they are typed, UTF-8 by code point, no line that begins a request.
std::string roff(const std::string& text) {
    std::string out;
    for (size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((text[i] == '.' || text[i] == '\'') && (i == 0 || text[i - 1] == '\n')) out += "\\&";
        if (byte < 0x80) {
            out += text[i] == '\\' ? "\\e" : text[i] == '-' ? "\\-" : std::string(1, text[i]);
            continue;
        }
        const size_t following = byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : 1;
        unsigned code = byte & (0x3fu >> following);
        for (size_t k = 0; k < following && i + 1 < text.size(); ++k) code = code << 6 | (text[++i] & 0x3f);
        char escape[16];
        std::snprintf(escape, sizeof escape, "\\[u%04X]", code);
        out += escape;
    }
    return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string manHead(const std::string& program, const std::string& description) {
    const std::string page = oneWord(program, '-');
    std::string title = page;
    std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    std::string purpose = description;
    if (purpose.ends_with('.')) purpose.pop_back();
    purpose.front() = char(std::tolower(static_cast<unsigned char>(purpose.front())));
    return ".TH " + title + " 1 \"\" \"antipode " + versionText + "\" \"User Commands\"\n.SH NAME\n" + roff(page) +
           " \\- " + roff(purpose) + "\n";
}

std::string manExitCodes() {
    std::string text = ".SH EXIT STATUS\n";
    for (const ExitCodeInfo& info : exitCodes)
        text += ".TP\n" + bold(std::to_string(info.code)) + "\n" + roff(std::string(info.meaning) + ".") + "\n";
    return text;
}

std::string manOption(const CommandManual& command, const OptionRow& row) {
    std::vector<std::string> names;
    for (const std::string& name : namesOf(row)) names.push_back(isPositional(row) ? italic(name) : bold(name));
    std::string text = ".TP\n" + separated(names, ", ") + (takesValue(row) ? " " + italic(row.valueName) : "") + "\n";
    text += roff(row.help) + "\n";
    if (!row.choices.empty()) text += ".br\n" + roff("One of " + joined(row.choices) + ".") + "\n";
    if (!row.defaultText.empty()) text += ".br\n" + roff("Default: " + row.defaultText + ".") + "\n";
    if (!isPositional(row) && !row.action)
        text += ".br\n" + roff("Variable: " + variableName(command.program, namesOf(row).back()) + ".") + "\n";
    return text;
}

std::string manPage(const CommandManual& command) {
    std::string text = manHead(command.program, command.description) + ".SH SYNOPSIS\n" + bold(command.program);
    text += " [" + italic("OPTIONS") + "]";
    for (const OptionRow& row : command.rows)
        if (isPositional(row)) text += " " + italic(row.names) + (row.repeatable ? "\\~..." : "");
    text += "\n.SH DESCRIPTION\n" + roff(command.description) + "\n";
    if (!command.footer.empty()) {
        // A blank line parts paragraphs, in text that is filled no more than in text that is not.
        std::string notes = command.footer;
        while (notes.ends_with('\n')) notes.pop_back();
        notes = roff(notes);
        for (size_t at; (at = notes.find("\n\n")) != std::string::npos;) notes.replace(at, 2, "\n.sp\n");
        text += ".sp\n.nf\n" + notes + "\n.fi\n";
    }
    text += ".SH OPTIONS\n";
    for (const OptionRow& row : command.rows) text += manOption(command, row);
    text += ".SH ENVIRONMENT\n" +
            roff(
                "Each option can stand in a variable, named with it above. The command line wins, an empty variable is "
                "none, flags take 1 or 0, and what may be given several times is parted by semicolons.") +
            "\n";
    return text + manExitCodes();
}

std::string manPage(const std::string& program, const std::string& description,
                    const std::vector<CommandSummary>& commands) {
    std::string text = manHead(program, description) + ".SH SYNOPSIS\n" + bold(program) + " " + italic("COMMAND") +
                       " [" + italic("OPTIONS") + "]\n.SH COMMANDS\n";
    std::vector<std::string> pages;
    for (const auto& [name, summary] : commands) {
        text += ".TP\n" + bold(name) + "\n" + roff(summary + ".") + "\n";
        pages.push_back("\\fB" + roff(oneWord(program, '-') + "-" + name) + "\\fR(1)");
    }
    return text + manExitCodes() + ".SH SEE ALSO\n" + separated(pages, ",\n") + "\n";
}

// --- bash
// -------------------------------------------------------------------------------------------------------------

/// Where COMPREPLY stays empty, bash completes names of files.
std::string bashFunction(const CommandManual& command) {
    std::vector<std::string> options{"--help"};
    std::string cases;
    for (const OptionRow& row : command.rows) {
        if (isPositional(row)) continue;
        options.push_back(namesOf(row).back());
        const std::vector<std::string> choices = choicesOf(row);
        const std::string pattern = "    " + separated(namesOf(row), "|") + ") ";
        if (!choices.empty() && isList(row))
            cases += pattern + "COMPREPLY=($(compgen -P \"${current%\"${current##*,}\"}\" -W '" +
                     separated(choices, " ") + "' -- \"${current##*,}\")); return ;;\n";
        else if (!choices.empty())
            cases +=
                pattern + "COMPREPLY=($(compgen -W '" + separated(choices, " ") + "' -- \"$current\")); return ;;\n";
        else if (takesValue(row))
            cases += pattern + "return ;;\n";
    }
    const std::string name = "_" + oneWord(command.program, '_');
    return name + "() {\n" +
           "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
           "    [[ $current == '=' ]] && current=''\n"
           "    [[ $previous == '=' ]] && previous=${COMP_WORDS[COMP_CWORD-2]}\n"
           "    COMPREPLY=()\n"
           "    case $previous in\n" +
           cases + "    esac\n    [[ $current != -* ]] || COMPREPLY=($(compgen -W '" + separated(options, " ") +
           "' -- \"$current\"))\n}\n";
}

std::string bashProgram(const std::string& program, const std::vector<CommandSummary>& commands) {
    const std::string name = "_" + oneWord(program, '_');
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const CommandSummary& command : commands) names.push_back(command.first);
    return name + "() {\n    if ((COMP_CWORD == 1)); then\n        COMPREPLY=($(compgen -W '" + separated(names, " ") +
           " --help --version' -- \"${COMP_WORDS[1]}\"))\n    elif declare -F \"" + name +
           "_${COMP_WORDS[1]}\" > /dev/null; then\n        \"" + name + "_${COMP_WORDS[1]}\"\n    fi\n}\n";
}

std::string bashRegistration(const std::string& program) {
    return "complete -o default -F _" + oneWord(program, '_') + " " + program + "\n";
}

// --- zsh
// --------------------------------------------------------------------------------------------------------------

/// Inside single quotes, with a backslash before what _arguments takes for its own.
std::string zshQuoted(const std::string& text, const std::string& special) {
    std::string out;
    for (const char c : text) {
        if (special.find(c) != std::string::npos) out += '\\';
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return out;
}

std::string zshAction(const OptionRow& row) {
    const std::vector<std::string> choices = choicesOf(row);
    if (!choices.empty() && isList(row)) return "_values -s , LIST " + separated(choices, " ");
    if (!choices.empty()) return "(" + separated(choices, " ") + ")";
    return takesFile(row) || isPositional(row) ? "_files" : " ";
}

std::string zshFunction(const CommandManual& command) {
    std::string text =
        "_" + oneWord(command.program, '_') + "() {\n    _arguments \\\n        '--help[print the help]'";
    for (const OptionRow& row : command.rows) {
        const std::string value =
            zshQuoted(isPositional(row) ? row.names : row.valueName, ":\\") + ":" + zshQuoted(zshAction(row), "");
        if (isPositional(row)) {
            text += " \\\n        '" + std::string(row.repeatable ? "*" : "") + ":" + value + "'";
            continue;
        }
        for (const std::string& name : namesOf(row)) {
            const bool isLong = name.starts_with("--");
            text += " \\\n        '" + std::string(row.repeatable ? "*" : "") + name +
                    (takesValue(row) ? isLong ? "=" : "+" : "") + "[" + zshQuoted(row.help, "[]\\") + "]" +
                    (takesValue(row) ? ":" + value : "") + "'";
        }
    }
    return text + "\n}\n";
}

std::string zshProgram(const std::string& program, const std::vector<CommandSummary>& commands) {
    const std::string name = "_" + oneWord(program, '_');
    std::string text = name + "() {\n    if ((CURRENT == 2)); then\n        local -a commands=(\n";
    for (const auto& [command, summary] : commands)
        text += "            '" + zshQuoted(command, ":") + ":" + zshQuoted(summary, "") + "'\n";
    return text + "        )\n        _describe command commands\n        return\n    fi\n" +
           "    local function=" + name +
           "_$words[2]\n    shift words\n    ((CURRENT--))\n"
           "    ((!$+functions[$function])) || $function\n}\n";
}

std::string zshFile(const std::string& program, const std::string& functions) {
    return "#compdef " + program + "\n" + functions + "_" + oneWord(program, '_') + " \"$@\"\n";
}

[[noreturn]] void failFormat(const std::string& format) {
    throw Error(ErrorCode::Usage,
                std::string(helpFormatOption) + " takes one of " + joined(helpFormats()) + ", not '" + format + "'.");
}

}  // namespace

std::vector<std::string> helpFormats() { return {"man", "bash", "zsh"}; }

std::string manualOf(const CommandManual& command, const std::string& format) {
    const bool isProgram = command.program.find(' ') == std::string::npos;
    if (format == "man") return manPage(command);
    if (format == "bash") return bashFunction(command) + (isProgram ? bashRegistration(command.program) : "");
    if (format == "zsh") return isProgram ? zshFile(command.program, zshFunction(command)) : zshFunction(command);
    failFormat(format);
}

std::string manualOf(const std::string& program, const std::string& description,
                     const std::vector<CommandSummary>& commands, const std::string& functions,
                     const std::string& format) {
    if (format == "man") return manPage(program, description, commands);
    if (format == "bash") return functions + bashProgram(program, commands) + bashRegistration(program);
    if (format == "zsh") return zshFile(program, functions + zshProgram(program, commands));
    failFormat(format);
}

}  // namespace antipode
