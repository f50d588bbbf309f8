// The server as a process: accepts connections, runs their sessions, the render queue and the worker.
#pragma once

#include <memory>
#include <string>

#include "proto/farm.pb.h"
#include "renderengine/devices.h"
#include "renderengine/renderer.h"
#include "server/server_options.h"

namespace antipode {

class Server {
public:
    /// Listens from construction on. `device`: what clients are told. `factory` makes the renderers of jobs, on the
    /// worker's thread. Throws Error.
    Server(const ServerOptions& options, const farm::Device& device, RendererFactory factory);
    /// A relay (ServerOptions::isRelay()).
    explicit Server(const ServerOptions& options);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    uint16_t port() const;
    /// Serves until SIGTERM, SIGINT or drain() and the drain after it, or until the device is lost.
    void run();
    /// Whether the device was lost: the process is to end with `exitDeviceLost`, without touching the device again, so
    /// that its supervisor starts another one.
    bool deviceLost() const;
    /// Thread-safe.
    void drain();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The device as clients are told.
farm::Device describeDevice(const DeviceInfo& device);

}  // namespace antipode
