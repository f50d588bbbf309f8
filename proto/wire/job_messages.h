// Between farm.proto's messages and the engine's structs.
#pragma once

#include "proto/farm.pb.h"
#include "renderengine/film.h"
#include "renderengine/renderer.h"
#include "renderengine/settings.h"

namespace antipode::wire {

/// `settings` must be resolved: initialRadius set, no single technique, no least path length.
farm::JobSettings toMessage(const RenderSettings& settings);
/// Throws Error(Usage) for what no engine takes: sizes of 0, numbers that are not finite, unknown techniques and
/// precisions …
RenderSettings fromMessage(const farm::JobSettings& message);

/// Lower-case hexadecimal SHA-256 over everything that decides the bytes of the job's image. Whoever gets a job hashes
/// what it understood of it: a setting of a newer build would otherwise be left out without a word.
std::string jobHash(const RenderSettings& settings, const std::string& sceneHash, const std::string& kernelHash);

/// What a client asks of every server. `job`: 16 bytes, its name; `scene`: where the scene starts.
farm::OpenJob makeOpenJob(const std::string& job, const RenderSettings& settings, const farm::BlobRef& scene,
                          const std::string& sceneHash, const std::string& kernelHash);

/// The job's film at these scales, one for each layer. Throws ProtocolError where there are more or fewer, or one that
/// no double has.
FilmLayout layoutOf(const RenderSettings& settings, const google::protobuf::RepeatedField<int32_t>& scaleExponents);

farm::EventCounts toMessage(const EventCounts& events);
/// Throws ProtocolError for sources and kinds that do not exist, and for counts that are 0 or come twice.
EventCounts fromMessage(const farm::EventCounts& message);

/// Only what adds up over iterations: stages, rays and light vertices.
farm::Statistics toMessage(const EngineStatistics& statistics);
/// Leaves out stages that no engine has: without a printable name or a sensible time, or too many.
EngineStatistics fromMessage(const farm::Statistics& message);
/// Adds what adds up over iterations.
void accumulate(EngineStatistics& total, const EngineStatistics& part);

}  // namespace antipode::wire
