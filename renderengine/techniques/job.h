// What is constant over a job's iterations, in the layout that the kernels read.
#pragma once

#include "gpu/packed_scene.h"
#include "renderengine/film_layout.h"
#include "renderengine/settings.h"
#include "techniques/technique.h"

namespace antipode {

struct Job {
    /// In double for the host; kernels in float read them rounded.
    shared::JobParameters<double> parameters;
    TechniquePlan plan;
    uint64_t seed = 1;
    uint64_t lightPathCount = 0;       ///< N; 0 where no light path is traced
    bool lightPathCountGiven = false;  ///< by the settings; otherwise N may be lowered to what the device can store
    uint32_t pixels = 0;               ///< of the film
    uint32_t features = 0;             ///< FEATURE_* bits that the settings ask for, beside the scene's
    uint32_t connectionsPerVertex = 1;
    double initialRadius = 0, alpha = 2.0 / 3.0;
    FilmLayout film;
    uint32_t layers = 0;  ///< LAYER_* bits of those behind the image, and GUIDES_FIRST_HIT
    Precision precision = Precision::Float;
    Sampler sampler = Sampler::Sobol;
};

/// Bytes of a record (kernels/lib/record.glsl).
constexpr uint64_t recordBytes(Precision precision) { return precision == Precision::Double ? 32 : 16; }

/// Throws Error(Usage) for settings that make no sense: a size of 0, α outside (0,1], no roulette and no length limit …
/// `origin`: the vector from the scene's origin to that of the user's positions.
Job describeJob(const Scene& scene, const RenderSettings& settings, const PackedScene& packed,
                const Vec3d& origin = {});

}  // namespace antipode
