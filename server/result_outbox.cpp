#include "server/result_outbox.h"

#include <algorithm>
#include <utility>

#include "proto/farm.pb.h"
#include "proto/wire/block_codec.h"
#include "proto/wire/job_messages.h"
#include "renderengine/io/text.h"

namespace antipode {
namespace {

using wire::FrameType;

farm::ResultOffer offerOf(uint64_t lease, const BlockResult& result, uint32_t chunks) {
    farm::ResultOffer offer;
    offer.set_lease(lease);
    offer.set_first(result.range.first);
    offer.set_count(result.range.count);
    offer.set_sha256(fromHexadecimal(result.sha256));
    offer.set_width(result.sums.layout.width);
    offer.set_height(result.sums.layout.height);
    for (const FilmLayer& layer : result.sums.layout.layers) offer.add_scale_exponent(layer.scaleExponent);
    *offer.mutable_events() = wire::toMessage(result.sums.events);
    *offer.mutable_statistics() = wire::toMessage(result.statistics);
    offer.set_seconds(result.seconds);
    offer.set_chunks(chunks);
    return offer;
}

}  // namespace

ResultOutbox::ResultOutbox(const wire::FramePort& port, std::function<void(wire::Frame)> send)
    : port_(port), send_(std::move(send)) {}

void ResultOutbox::offer(uint64_t lease, std::shared_ptr<const BlockResult> result) {
    const uint32_t chunks = uint32_t(wire::chunkCount(result->sums.values.size()));
    send_(wire::makeFrame(FrameType::ResultOffer, offerOf(lease, *result, chunks)));
    items_[lease] = {std::move(result), chunks, 0, 0};
}

void ResultOutbox::credit(uint64_t lease, uint32_t chunks) {
    const auto found = items_.find(lease);
    if (found == items_.end()) return;
    Item& item = found->second;
    item.credits += std::min(chunks, item.chunks - item.credits);
    pump();
}

void ResultOutbox::settle(uint64_t lease) { items_.erase(lease); }

void ResultOutbox::pump() {
    for (auto& [lease, item] : items_) {
        while (item.sent < item.credits) {
            if (port_.queuedBytes() >= wire::shortQueueBytes) return;
            farm::ResultChunk chunk;
            chunk.set_lease(lease);
            chunk.set_index(item.sent);
            const std::span<const int64_t> values = item.result->sums.values;
            send_(wire::makeFrame(FrameType::ResultChunk, chunk, wire::encodeChunk(wire::chunkOf(values, item.sent))));
            ++item.sent;
        }
    }
}

}  // namespace antipode
