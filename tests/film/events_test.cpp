#include "renderengine/events.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

using namespace antipode;

namespace {

/// Another count for each source and kind.
EventCounts distinct(uint64_t factor) {
    EventCounts events;
    for (size_t s = 0; s < eventSources; ++s)
        for (size_t k = 0; k < eventKinds; ++k)
            events.at(EventSource(s), EventKind(k)) = factor * (1 + s * eventKinds + k);
    return events;
}

/// Non-empty, no two the same.
template <class Enum>
void expectNamed(size_t count) {
    std::set<std::string> names, keys;
    for (size_t i = 0; i < count; ++i) {
        names.insert(name(Enum(i)));
        keys.insert(key(Enum(i)));
    }
    EXPECT_EQ(names.size(), count);
    EXPECT_EQ(keys.size(), count);
    EXPECT_FALSE(names.contains(""));
    EXPECT_FALSE(keys.contains(""));
    for (const std::string& each : keys)
        EXPECT_EQ(each.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos) << each;
}

}  // namespace

TEST(EventCounts, TheLastSourceAndKindAreTheLast) {
    EXPECT_EQ(size_t(EventSource::Film) + 1, eventSources);
    EXPECT_EQ(size_t(EventKind::SumOverflow) + 1, eventKinds);
}

TEST(EventCounts, EachHasItsNameAndKey) {
    expectNamed<EventKind>(eventKinds);
    expectNamed<EventSource>(eventSources);
    EXPECT_STREQ(name(EventKind::StackOverflow), "from a traversal whose stack was full");
    EXPECT_STREQ(key(EventKind::ZeroPdf), "zero_pdf");
    EXPECT_STREQ(name(EventSource::NextEvent), "next event");
    EXPECT_STREQ(key(EventSource::LightScatter), "light_scatter");
}

TEST(EventCounts, AreCleanUntilOneIsCounted) {
    EXPECT_TRUE(EventCounts{}.clean());
    for (size_t s = 0; s < eventSources; ++s)
        for (size_t k = 0; k < eventKinds; ++k) {
            EventCounts events;
            events.at(EventSource(s), EventKind(k)) = 1;
            EXPECT_FALSE(events.clean());
            EXPECT_NE(events, EventCounts{});
        }
}

TEST(EventCounts, AddEachToItsOwn) {
    EventCounts sum = distinct(1);
    sum += distinct(1000);
    EXPECT_EQ(sum, distinct(1001));
}

TEST(EventCounts, SubtractionUndoesAddition) {
    EventCounts sum = distinct(7);
    sum += distinct(1000);
    sum -= distinct(7);
    EXPECT_EQ(sum, distinct(1000));
    sum -= distinct(1000);
    EXPECT_TRUE(sum.clean());
}

TEST(EventCounts, TotalsAreOverSources) {
    EventCounts events;
    events.at(EventSource::EmitterHit, EventKind::Negative) = 1;
    events.at(EventSource::Connection, EventKind::Negative) = uint64_t(1) << 40;
    events.at(EventSource::Film, EventKind::Negative) = 4;
    events.at(EventSource::Film, EventKind::NonFinite) = 8;
    EXPECT_EQ(events.total(EventKind::Negative), (uint64_t(1) << 40) + 5);
    EXPECT_EQ(events.total(EventKind::NonFinite), 8u);
    EXPECT_EQ(events.total(EventKind::Saturated), 0u);
}
