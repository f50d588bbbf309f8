#include "server/server_session.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "terminal/text.h"
#include "proto/wire/job_messages.h"
#include "proto/wire/scene_package.h"
#include "renderengine/error.h"
#include "renderengine/io/text.h"
#include "server/admission.h"
#include "server/result_outbox.h"

namespace antipode {
namespace {

using farm::Refusal;
using wire::Frame;
using wire::FrameType;
using wire::ProtocolError;

constexpr double progressSeconds = 0.5;
/// How long a client may leave the server waiting for OpenJob or a chunk, though it lives.
constexpr double stallSeconds = 60;
/// Of answers that a client does not read while it asks on.
constexpr size_t unreadBytes = 16 << 20;

/// Of a peer's words in a log: 200 bytes, of which the ellipsis takes three.
constexpr size_t mostShown = 197;

bool isHash(const std::string& digits) {
    return digits.size() == 64 && digits.find_first_not_of("0123456789abcdef") == std::string::npos;
}

Refusal::Code refusalCode(ErrorCode code) {
    switch (code) {
        case ErrorCode::Usage: return Refusal::BAD_JOB;
        case ErrorCode::Input: return Refusal::BAD_SCENE;
        case ErrorCode::Output:
        case ErrorCode::Device: break;
    }
    return Refusal::DEVICE_FAILED;
}

/// Why this server does not work for such a client.
std::optional<Refusal> incompatibility(const farm::Hello& hello, const farm::Welcome& server) {
    const std::string builds =
        "The client is build " + readableText(hello.build(), mostShown) + ", the server " + server.build();
    const std::string advice = ": use the same build on both.";
    const std::string ours = std::to_string(wire::protocolVersion);
    if (hello.oldest_protocol() > wire::protocolVersion || hello.newest_protocol() < wire::protocolVersion)
        return refusal(Refusal::INCOMPATIBLE,
                       builds + "; the client speaks protocol " + std::to_string(hello.oldest_protocol()) + " to " +
                           std::to_string(hello.newest_protocol()) + ", the server " + ours + advice);
    if (hello.kernel_hash() != server.kernel_hash())
        return refusal(Refusal::INCOMPATIBLE, builds + "; their kernels differ (" +
                                                  readableText(hello.kernel_hash().substr(0, 12)) + " and " +
                                                  server.kernel_hash().substr(0, 12) + ")" + advice);
    return {};
}

}  // namespace

struct ServerSession::Impl final : private JobListener, private IntakeListener {
    enum class Phase { Greeting, Introduced, Loading, Building, Ready, Ended };

    Impl(ServerContext& context, wire::FramePort& port, double now)
        : context_(context),
          port_(port),
          outbox_(port, [this](Frame frame) { send(std::move(frame)); }),
          now_(now),
          started_(now),
          lastHeard_(now),
          lastSent_(now),
          lastStep_(now) {}
    ~Impl() override {
        leave();
        if (introduced_) --context_.clients;
    }

    // ---- What comes

    void receive(const Frame& frame, double now) {
        if (phase_ == Phase::Ended) return;
        now_ = now;
        if (phase_ == Phase::Greeting && frame.type != FrameType::Hello)
            throw ProtocolError("The first message has to be Hello.");
        switch (frame.type) {
            case FrameType::Hello: return hello(wire::parseMessage<farm::Hello>(frame));
            case FrameType::Heartbeat: wire::parseMessage<farm::Heartbeat>(frame); return;
            case FrameType::Refusal:
                return end("the client refused: " +
                           readableText(wire::parseMessage<farm::Refusal>(frame).sentence(), mostShown));
            case FrameType::OpenJob: return openJob(wire::parseMessage<farm::OpenJob>(frame));
            case FrameType::BlobChunk: return blobChunk(frame);
            case FrameType::CloseJob: wire::parseMessage<farm::CloseJob>(frame); return closeJob();
            case FrameType::LeaseGrant: return grant(ready<farm::LeaseGrant>(frame));
            case FrameType::Truncate: return context_.queue.truncate(job_, ready<farm::Truncate>(frame).lease());
            case FrameType::ResultCredit: {
                const auto credit = ready<farm::ResultCredit>(frame);
                return outbox_.credit(credit.lease(), credit.chunks());
            }
            case FrameType::ResultVerdict: return verdict(ready<farm::ResultVerdict>(frame));
            case FrameType::Welcome:
            case FrameType::Draining:
            case FrameType::NeedBlobs:
            case FrameType::JobReady:
            case FrameType::Capacity:
            case FrameType::Progress:
            case FrameType::LeaseReturned:
            case FrameType::ResultOffer:
            case FrameType::ResultChunk: break;
        }
        throw ProtocolError("A message came that only servers send.");
    }

    /// A message about leases, which makes sense only once the job is ready.
    template <class Message>
    Message ready(const Frame& frame) const {
        if (phase_ != Phase::Ready) throw ProtocolError("A message about leases came before the job was ready.");
        return wire::parseMessage<Message>(frame);
    }

    void hello(const farm::Hello& hello) {
        if (phase_ != Phase::Greeting) throw ProtocolError("Hello came twice.");
        client_ = readableText(hello.client(), mostShown);
        greeted_ = true;
        if (const auto refused = incompatibility(hello, context_.welcome)) return refuse(*refused);
        if (context_.clients >= context_.maxClients)
            return refuse(refusal(Refusal::BUSY, "The server has " + std::to_string(context_.maxClients) +
                                                     " clients already; try again later."));
        introduced_ = true;
        ++context_.clients;
        farm::Welcome welcome = context_.welcome;
        welcome.set_protocol(wire::protocolVersion);
        phase_ = Phase::Introduced;
        lastStep_ = now_;
        say("connected");
        sendMessage(FrameType::Welcome, welcome);
    }

    void openJob(const farm::OpenJob& job) {
        if (phase_ != Phase::Introduced) throw ProtocolError("A connection opens one job only.");
        if (job.job().size() != 16 || job.scene().sha256().size() != 32 || job.scene().size() == 0 ||
            !isHash(job.scene_hash()))
            throw ProtocolError("OpenJob needs a name of 16 bytes, a scene's root and a scene's hash.");
        RenderSettings settings;
        try {
            settings = wire::fromMessage(job.settings());
        } catch (const Error& error) {
            return refuse(refusal(Refusal::BAD_JOB, error.what()));
        }
        if (job.job_hash() != wire::jobHash(settings, job.scene_hash(), context_.welcome.kernel_hash()))
            return refuse(refusal(Refusal::BAD_JOB,
                                  "This server reads the job's settings otherwise than the client means them: install "
                                  "the same build on both."));
        open_ = job;
        if (context_.queue.knows(job.job())) return enterQueue(nullptr, 0, 0);
        if (context_.draining) return refuse(refusal(Refusal::DRAINING, "The server is going down: use another one."));
        const JobSize size = sizeOf(settings);
        if (const auto refused = context_.queue.admission(size, job.scene().size())) return refuse(*refused);
        if (job.scene().size() > wire::maxSceneRootBytes)
            return refuse(refusal(Refusal::TOO_LARGE, "The scene's root has " + byteSize(job.scene().size()) +
                                                          "; servers take at most " +
                                                          byteSize(wire::maxSceneRootBytes) + "."));
        phase_ = Phase::Loading;
        intake_ = std::make_shared<SceneIntake>(context_.cache, context_.background, job,
                                                static_cast<IntakeListener&>(*this));
        const auto intake = intake_;  // it may be let go of meanwhile
        intake->start();
    }

    void blobChunk(const Frame& frame) {
        const auto intake = intake_;
        if (!intake) throw ProtocolError("A blob's chunk came that was not asked for.");
        farm::BlobChunk chunk;
        wire::parseInto(frame, chunk);
        lastStep_ = now_;
        intake->receive(chunk, frame.payload);
    }

    void closeJob() {
        if (std::exchange(attached_, false)) context_.queue.close(job_);
        end("the client is done");
    }

    void grant(const farm::LeaseGrant& lease) {
        context_.queue.lease(job_, lease.lease(), {lease.first(), lease.count()});
    }

    void verdict(const farm::ResultVerdict& verdict) {
        switch (verdict.verdict()) {
            case farm::ResultVerdict::COMMITTED:
            case farm::ResultVerdict::NOT_NEEDED:
            case farm::ResultVerdict::REJECTED: break;
            default: throw ProtocolError("A result has a verdict that does not exist.");
        }
        outbox_.settle(verdict.lease());
        context_.queue.settle(job_, verdict.lease());
        outbox_.pump();
    }

    // ---- What the intake says

    void need(const farm::NeedBlobs& blobs) override {
        lastStep_ = now_;
        sendMessage(FrameType::NeedBlobs, blobs);
    }

    std::optional<Refusal> admit(const JobSize& size, uint64_t sceneBytes) override {
        return context_.queue.admission(size, sceneBytes);
    }

    void assembled(std::shared_ptr<const Scene> scene, const JobSize& size, uint64_t sceneBytes) override {
        if (!context_.queue.knows(open_.job()))
            if (const auto refused = context_.queue.admission(size, sceneBytes)) return refuse(*refused);
        enterQueue(std::move(scene), context_.queue.estimate(size), sceneBytes);
    }

    void refused(const Refusal& refusal) override { refuse(refusal); }

    void enterQueue(std::shared_ptr<const Scene> scene, uint64_t deviceBytes, uint64_t sceneBytes) {
        intake_.reset();
        phase_ = Phase::Building;
        job_ = open_.job();
        attached_ = true;
        say("opens a job: " + std::to_string(open_.settings().width()) + "x" +
            std::to_string(open_.settings().height()) + ", " + readableText(open_.settings().technique(), mostShown) +
            (open_.settings().precision() == farm::JobSettings::DOUBLE ? ", double precision" : ""));
        if (const auto refused = context_.queue.open(job_, open_.settings(), open_.scene_hash(), std::move(scene),
                                                     deviceBytes, sceneBytes, *this)) {
            attached_ = false;
            refuse(*refused);
        }
        open_.Clear();
    }

    // ---- What the queue says

    void jobReady(const JobReady& ready) override {
        phase_ = Phase::Ready;
        farm::JobReady message;
        message.set_initial_radius(ready.initialRadius);
        message.set_light_paths_per_iteration(ready.lightPathsPerIteration);
        message.set_device_bytes(ready.deviceBytes);
        message.set_build_seconds(ready.seconds);
        message.set_renderings(ready.renderings);
        message.set_width(ready.width);
        sendMessage(FrameType::JobReady, message);
    }

    void widthChanged(uint32_t width) override {
        farm::Capacity message;
        message.set_width(width);
        sendMessage(FrameType::Capacity, message);
    }

    void jobFailed(const Error& error) override {
        attached_ = false;
        refuse(refusal(refusalCode(error.code()), error.what()));
    }

    void jobTaken() override {
        attached_ = false;
        end("the client has opened the job on another connection");
    }

    void progress(uint64_t lease, uint64_t done) override {
        progress_.try_emplace(lease, LeaseProgress{0, 0, now_}).first->second.done = done;
    }

    void resultReady(uint64_t lease) override {
        forgetProgress(lease);
        outbox_.offer(lease, context_.queue.result(job_, lease));
    }

    void leaseReturned(uint64_t lease, const std::string& reason) override {
        forgetProgress(lease);
        farm::LeaseReturned message;
        message.set_lease(lease);
        message.set_reason(reason);
        sendMessage(FrameType::LeaseReturned, message);
    }

    // ---- Time

    void tick(double now) {
        if (phase_ == Phase::Ended) return;
        now_ = now;
        if (phase_ == Phase::Greeting) {
            if (now - started_ > context_.liveness.helloSeconds) end("no Hello in time");
            return;
        }
        if (now - lastHeard_ > context_.liveness.silenceSeconds) return end("the client has fallen silent");
        const bool waits = phase_ == Phase::Introduced || (intake_ && intake_->expectsChunks());
        if (waits && now - lastStep_ > stallSeconds) return end("the client does not go on");
        if (context_.draining) drain();
        sendProgress();
        outbox_.pump();
        if (phase_ != Phase::Ended && now - lastSent_ >= context_.liveness.heartbeatSeconds)
            sendMessage(FrameType::Heartbeat, farm::Heartbeat());
    }

    /// Says so once; ends the connection as soon as nothing is left to be fetched.
    void drain() {
        if (!std::exchange(drainingSaid_, true)) sendMessage(FrameType::Draining, farm::Draining());
        const bool resultsToCome = phase_ == Phase::Ready && !context_.queue.settled(job_);
        if (!resultsToCome) refuse(refusal(Refusal::DRAINING, "The server is going down: use another one."));
    }

    void sendProgress() {
        for (auto& [lease, progress] : progress_) {
            if (progress.done == progress.said || now_ - progress.lastSent < progressSeconds) continue;
            progress.said = progress.done;
            progress.lastSent = now_;
            farm::Progress message;
            message.set_lease(lease);
            message.set_done(progress.done);
            sendMessage(FrameType::Progress, message);
        }
    }

    void forgetProgress(uint64_t lease) { progress_.erase(lease); }

    // ---- What goes

    void sendMessage(FrameType type, const google::protobuf::MessageLite& message) {
        send(wire::makeFrame(type, message));
    }

    void send(Frame frame) {
        if (phase_ == Phase::Ended) return;
        if (port_.queuedBytes() > unreadBytes) return end("the client does not read");
        lastSent_ = now_;
        port_.send(std::move(frame));
    }

    void refuse(const Refusal& refusal) {
        sendMessage(FrameType::Refusal, refusal);
        end("refused: " + refusal.sentence());
    }

    void end(const std::string& reason) {
        if (std::exchange(phase_, Phase::Ended) == Phase::Ended) return;
        if (greeted_) say(reason);
        port_.close(reason);
        leave();
    }

    void say(const std::string& event) const {
        if (context_.log) context_.log(client_, event);
    }

    /// Lets go of what others hold for this session.
    void leave() {
        phase_ = Phase::Ended;
        intake_.reset();
        if (std::exchange(attached_, false)) context_.queue.detach(job_, *this, now_);
    }

    struct LeaseProgress {
        uint64_t done, said;
        double lastSent;
    };

    ServerContext& context_;
    wire::FramePort& port_;
    ResultOutbox outbox_;
    Phase phase_ = Phase::Greeting;
    bool greeted_ = false, introduced_ = false;  // Hello came, and was accepted
    bool drainingSaid_ = false;
    std::string client_;
    farm::OpenJob open_;  // until the queue has it
    std::shared_ptr<SceneIntake> intake_;
    std::string job_;  // in the queue, where `attached_`
    bool attached_ = false;
    std::map<uint64_t, LeaseProgress> progress_;  // of the blocks in hand, by lease
    double now_, started_, lastHeard_, lastSent_;
    double lastStep_;  // when the client last did, or was last told, what comes next
};

ServerSession::ServerSession(ServerContext& context, wire::FramePort& port, double now)
    : impl_(std::make_unique<Impl>(context, port, now)) {}
ServerSession::~ServerSession() = default;

void ServerSession::heard(double now) { impl_->lastHeard_ = now; }
void ServerSession::receive(const Frame& frame, double now) { impl_->receive(frame, now); }
void ServerSession::tick(double now) { impl_->tick(now); }

void ServerSession::disconnected(const std::string& reason, double now) {
    impl_->now_ = now;
    if (impl_->introduced_ && impl_->phase_ != Impl::Phase::Ended) impl_->say("connection lost: " + reason);
    impl_->leave();
}

std::string ServerSession::client() const { return impl_->client_; }
bool ServerSession::introduced() const { return impl_->introduced_; }

}  // namespace antipode
