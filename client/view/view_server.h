// Serves a render's page, over HTTP, from a thread of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "client/view/picture.h"

namespace antipode::view {

struct ViewServerOptions {
    std::string host, port;  ///< port 0: any
    std::string token;       ///< see request_guard.h; "" only where `host` is loopback
};

/// What is published is handed over and never waited for: whoever reads slowly, sends nothing, sends too much or comes
/// in thousands costs this thread's time and a bounded number of connections, bytes and seconds each. A page that
/// follows is sent the latest state as a line of JSON whenever it has read the one before, and {"picture": N} when
/// there is another picture; it fetches pictures as fast as it can, and no new one is wanted before that.
class ViewServer {
public:
    /// Listens. Throws Error(Usage) where nobody can.
    explicit ViewServer(const ViewServerOptions& options);
    /// Closes all connections.
    ~ViewServer();
    ViewServer(const ViewServer&) = delete;
    ViewServer& operator=(const ViewServer&) = delete;

    uint16_t port() const;

    // All of these are thread-safe and return at once, but farewell().

    /// Whether a page follows.
    bool watched() const;
    /// Whether a page follows and has fetched the latest picture, or there is none.
    bool wantsPicture() const;
    /// `json`: an object without line breaks.
    void publishState(std::string json);
    void publishPicture(Picture picture);
    /// Whether somebody has asked, since the last call, to end the render; to write its files.
    bool takeFinishRequest();
    bool takeWriteRequest();
    /// Waits until no page follows any more, for so many seconds at most: pages go once they have seen the end.
    void farewell(double seconds) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antipode::view
