#include "farm/nodes/result_intake.h"

#include <algorithm>
#include <utility>

#include "farm/nodes/remote_checks.h"
#include "farm/nodes/remote_session.h"
#include "proto/wire/block_codec.h"
#include "proto/wire/job_messages.h"
#include "renderengine/io/text.h"

namespace antipode {
namespace {

/// Chunks under way at once: 8 MiB at most, which fills 600 Mbit/s over 100 ms.
constexpr uint32_t creditWindow = 64;

farm::ResultVerdict::Verdict messageOf(Verdict verdict) {
    switch (verdict) {
        case Verdict::Committed: return farm::ResultVerdict::COMMITTED;
        case Verdict::NotNeeded: return farm::ResultVerdict::NOT_NEEDED;
        case Verdict::Rejected: break;
    }
    return farm::ResultVerdict::REJECTED;
}

}  // namespace

ResultIntake::ResultIntake(Coordinator& coordinator, ReassemblyBudget& budget, wire::FramePort& port,
                           const RenderSettings& settings, size_t depth)
    : coordinator_(coordinator),
      budget_(budget),
      port_(port),
      settings_(settings),
      depth_(depth),
      bytes_(filmLayout(settings).values() * sizeof(int64_t)) {}

ResultIntake::~ResultIntake() {
    if (transfer_) budget_.give(bytes_);
}

void ResultIntake::offer(const farm::ResultOffer& offer, NodeId node, double now) {
    if (holds(offer.lease())) throw wire::ProtocolError("the server offers a result twice");
    if (offered_.size() >= depth_) throw wire::ProtocolError("the server offers more results than it may hold");
    const IterationRange range = rangeOf(offer);
    if (!coordinator_.wanted(node, offer.lease(), range, hexadecimal(offer.sha256()), now))
        return answer(offer.lease(), farm::ResultVerdict::NOT_NEEDED);
    offered_.push_back({offer, range});
    advance(now);
}

void ResultIntake::advance(double now) {
    if (transfer_ || offered_.empty() || !budget_.tryTake(bytes_)) return;
    const farm::ResultOffer& offer = offered_.front().offer;
    transfer_ = Transfer{.sums = {wire::layoutOf(settings_, offer.scale_exponent()),
                                  offer.count(),
                                  {},
                                  wire::fromMessage(offer.events())},
                         .lastChunk = now};
    transfer_->sums.values.resize(transfer_->sums.layout.values());
    transfer_->sums.residueIterations = transfer_->sums.layout.residueCounts(offered_.front().range);
    transfer_->hash.emplace(transfer_->sums);
    grantCredit(offer.lease());
}

void ResultIntake::chunk(const farm::ResultChunk& chunk, const std::string& payload, NodeId node, double now) {
    if (!transfer_ || chunk.lease() != offered_.front().offer.lease())
        throw wire::ProtocolError("the server sends a chunk of a result that was not asked for");
    if (chunk.index() != transfer_->received || chunk.index() >= transfer_->credited)
        throw wire::ProtocolError("the server sends a chunk out of order or without credit");
    const std::span<int64_t> values = wire::chunkOf(std::span<int64_t>(transfer_->sums.values), chunk.index());
    wire::decodeChunk(payload, values);
    transfer_->hash->add(values);
    ++transfer_->received;
    transfer_->lastChunk = now;
    const Offered& front = offered_.front();
    if (transfer_->received == front.offer.chunks()) return complete(node, now);
    // A result on its way is a sign of life of its lease.
    coordinator_.progress(node, front.offer.lease(), front.range.count, now);
    if (transfer_->credited - transfer_->received <= creditWindow / 2) grantCredit(front.offer.lease());
}

bool ResultIntake::holds(LeaseId lease) const {
    return std::any_of(offered_.begin(), offered_.end(), [&](const Offered& o) { return o.offer.lease() == lease; });
}

std::optional<double> ResultIntake::owedSince() const {
    return transfer_ ? std::optional(transfer_->lastChunk) : std::nullopt;
}

void ResultIntake::grantCredit(LeaseId lease) {
    const uint32_t credited = std::min(transfer_->received + creditWindow, offered_.front().offer.chunks());
    if (credited == transfer_->credited) return;
    farm::ResultCredit credit;
    credit.set_lease(lease);
    credit.set_chunks(credited - transfer_->credited);
    transfer_->credited = credited;
    port_.send(wire::makeFrame(wire::FrameType::ResultCredit, credit));
}

void ResultIntake::complete(NodeId node, double now) {
    const farm::ResultOffer& offer = offered_.front().offer;
    const LeaseId lease = offer.lease();
    const std::string sha256 = hexadecimal(offer.sha256());
    if (transfer_->hash->finish() != sha256) {
        coordinator_.reject(node, lease, now);
        answer(lease, farm::ResultVerdict::REJECTED);
    } else {
        BlockResult result{offered_.front().range, std::move(transfer_->sums), sha256,
                           wire::fromMessage(offer.statistics()), offer.seconds()};
        answer(lease, messageOf(coordinator_.deliver(node, lease, result, now)));
    }
    endTransfer();
    advance(now);
}

void ResultIntake::endTransfer() {
    transfer_.reset();
    budget_.give(bytes_);
    offered_.pop_front();
}

void ResultIntake::answer(LeaseId lease, farm::ResultVerdict::Verdict verdict) {
    farm::ResultVerdict message;
    message.set_lease(lease);
    message.set_verdict(verdict);
    port_.send(wire::makeFrame(wire::FrameType::ResultVerdict, message));
}

}  // namespace antipode
