// How far a render is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace antipode {

struct ProgressState {
    uint64_t iterations = 0;  ///< done
    std::optional<uint64_t> iterationLimit;
    std::optional<double> secondLimit;
    double elapsedSeconds = 0;
    uint64_t rays = 0;  ///< traced so far
};

/// "12 of 64 iterations, 5.2 it/s, 84 M rays/s, 2.3 s, 10.0 s left".
std::string progressText(const ProgressState& state);

/// Shows the state on stderr: as one line that overwrites itself on a terminal, else as a plain line every few seconds.
class Progress {
public:
    explicit Progress(bool quiet);
    /// Ends the line of a terminal.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Whether it is time to show something again.
    bool due(double elapsedSeconds) const;
    void show(const ProgressState& state);

private:
    bool quiet_, terminal_, lineOpen_ = false;
    double nextSeconds_;
};

}  // namespace antipode
