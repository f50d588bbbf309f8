// Files that are written while the render goes on.
#pragma once

#include <functional>
#include <future>
#include <string>

namespace antipode {

/// One write at a time on a thread of its own.
class BackgroundWriter {
public:
    /// Waits for the write in hand.
    ~BackgroundWriter();

    /// Begins a write unless one is in hand: then it is dropped, and a later one has newer content. True where begun.
    bool tryWrite(std::function<void()> write);
    bool busy() const;
    /// Waits for the write in hand.
    void wait();
    /// What the last write that failed threw, once; empty where none did.
    std::string takeFailure();

private:
    void collect();

    std::future<void> inHand_;
    std::string failure_;
};

}  // namespace antipode
