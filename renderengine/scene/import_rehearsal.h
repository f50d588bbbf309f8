// Trying an import where it can do no harm.
#pragma once

#include <functional>
#include <string>

namespace antipode {

/// Calls `read` in a forked process first. Assimp 5.2 crashes or runs forever on some broken files, even on a .ply or
/// .fbx that was cut short, and nothing in the same process can help then. Where `read` throws, its exception's
/// message, and where the process dies or takes more time than any sound file of that size needs, a sentence that says
/// so, is thrown as Error(Input), and the caller's process has not touched the file. What `read` writes to the terminal
/// is lost. Costs the time of one more import.
void rehearseImport(const std::string& path, const std::function<void()>& read);

}  // namespace antipode
