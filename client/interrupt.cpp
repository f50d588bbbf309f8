#include "client/interrupt.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <iterator>
#include <string_view>

#include <unistd.h>

#include "terminal/exit_codes.h"

namespace antipode {
namespace {

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1};
constexpr int64_t repeatNanoseconds = 1'000'000'000;

// All that signal handlers may touch; any thread may run them.
std::atomic<bool> rendering = false, writeRequested = false, announces = false;
std::atomic<int64_t> finishRequestedAt = 0;  ///< monotonic nanoseconds; 0: not yet
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int64_t>::is_always_lock_free);

int64_t monotonicNanoseconds() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return int64_t(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

/// Nothing can be done about a failed write here.
void say(std::string_view text) {
    if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;
}

extern "C" void onEnd(int signal) {
    const int error = errno;
    if (!rendering) {
        say("\nantipode: interrupted during set-up: nothing was rendered, nothing is written.\n");
        ::_exit(exitFailed);
    }
    const int64_t now = monotonicNanoseconds();
    int64_t first = 0;
    if (finishRequestedAt.compare_exchange_strong(first, now)) {
        if (announces) say("\nFinishing this iteration; again in more than a second, and nothing is written.\n");
    } else if (now - first > repeatNanoseconds) {
        std::signal(signal, SIG_DFL);
        ::raise(signal);  // comes once this handler has returned
    }
    errno = error;
}

extern "C" void onWrite(int) { writeRequested = true; }

}  // namespace

SignalGuard::SignalGuard(bool announce) {
    rendering = writeRequested = false;
    finishRequestedAt = 0;
    announces = announce;
    for (size_t i = 0; i < std::size(signals); ++i) {
        previousHandlers_[i] = std::signal(signals[i], signals[i] == SIGUSR1 ? onWrite : onEnd);
        // A parent that wants us to ignore the signal, such as nohup or a shell for its background jobs, has its way.
        if (previousHandlers_[i] == SIG_IGN) std::signal(signals[i], SIG_IGN);
    }
}

SignalGuard::~SignalGuard() {
    for (size_t i = 0; i < std::size(signals); ++i) std::signal(signals[i], previousHandlers_[i]);
}

void SignalGuard::beginRendering() { rendering = true; }
bool SignalGuard::finishRequested() const { return finishRequestedAt != 0; }
bool SignalGuard::takeWriteRequest() { return writeRequested.exchange(false); }

}  // namespace antipode
