#include "farm/nodes/remote_session.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

#include "farm/nodes/remote_checks.h"
#include "farm/nodes/result_intake.h"
#include "farm/nodes/scene_upload.h"
#include "proto/wire/job_messages.h"
#include "renderengine/io/text.h"

namespace antipode {
namespace {

constexpr uint32_t maxLeaseDepth = 8;
constexpr size_t maxReasonBytes = 1024;
/// More is queued only where the server does not read; uploads stop at a short queue and a chunk.
constexpr size_t maxQueuedBytes = 8 << 20;
/// A server that owes a chunk for this many times the silence holds a share of the reassembly budget in vain.
constexpr double patienceForChunk = 3;

std::string seconds(double value) { return std::to_string(std::lround(value)) + " s"; }

}  // namespace

bool ReassemblyBudget::tryTake(uint64_t bytes) {
    if (taken_ != 0 && (taken_ > whole_ || bytes > whole_ - taken_)) return false;
    taken_ += bytes;
    return true;
}

struct RemoteSession::Impl {
    Impl(RemoteContext& context_, wire::FramePort& port_, std::string name_, NodePort& node_, double now_)
        : context(context_),
          port(port_),
          name(std::move(name_)),
          nodePort(node_),
          settings(wire::fromMessage(context_.openJob.settings())),
          upload(context_.scene),
          start(now_),
          now(now_),
          lastHeard(now_),
          lastHeartbeat(now_) {}

    // ---- What a server says, see proto/farm.proto

    void receive(const wire::Frame& frame) {
        switch (frame.type) {
            case wire::FrameType::Heartbeat: wire::parseMessage<farm::Heartbeat>(frame); return;
            case wire::FrameType::Refusal: return refused(wire::parseMessage<farm::Refusal>(frame));
            default: break;
        }
        switch (phase) {
            case Phase::Greeting: return receiveGreeting(frame);
            case Phase::Uploading:
            case Phase::Building: return receiveOpening(frame);
            case Phase::Ready: return receiveReady(frame);
            case Phase::Ended: return;
        }
    }

    void receiveGreeting(const wire::Frame& frame) {
        if (frame.type != wire::FrameType::Welcome) throw unexpected(frame, "before Welcome");
        welcomed(wire::parseMessage<farm::Welcome>(frame));
    }

    void receiveOpening(const wire::Frame& frame) {
        switch (frame.type) {
            case wire::FrameType::NeedBlobs:
                upload.need(wire::parseMessage<farm::NeedBlobs>(frame));
                return advanceUpload();
            case wire::FrameType::JobReady: return jobReady(wire::parseMessage<farm::JobReady>(frame));
            case wire::FrameType::Draining: return drained(wire::parseMessage<farm::Draining>(frame));
            default: throw unexpected(frame, "before JobReady");
        }
    }

    void receiveReady(const wire::Frame& frame) {
        switch (frame.type) {
            case wire::FrameType::Progress: return progressed(wire::parseMessage<farm::Progress>(frame));
            case wire::FrameType::LeaseReturned: return returned(wire::parseMessage<farm::LeaseReturned>(frame));
            case wire::FrameType::ResultOffer: return offered(wire::parseMessage<farm::ResultOffer>(frame));
            case wire::FrameType::ResultChunk:
                return intake->chunk(wire::parseMessage<farm::ResultChunk>(frame), frame.payload, *node, now);
            case wire::FrameType::Draining: return drained(wire::parseMessage<farm::Draining>(frame));
            case wire::FrameType::Capacity:
                return context.coordinator.setWidth(*node, wire::parseMessage<farm::Capacity>(frame).width(), now);
            default: throw unexpected(frame, "after JobReady");
        }
    }

    static wire::ProtocolError unexpected(const wire::Frame& frame, const char* when) {
        return wire::ProtocolError("a frame of type " + std::to_string(int(frame.type)) + " must not come " + when);
    }

    void welcomed(farm::Welcome message) {
        checkWelcome(message);
        welcome = std::move(message);
        if (const auto reason = incompatibility(context.hello, welcome))
            return fail(*reason, farm::Refusal::INCOMPATIBLE);
        port.send(wire::makeFrame(wire::FrameType::OpenJob, context.openJob));
        phase = Phase::Building;
    }

    void advanceUpload() {
        upload.advance(port);
        phase = upload.done() ? Phase::Building : Phase::Uploading;
    }

    void jobReady(const farm::JobReady& ready) {
        checkJobReady(ready);
        const double radius = context.openJob.settings().initial_radius();
        if (std::bit_cast<uint64_t>(ready.initial_radius()) != std::bit_cast<uint64_t>(radius))
            return fail("The server would begin with another merge radius than this job's: it is build " +
                            welcome.build() + ", this client is build " + context.hello.build() +
                            "; install the same on both.",
                        farm::Refusal::INCOMPATIBLE);
        upload.cancel();
        const uint32_t depth = std::min(welcome.lease_depth(), maxLeaseDepth);
        // Results of as many leases again may have waited for this connection.
        intake.emplace(context.coordinator, context.budget, port, settings, 2 * depth);
        phase = Phase::Ready;
        end.wasReady = true;
        const farm::Device& device = welcome.device();
        const std::string renderings = ready.renderings().empty() ? renderingClass(device.device_class(), settings,
                                                                                   ready.light_paths_per_iteration())
                                                                  : ready.renderings();
        node = context.coordinator.addNode({name, device.name(), renderings, depth, ready.width()}, nodePort, now);
        if (draining) context.coordinator.retireNode(*node, now);
    }

    void progressed(const farm::Progress& progress) {
        const auto lease = granted.find(progress.lease());
        if (lease != granted.end() && progress.done() > lease->second.count)
            throw wire::ProtocolError("the server reports more iterations than were leased");
        context.coordinator.progress(*node, progress.lease(), progress.done(), now);
    }

    void returned(const farm::LeaseReturned& message) {
        if (intake->holds(message.lease()))
            throw wire::ProtocolError("the server returns a lease that it has rendered");
        granted.erase(message.lease());
        context.coordinator.returned(*node, message.lease(), now);
    }

    void offered(const farm::ResultOffer& offer) {
        checkOffer(offer, settings);
        // Leases from before a reconnect are not in `granted`; the coordinator knows them.
        if (const auto lease = granted.find(offer.lease()); lease != granted.end()) {
            if (offer.first() != lease->second.first || offer.count() > lease->second.count)
                throw wire::ProtocolError("a result is of other iterations than were leased");
            granted.erase(lease);
        }
        intake->offer(offer, *node, now);
    }

    void drained(const farm::Draining&) {
        draining = true;
        if (node) context.coordinator.retireNode(*node, now);
    }

    void refused(const farm::Refusal& refusal) {
        const bool known = farm::Refusal::Code_IsValid(refusal.code());
        fail(readableText(refusal.sentence(), maxReasonBytes), known ? refusal.code() : farm::Refusal::UNKNOWN);
    }

    // ---- Time

    void tick() {
        if (phase == Phase::Ended) return;
        const wire::Liveness& liveness = context.liveness;
        if (phase == Phase::Greeting && now - start > liveness.helloSeconds)
            return fail("The server has not answered within " + seconds(liveness.helloSeconds) + ".");
        if (now - lastHeard > liveness.silenceSeconds)
            return fail("The server has been silent for " + seconds(now - lastHeard) + ".");
        if (port.queuedBytes() > maxQueuedBytes) return fail("The server does not read what it is sent.");
        if (phase == Phase::Uploading) advanceUpload();
        if (intake) {
            const auto owed = intake->owedSince();
            if (owed && now - *owed > patienceForChunk * liveness.silenceSeconds)
                return fail("The server has offered a result but not sent it for " + seconds(now - *owed) + ".");
            intake->advance(now);
        }
        // Whatever is queued tells the server as much.
        if (now - lastHeartbeat >= liveness.heartbeatSeconds && port.queuedBytes() == 0) {
            port.send(wire::makeFrame(wire::FrameType::Heartbeat, farm::Heartbeat()));
            lastHeartbeat = now;
        }
    }

    // ---- The end

    void fail(std::string reason, farm::Refusal::Code refusal = farm::Refusal::UNKNOWN) {
        end.refusal = refusal;
        end.reason = std::move(reason);
        leave();
        port.close(end.reason);
    }

    void leave() {
        phase = Phase::Ended;
        intake.reset();
        granted.clear();
        if (node) context.coordinator.removeNode(*node, now);
        node.reset();
    }

    RemoteContext& context;
    wire::FramePort& port;
    const std::string name;
    NodePort& nodePort;

    Phase phase = Phase::Greeting;
    const RenderSettings settings;
    farm::Welcome welcome;
    SceneUpload upload;
    std::optional<ResultIntake> intake;         ///< from JobReady on
    std::optional<NodeId> node;                 ///< from JobReady on
    std::map<LeaseId, IterationRange> granted;  ///< on this connection, neither returned nor offered
    bool draining = false;
    RemoteEnd end;
    const double start;
    double now, lastHeard, lastHeartbeat;
};

RemoteSession::RemoteSession(RemoteContext& context, wire::FramePort& port, std::string name, double now)
    : impl_(std::make_unique<Impl>(context, port, std::move(name), static_cast<NodePort&>(*this), now)) {
    port.send(wire::makeFrame(wire::FrameType::Hello, context.hello));
}

RemoteSession::~RemoteSession() {
    if (impl_->phase != Phase::Ended) impl_->leave();
}

void RemoteSession::heard(double now) { impl_->lastHeard = now; }

void RemoteSession::receive(const wire::Frame& frame, double now) {
    if (impl_->phase == Phase::Ended) return;
    impl_->now = now;
    impl_->receive(frame);
}

void RemoteSession::tick(double now) {
    impl_->now = now;
    impl_->tick();
}

void RemoteSession::disconnected(const std::string& reason, double now) {
    if (impl_->phase == Phase::Ended) return;
    impl_->now = now;
    impl_->end.reason = reason;
    impl_->leave();
}

void RemoteSession::finish() {
    if (impl_->phase == Phase::Ended) return;
    impl_->port.send(wire::makeFrame(wire::FrameType::CloseJob, farm::CloseJob()));
    impl_->fail("The job is finished.");
}

RemoteSession::Phase RemoteSession::phase() const { return impl_->phase; }
uint64_t RemoteSession::uploadedBytes() const { return impl_->upload.sentBytes(); }
uint64_t RemoteSession::uploadBytes() const { return impl_->upload.neededBytes(); }
const farm::Welcome& RemoteSession::welcome() const { return impl_->welcome; }
const RemoteEnd& RemoteSession::end() const { return impl_->end; }

void RemoteSession::grant(const Lease& lease) {
    impl_->granted.emplace(lease.id, lease.range);
    farm::LeaseGrant message;
    message.set_lease(lease.id);
    message.set_first(lease.range.first);
    message.set_count(lease.range.count);
    impl_->port.send(wire::makeFrame(wire::FrameType::LeaseGrant, message));
}

void RemoteSession::truncate(LeaseId lease) {
    farm::Truncate message;
    message.set_lease(lease);
    impl_->port.send(wire::makeFrame(wire::FrameType::Truncate, message));
}

}  // namespace antipode
