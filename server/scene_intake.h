// How a job's scene comes to the server: asks for what the cache lacks, takes the chunks, puts the scene together.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "proto/farm.pb.h"
#include "renderengine/engine.h"
#include "renderengine/scene.h"
#include "server/scene_cache.h"

namespace antipode {

/// Runs `work` elsewhere, where it may take seconds, then `done` on the sessions' thread. Must call both, unless the
/// process ends. The scene cache outlives all work.
using Background = std::function<void(std::function<void()> work, std::function<void()> done)>;
/// Both at once: for simulations.
void runAtOnce(const std::function<void()>& work, const std::function<void()>& done);

/// What an intake tells its session; the session may let go of the intake then.
class IntakeListener {
public:
    virtual ~IntakeListener() = default;
    virtual void need(const farm::NeedBlobs& blobs) = 0;
    /// The root is here and says how large the job is: before the rest is asked for. Nothing where it may go on.
    virtual std::optional<farm::Refusal> admit(const JobSize& size, uint64_t sceneBytes) = 0;
    virtual void assembled(std::shared_ptr<const Scene> scene, const JobSize& size, uint64_t sceneBytes) = 0;
    virtual void refused(const farm::Refusal& refusal) = 0;
};

/// Held by shared_ptr. Work that runs in the background when the intake goes is abandoned; nobody is told any more.
class SceneIntake : public std::enable_shared_from_this<SceneIntake> {
public:
    /// `job` has been validated, but for what its root holds. Cache and listener outlive the intake.
    SceneIntake(SceneCache& cache, Background background, farm::OpenJob job, IntakeListener& listener);
    ~SceneIntake();
    SceneIntake(const SceneIntake&) = delete;
    SceneIntake& operator=(const SceneIntake&) = delete;

    /// May call the listener before it returns.
    void start();
    /// Throws wire::ProtocolError where the chunk is not the one that has to come next.
    void receive(const farm::BlobChunk& chunk, std::string_view bytes);
    /// The client has to send, rather than to wait.
    bool expectsChunks() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antipode
