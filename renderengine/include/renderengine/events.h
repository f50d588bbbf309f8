// What a correct render never does, counted on the device where it happens and carried with every result. Nothing is
// clamped or repaired: a count that is not 0 says that the image is not to be trusted, and which part of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace antipode {

enum class EventKind : uint32_t {
    NonFinite,      ///< a contribution, a throughput or a direction that is NaN or infinite
    Negative,       ///< a contribution or a throughput below zero
    ZeroPdf,        ///< a sample was drawn where its own density is not above zero
    Saturated,      ///< a sample too large for the film's fixed-point scale
    LoopLimit,      ///< a loop that a driver or a bound cut short
    StackOverflow,  ///< a traversal that had no room for a node still to visit
    SumOverflow,    ///< a film sum that left 64 bits: the sums mean nothing, and no image may hold them
};
inline constexpr size_t eventKinds = 7;

/// Techniques (whose shadow rays count as theirs) and stages.
enum class EventSource : uint32_t {
    EmitterHit,     ///< technique: a camera path meets an emitter
    NextEvent,      ///< technique: a camera vertex and a sampled light point
    Connection,     ///< technique: a camera vertex and a stored light vertex
    Splat,          ///< technique: a light vertex and the camera
    Merge,          ///< technique: a camera vertex and the light vertices around it
    CameraRays,     ///< stage: starts of camera paths
    LightEmission,  ///< stage: starts of light paths
    CameraTrace,    ///< stage: nearest hits of camera paths
    LightTrace,     ///< stage: nearest hits of light paths
    CameraScatter,  ///< stage: how camera paths go on
    LightScatter,   ///< stage: how light paths go on
    Film,           ///< stage: samples added to the fixed-point sums
};
inline constexpr size_t eventSources = 12;

/// For people: "not finite", "next event".
const char* name(EventKind kind);
const char* name(EventSource source);
/// For files: "non_finite", "next_event".
const char* key(EventKind kind);
const char* key(EventSource source);

/// One count for each source and kind.
class EventCounts {
public:
    uint64_t& at(EventSource source, EventKind kind) { return counts_[size_t(source)][size_t(kind)]; }
    uint64_t at(EventSource source, EventKind kind) const { return counts_[size_t(source)][size_t(kind)]; }
    /// Over all sources.
    uint64_t total(EventKind kind) const;
    bool clean() const { return *this == EventCounts{}; }

    EventCounts& operator+=(const EventCounts& o);
    /// `o` must have been added before.
    EventCounts& operator-=(const EventCounts& o);
    bool operator==(const EventCounts&) const = default;

private:
    std::array<std::array<uint64_t, eventKinds>, eventSources> counts_{};
};

}  // namespace antipode
