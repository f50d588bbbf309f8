// A server's results, from the offer to the verdict.
#pragma once

#include <deque>

#include "farm/jobs/coordinator.h"
#include "proto/farm.pb.h"
#include "proto/wire/session.h"
#include "renderengine/film_hash.h"

namespace antipode {

class ReassemblyBudget;

/// Results are taken one after the other, in the order in which they were offered: the connection is the bottleneck,
/// and whole results are worth more than halves. Each takes its share of the budget before the first chunk is asked
/// for.
class ResultIntake {
public:
    /// At most `depth` offers wait at once. All references outlive the intake.
    ResultIntake(Coordinator& coordinator, ReassemblyBudget& budget, wire::FramePort& port,
                 const RenderSettings& settings, size_t depth);
    ~ResultIntake();
    ResultIntake(const ResultIntake&) = delete;
    ResultIntake& operator=(const ResultIntake&) = delete;

    /// Takes note of an offer that passed checkOffer(), or answers it at once where the coordinator does not want it.
    /// Throws ProtocolError for one offer too many.
    void offer(const farm::ResultOffer& offer, NodeId node, double now);
    /// Throws ProtocolError for a chunk that was not asked for, out of order or broken.
    void chunk(const farm::ResultChunk& chunk, const std::string& payload, NodeId node, double now);
    /// Begins the next transfer if the budget allows for it.
    void advance(double now);

    bool holds(LeaseId lease) const;
    /// Since when the server owes a chunk that it was asked for, if it does.
    std::optional<double> owedSince() const;

private:
    struct Offered {
        farm::ResultOffer offer;
        IterationRange range;
    };
    struct Transfer {
        FilmSums sums;
        std::optional<FilmSumsHash> hash{};  ///< of the chunks so far: all at once would keep the event loop
        uint32_t received = 0, credited = 0;
        double lastChunk = 0;
    };

    void grantCredit(LeaseId lease);
    void complete(NodeId node, double now);
    void endTransfer();
    void answer(LeaseId lease, farm::ResultVerdict::Verdict verdict);

    Coordinator& coordinator_;
    ReassemblyBudget& budget_;
    wire::FramePort& port_;
    const RenderSettings settings_;
    const size_t depth_;
    const uint64_t bytes_;  ///< of a result's sums
    std::deque<Offered> offered_;
    std::optional<Transfer> transfer_;  ///< of offered_.front()
};

}  // namespace antipode
