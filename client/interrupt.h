// Ctrl-C as a request to finish.
#pragma once

namespace antipode {

/// While it lives, the first SIGINT or SIGTERM only sets a flag and the second of the same ends the process as
/// usual. At most one at a time; not thread-safe, because signal handlers belong to the process.
class InterruptGuard {
public:
    /// `announce`: the handler says on stderr what happens.
    explicit InterruptGuard(bool announce);
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    bool requested() const;

private:
    void (*previousHandlers_[2])(int);  ///< of SIGINT and SIGTERM
};

}  // namespace antipode
