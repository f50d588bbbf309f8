// Where the images of a model lie whose names were written on another machine.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "renderengine/io/files.h"
#include "scene/texture_table.h"

namespace antipode {
namespace {

namespace fs = std::filesystem;

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

/// The entry of the folder whose name differs in case alone; of several the first in order, so that the answer does not
/// depend on the file system. Empty where there is none.
fs::path entryWithoutCase(const fs::path& folder, const std::string& name) {
    const std::string wanted = lowerCase(name);
    fs::path found;
    std::error_code code;
    const fs::path where = folder.empty() ? fs::path(".") : folder;
    for (fs::directory_iterator entry(where, code), end; !code && entry != end; entry.increment(code)) {
        const fs::path file = entry->path().filename();
        if (lowerCase(file.string()) == wanted && (found.empty() || file < found)) found = file;
    }
    return found.empty() ? found : folder / found;
}

/// `relative` below the folder, step by step without regard to case; empty where it does not exist.
fs::path pathWithoutCase(fs::path folder, const fs::path& relative) {
    for (const fs::path& step : relative) {
        std::error_code code;
        const fs::path exact = folder / step;
        folder = fs::exists(exact, code) ? exact : entryWithoutCase(folder, step.string());
        if (folder.empty()) return folder;
    }
    return folder;
}

}  // namespace

std::string findImageFile(const std::string& directory, const std::string& name) {
    // Some writers end names with a space or with the line's return.
    constexpr std::string_view spaces = " \t\r\n";
    const size_t begin = std::min(name.find_first_not_of(spaces), name.size());
    std::string portable = name.substr(begin, name.find_last_not_of(spaces) + 1 - begin);
    std::replace(portable.begin(), portable.end(), '\\', '/');
    const fs::path folder(directory), asWritten(portable), bareName = asWritten.filename();
    if (bareName.empty()) return {};
    // Exact names first: a name that is right costs no look at a folder.
    for (const fs::path& path : {folder / asWritten, folder / bareName, folder / "textures" / bareName})
        if (isRegularFile(path.string())) return path.string();
    const fs::path relative = asWritten.is_relative() ? asWritten : bareName;
    for (const fs::path& path : {relative, bareName, fs::path("textures") / bareName})
        if (const fs::path found = pathWithoutCase(folder, path); !found.empty() && isRegularFile(found.string()))
            return found.string();
    return {};
}

}  // namespace antipode
