// What signals ask of a render.
#pragma once

namespace antipode {

/// While it lives:
/// - SIGINT, SIGTERM and SIGHUP before beginRendering() end the process with exit code 1 and a sentence: there is
///   nothing to save, and set-up may be inside a driver or an importer that hears of nothing.
/// - After it the first of them sets a flag. Repeats within a second are the same request (GNU timeout signals the
///   process and then its group); a later one ends the process as the signal would.
/// - SIGUSR1 sets a flag of its own.
/// At most one at a time, because signal handlers belong to the process.
class SignalGuard {
public:
    /// `announce`: the handlers say on stderr what happens.
    explicit SignalGuard(bool announce);
    ~SignalGuard();
    SignalGuard(const SignalGuard&) = delete;
    SignalGuard& operator=(const SignalGuard&) = delete;

    void beginRendering();
    bool finishRequested() const;
    /// Whether SIGUSR1 has come since the last call.
    bool takeWriteRequest();

private:
    void (*previousHandlers_[4])(int);
};

}  // namespace antipode
