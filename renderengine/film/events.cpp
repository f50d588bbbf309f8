#include "renderengine/events.h"

namespace antipode {
namespace {

struct Names {
    const char *name, *key;
};

// In the order of the enumerations.
constexpr std::array<Names, eventKinds> kindNames{{
    {"not finite", "non_finite"},
    {"negative", "negative"},
    {"drawn with zero density", "zero_pdf"},
    {"too large for the film", "saturated"},
    {"from a loop that was cut short", "loop_limit"},
    {"from a traversal whose stack was full", "stack_overflow"},
    {"in a sum beyond 64 bits", "sum_overflow"},
}};

constexpr std::array<Names, eventSources> sourceNames{{
    {"emitter hit", "emitter_hit"},
    {"next event", "next_event"},
    {"connection", "connection"},
    {"splat", "splat"},
    {"merge", "merge"},
    {"camera rays", "camera_rays"},
    {"light emission", "light_emission"},
    {"camera trace", "camera_trace"},
    {"light trace", "light_trace"},
    {"camera scatter", "camera_scatter"},
    {"light scatter", "light_scatter"},
    {"film", "film"},
}};

}  // namespace

const char* name(EventKind kind) { return kindNames[size_t(kind)].name; }
const char* name(EventSource source) { return sourceNames[size_t(source)].name; }
const char* key(EventKind kind) { return kindNames[size_t(kind)].key; }
const char* key(EventSource source) { return sourceNames[size_t(source)].key; }

uint64_t EventCounts::total(EventKind kind) const {
    uint64_t sum = 0;
    for (const auto& source : counts_) sum += source[size_t(kind)];
    return sum;
}

EventCounts& EventCounts::operator+=(const EventCounts& o) {
    for (size_t s = 0; s < eventSources; ++s)
        for (size_t k = 0; k < eventKinds; ++k) counts_[s][k] += o.counts_[s][k];
    return *this;
}

EventCounts& EventCounts::operator-=(const EventCounts& o) {
    for (size_t s = 0; s < eventSources; ++s)
        for (size_t k = 0; k < eventKinds; ++k) counts_[s][k] -= o.counts_[s][k];
    return *this;
}

}  // namespace antipode
