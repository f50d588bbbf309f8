// Loading something in a process of its own: whatever it does to itself, the test goes on and can say what it was.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

#include "renderengine/scene.h"

namespace antipode::test {

struct ChildLimits {
    double seconds = 20;
    /// RLIMIT_AS; builds with AddressSanitizer, which maps terabytes, go without.
    uint64_t addressSpace = uint64_t(4) << 30;
};

enum class Ending {
    Returned,        ///< the action returned
    InputError,      ///< antipode::Error of code Input
    OtherException,  ///< any other exception
    Signal,          ///< a signal, or an exit that the action did not ask for
    Timeout,         ///< it still ran at the deadline and was killed
};

struct Outcome {
    Ending ending = Ending::Signal;
    std::string text;    ///< what the action returned, or what the exception said, or the signal
    std::string output;  ///< what came out on stdout and stderr
};

/// Runs `action` in a forked child and waits for its end.
Outcome runInChild(const std::function<std::string()>& action, const ChildLimits& limits = {});

std::ostream& operator<<(std::ostream& out, const Outcome& outcome);

/// The scene's hash, after validating it, hashing it once more and sending it to itself as a client sends it to
/// servers. Throws std::logic_error where a hash differs.
std::string checkedHash(const Scene& scene);

/// Loads the file in a child and returns checkedHash() of the scene.
Outcome loadInChild(const std::string& path, const ChildLimits& limits = {});

/// Why the outcome is not what every load must be: a scene, or one sentence on one line that holds `named`. Empty where
/// it is.
std::string objectionTo(const Outcome& outcome, const std::string& named);

}  // namespace antipode::test
