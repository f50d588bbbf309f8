// A TCP proxy on loopback that breaks connections the ways networks do, by a schedule that a seed decides.
#pragma once

#include <cstdint>
#include <memory>

namespace antipode::test {

/// Each direction of each connection is cut into segments of random length. A segment suffers at most one fault, each
/// with its probability; the sum must not exceed 1. What happens at which byte depends on the seed, the connection's
/// number and the direction alone.
struct FaultOptions {
    uint64_t seed = 1;
    uint32_t meanSegmentBytes = 4096;
    uint64_t unharmedBytes = 0;  ///< at the start of each direction: no fault but split, coalesce and delay

    // Nothing is lost or changed:
    double split = 0;     ///< goes out in writes of 1 … 16 bytes (the first 256 of it)
    double coalesce = 0;  ///< is held back and goes out in one write
    double delay = 0;     ///< waits for up to delaySeconds
    double stall = 0;     ///< waits for stallSeconds; the other direction goes on
    double delaySeconds = 0.01, stallSeconds = 0.5;

    // Bytes change:
    double flip = 0;       ///< one bit of its first byte differs
    double duplicate = 0;  ///< comes twice (up to 64 bytes at its start)
    double drop = 0;       ///< does not come

    // The connection ends:
    double truncate = 0;  ///< half of it comes, then FIN, both ways
    double reset = 0;     ///< RST, both ways
};

struct FaultCounters {
    uint64_t connections = 0, bytes = 0;  ///< forwarded
    uint64_t split = 0, coalesce = 0, delay = 0, stall = 0, flip = 0, duplicate = 0, drop = 0, truncate = 0, reset = 0;
};

/// Runs on a thread of its own; its functions may be called from any other.
class FaultProxy {
public:
    FaultProxy(uint16_t targetPort, const FaultOptions& options);
    ~FaultProxy();
    FaultProxy(const FaultProxy&) = delete;
    FaultProxy& operator=(const FaultProxy&) = delete;

    uint16_t port() const;
    FaultCounters counters() const;

    /// Closes all connections, both ways. New ones are welcome.
    void cutAll();
    /// From now on nothing comes through and nobody is told: a pulled cable. New connections are accepted, silently.
    void blackHole();
    /// Like blackHole(), but only from clients to the target.
    void blackHoleOneWay();
    /// The cable is back; what was under way goes on.
    void restore();
    /// Closes everything, for good. So does the destructor.
    void stop();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antipode::test
