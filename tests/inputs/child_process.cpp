#include "tests/inputs/child_process.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ostream>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "proto/scene_loader.h"
#include "proto/scene_translation.h"
#include "renderengine/error.h"

namespace antipode::test {
namespace {

using Clock = std::chrono::steady_clock;

struct Pipe {
    int read = -1, write = -1;
    Pipe() {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("pipe2 failed");
        read = ends[0], write = ends[1];
    }
};

void setLimits(const ChildLimits& limits) {
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
#ifndef __SANITIZE_ADDRESS__
    const rlimit space{limits.addressSpace, limits.addressSpace};
    ::setrlimit(RLIMIT_AS, &space);
#else
    (void)limits;
#endif
}

/// The ending's number, then the text.
std::string report(const std::function<std::string()>& action) {
    const auto line = [](Ending ending, const std::string& text) { return char('0' + int(ending)) + text; };
    try {
        return line(Ending::Returned, action());
    } catch (const Error& e) {
        return line(e.code() == ErrorCode::Input ? Ending::InputError : Ending::OtherException, e.what());
    } catch (const std::exception& e) {
        return line(Ending::OtherException, std::string(typeid(e).name()) + ": " + e.what());
    }
}

[[noreturn]] void runChild(const std::function<std::string()>& action, const ChildLimits& limits, int result,
                           int output) {
    ::dup2(output, STDOUT_FILENO);
    ::dup2(output, STDERR_FILENO);
    setLimits(limits);
    const std::string text = report(action);
    std::fflush(nullptr);
    // A text longer than a pipe holds would need a reader that waits; no sentence is.
    const size_t size = std::min<size_t>(text.size(), 4096);
    ::_exit(::write(result, text.data(), size) == ssize_t(size) ? 0 : 1);
}

/// Reads until the writer has closed the pipe; false at the deadline.
bool drain(int file, std::string& text, Clock::time_point deadline) {
    for (std::array<char, 4096> buffer;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd ready{file, POLLIN, 0};
        if (left <= 0 || ::poll(&ready, 1, int(left)) == 0) return false;
        const ssize_t count = ::read(file, buffer.data(), buffer.size());
        if (count <= 0) return true;
        text.append(buffer.data(), size_t(count));
    }
}

}  // namespace

Outcome runInChild(const std::function<std::string()>& action, const ChildLimits& limits) {
    const Pipe result, output;
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0) runChild(action, limits, result.write, output.write);
    ::close(result.write);
    ::close(output.write);

    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.seconds));
    Outcome outcome;
    std::string text;
    // The child closes its ends by ending, so both pipes run dry then and not before.
    const bool ended = drain(output.read, outcome.output, deadline) && drain(result.read, text, deadline);
    if (!ended) ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ::close(result.read);
    ::close(output.read);
    if (!ended) {
        outcome.ending = Ending::Timeout;
    } else if (WIFSIGNALED(status)) {
        outcome.text = ::strsignal(WTERMSIG(status));
    } else if (text.empty()) {
        outcome.text = "exit " + std::to_string(WEXITSTATUS(status));
    } else {
        outcome.ending = Ending(text[0] - '0');
        outcome.text = text.substr(1);
    }
    return outcome;
}

std::ostream& operator<<(std::ostream& out, const Outcome& outcome) {
    constexpr const char* names[] = {"returned", "input error", "other exception", "signal", "timeout"};
    out << names[int(outcome.ending)] << ": " << outcome.text;
    if (!outcome.output.empty()) out << "\n  output: " << outcome.output.substr(0, 2000);
    return out;
}

std::string checkedHash(const Scene& scene) {
    validate(scene);
    const std::string hash = sceneHash(scene);
    if (hash != sceneHash(scene)) throw std::logic_error("the same scene has two hashes");
    schema::Scene received;
    if (!received.ParseFromString(toProto(scene).SerializeAsString()))
        throw std::logic_error("the scene cannot be sent");
    if (sceneHash(fromProto(received)) != hash) throw std::logic_error("the scene does not survive being sent");
    return hash;
}

Outcome loadInChild(const std::string& path, const ChildLimits& limits) {
    return runInChild([&] { return checkedHash(loadScene(path)); }, limits);
}

std::string objectionTo(const Outcome& outcome, const std::string& named) {
    if (!outcome.output.empty()) return "a library wrote to the terminal";
    if (outcome.ending == Ending::Returned) return {};
    if (outcome.ending != Ending::InputError) return "neither a scene nor an input error";
    if (outcome.text.find(named) == std::string::npos) return "the sentence does not name " + named;
    if (outcome.text.size() > 800) return "the sentence has " + std::to_string(outcome.text.size()) + " characters";
    const bool plain = std::none_of(outcome.text.begin(), outcome.text.end(), [](unsigned char c) { return c < 0x20; });
    return plain ? "" : "the sentence holds control characters or is more than one line";
}

}  // namespace antipode::test
