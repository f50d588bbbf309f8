// The server's side of one connection: introduction, scene, leases, results.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "proto/wire/loop_watch.h"
#include "proto/wire/session.h"
#include "server/render_queue.h"
#include "server/scene_cache.h"
#include "server/scene_intake.h"

namespace antipode {

/// What all sessions of a server share.
struct ServerContext {
    RenderQueue& queue;
    SceneCache& cache;
    farm::Welcome welcome;  ///< what clients are told; `protocol` is filled in
    wire::Liveness liveness;
    bool draining = false;              ///< set once; sessions notice at their next tick
    Background background = runAtOnce;  ///< what scenes are put together with
    /// What a log should tell of a client: its name for itself, made printable, and what has happened.
    std::function<void(const std::string& client, const std::string& event)> log = nullptr;
    wire::LoopWatch watch{};  ///< of what connections run
    size_t maxClients = 128;  ///< introduced at once; Hello is refused as BUSY beyond
    size_t clients = 0;       ///< introduced sessions, counted by themselves from Hello to their end
};

/// Pure: see wire::Session. Nothing but Hello is accepted first, and nothing twice that makes no sense twice. Result
/// chunks go out only under credits, and only while the port's queue is short.
///
/// What a client makes the server keep is bounded: leaseDepth leases and results (RenderQueue), the scene's blobs
/// (SceneCache), about 2 MiB of result chunks in the port's queue; a client that asks on without reading is cut off.
class ServerSession final : public wire::Session {
public:
    ServerSession(ServerContext& context, wire::FramePort& port, double now);
    ~ServerSession() override;

    void heard(double now) override;
    void receive(const wire::Frame& frame, double now) override;
    void tick(double now) override;
    void disconnected(const std::string& reason, double now) override;

    /// For logs and metrics: what the client calls itself, made printable; empty before Hello.
    std::string client() const;
    /// Hello was accepted: it is one of the context's clients.
    bool introduced() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antipode
