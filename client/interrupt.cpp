#include "client/interrupt.h"

#include <csignal>
#include <iterator>
#include <string_view>

#include <unistd.h>

namespace antipode {
namespace {

constexpr int signals[] = {SIGINT, SIGTERM};

// All that a signal handler may touch.
volatile std::sig_atomic_t interruptRequested = 0;
volatile std::sig_atomic_t announceInterrupt = 0;

extern "C" void onInterrupt(int signal) {
    interruptRequested = 1;
    std::signal(signal, SIG_DFL);
    constexpr std::string_view text = "\nFinishing this iteration; again, and nothing is written.\n";
    // Nothing can be done about a failed write here.
    if (announceInterrupt && ::write(STDERR_FILENO, text.data(), text.size()) < 0) return;
}

}  // namespace

InterruptGuard::InterruptGuard(bool announce) {
    interruptRequested = 0;
    announceInterrupt = announce;
    for (size_t i = 0; i < std::size(signals); ++i) {
        previousHandlers_[i] = std::signal(signals[i], onInterrupt);
        // A parent that wants us to ignore the signal, such as a shell for its background jobs, has its way.
        if (previousHandlers_[i] == SIG_IGN) std::signal(signals[i], SIG_IGN);
    }
}

InterruptGuard::~InterruptGuard() {
    for (size_t i = 0; i < std::size(signals); ++i) std::signal(signals[i], previousHandlers_[i]);
}

bool InterruptGuard::requested() const { return interruptRequested != 0; }

}  // namespace antipode
