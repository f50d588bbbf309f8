#include "techniques/job.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderengine/engine.h"
#include "renderengine/error.h"
#include "renderengine/setting_fields.h"

namespace antipode {
namespace {

using namespace shared;

void require(bool holds, const std::string& sentence) {
    if (!holds) throw Error(ErrorCode::Usage, sentence);
}

/// "the alpha must be above 0 and at most 1", "the number of light paths must be between 1 and 2^28".
std::string sentence(const SettingRange& range) {
    const auto text = [](double v) {
        int exponent = 0;
        const bool isPower = std::frexp(v, &exponent) == 0.5 && exponent > 17;
        return isPower ? "2^" + std::to_string(exponent - 1) : std::to_string(uint64_t(v));
    };
    const std::string subject = "the " + std::string(range.words) + " must be ";
    if (range.least >= 1) return subject + "between " + text(range.least) + " and " + text(range.greatest);
    if (range.greatest < std::numeric_limits<double>::max())
        return subject + "above 0 and at most " + text(range.greatest);
    return subject + "positive and finite";
}

Real4<double> with(const Vec3d& v, double w) { return {v.x, v.y, v.z, w}; }

/// No guide's length exceeds it: positions, and depths from the camera.
double greatestLength(const Scene& scene, const PackedScene& packed, const Vec3d& origin) {
    double coordinate = 0;
    for (const Vec3f& point : {packed.bounds.lower, packed.bounds.upper, scene.camera.position})
        for (int axis = 0; axis < 3; ++axis) {
            const double relative = std::abs(double(point[axis]));
            coordinate = std::max({coordinate, relative, relative + std::abs(origin[axis])});
        }
    return 4 * coordinate;  // 2·√3 of them lie between two points
}

int32_t exponentOf(LayerKind kind, int32_t radiance, int32_t length) {
    if (kind == LayerKind::Blur) return std::min(radiance, int32_t(BLUR_SCALE_EXPONENT));
    switch (unitOf(kind)) {
        case LayerUnit::Radiance: return radiance;
        case LayerUnit::None: return GUIDE_SCALE_EXPONENT;
        case LayerUnit::Length: return length;
    }
    return 0;
}

// layout.h and layers.h name the same things.
constexpr bool same(uint32_t bit, LayerKind kind) { return bit == 1u << uint32_t(kind); }
static_assert(same(LAYER_EMITTER_HIT, LayerKind::EmitterHit) && same(LAYER_NEXT_EVENT, LayerKind::NextEvent) &&
              same(LAYER_CONNECTION, LayerKind::Connection) && same(LAYER_MERGE, LayerKind::Merge) &&
              same(LAYER_SPLAT, LayerKind::Splat) && same(LAYER_ALBEDO, LayerKind::Albedo) &&
              same(LAYER_NORMAL, LayerKind::Normal) && same(LAYER_DEPTH, LayerKind::Depth) &&
              same(LAYER_POSITION, LayerKind::Position) && same(LAYER_COVERAGE, LayerKind::Coverage) &&
              same(LAYER_BLUR, LayerKind::Blur) && LAYER_BLUR == 1u << (layerKinds - 1));

}  // namespace

// Kernels keep lengths and queues in the bits and arrays of the layout, and count paths and vertices in 32 bits.
static_assert(SettingsLimits::pathLength == PATH_LENGTH_MASK);
static_assert(SettingsLimits::connectionsPerVertex == MAX_CONNECTIONS);
static_assert(SettingsLimits::lightPaths < UINT32_MAX && SettingsLimits::pixels < UINT32_MAX);

void checkSettings(const RenderSettings& s) {
    forEachField(s, [](auto field, const auto& value) {
        forEachEntry(value, [&](const auto& number) {
            if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(number)>>)
                require(field.range.holds(double(number)), sentence(field.range));
        });
    });
    require(uint64_t(s.width) * s.height <= SettingsLimits::pixels,
            "the image has more than 2^28 pixels; ask for a smaller one");
    const PixelWindow film = filmWindow(s);
    require(film.x0 < film.x1 && film.y0 < film.y1 && film.x1 <= s.width && film.y1 <= s.height,
            "the part to render, " + described(film) + ", is empty or reaches beyond the image of " +
                std::to_string(s.width) + "x" + std::to_string(s.height) + " pixels");
    require(s.russianRoulette || s.maxPathLength,
            "without Russian roulette the path length needs a limit (--max-path-length)");
    require(filmLayout(s).values() < UINT32_MAX,
            "the image and its layers have more than 2^32 sums; ask for fewer layers or a smaller image");
    planTechnique(s);
}

Job describeJob(const Scene& scene, const RenderSettings& settings, const PackedScene& packed, const Vec3d& origin) {
    checkSettings(settings);
    Job job;
    constexpr uint32_t meetable = FEATURE_LIGHT_TRIANGLES | FEATURE_LIGHT_SPHERES | FEATURE_ENVIRONMENT;
    job.plan = planTechnique(settings, (packed.features & meetable) != 0);
    job.seed = settings.seed;
    job.precision = settings.precision;
    job.sampler = settings.sampler;
    const PixelWindow film = filmWindow(settings);
    job.pixels = film.width() * film.height();
    if (settings.crop) job.features |= FEATURE_CROP;
    job.connectionsPerVertex = settings.connectionsPerVertex;
    job.initialRadius = initialRadius(scene, settings);
    job.alpha = settings.alpha;
    job.lightPathCountGiven = settings.lightPathCount.has_value();
    if (job.plan.lightPaths) job.lightPathCount = settings.lightPathCount.value_or(framePixels(settings));
    job.film = filmLayout(settings);
    const int32_t radianceExponent = filmScaleExponent(packed.greatestRadiance > 0.0 ? packed.greatestRadiance : 1.0);
    const int32_t lengthExponent = filmScaleExponent(greatestLength(scene, packed, origin));
    for (FilmLayer& layer : job.film.layers) {
        layer.scaleExponent = exponentOf(layer.kind, radianceExponent, lengthExponent);
        if (layer.kind != LayerKind::Image) job.layers |= 1u << uint32_t(layer.kind);
    }
    if (settings.guides == Guides::FirstHit) job.layers |= GUIDES_FIRST_HIT;

    const Camera& c = scene.camera;
    const Vec3d forward = normalize(Vec3d(c.forward));
    const Vec3d right = normalize(cross(forward, Vec3d(c.up)));
    const Vec3d up = cross(right, forward);
    const double planeDistance = c.orthographicHeight > 0
                                     ? settings.height / double(c.orthographicHeight)
                                     : 0.5 * settings.height / std::tan(0.5 * double(c.verticalFov));
    JobParameters<double>& p = job.parameters;
    p.cameraPosition = with(Vec3d(c.position), planeDistance);
    p.cameraForward = with(forward, double(c.lensRadius));
    p.cameraRight = with(right, double(c.focusDistance));
    p.cameraUp = with(up, std::ldexp(1.0, radianceExponent));
    p.worldOrigin = with(origin, std::ldexp(1.0, lengthExponent));
    p.sceneCenter = with(Vec3d(packed.bounds.center()), packed.bounds.radius());
    p.gridOrigin = with(Vec3d(packed.bounds.lower), 0.0);
    p.crop = {film.x0, film.y0, settings.width, settings.height};
    p.image = {film.width(), film.height(), packed.lightCount, packed.environmentLight};
    if (scene.environment) {
        p.gridOrigin.w = double(scene.environment->rotation) / (2.0 * 3.14159265358979323846);
        p.environment = with(Vec3d(scene.environment->radiance), double(packed.environmentPick));
        p.environmentSize = {scene.environment->width, scene.environment->height, scene.environment->zUp ? 1u : 0u, 0};
    }
    p.environmentSize.w = packed.moreAttributeTexels;
    const bool disperses = (packed.features & FEATURE_DISPERSION) != 0;
    const uint32_t longest = disperses ? GREATEST_DISPERSED_LENGTH : PATH_LENGTH_MASK;
    require(settings.maxPathLength.value_or(0) <= longest,
            "where glass disperses light, paths may have 32767 edges at most (--max-path-length)");
    p.lengths = {settings.minPathLength.value_or(1), settings.maxPathLength.value_or(longest), 0, 0};
    if (settings.single) {
        p.lengths.z = settings.single->s;
        p.lengths.w = settings.single->t;
    }
    return job;
}

}  // namespace antipode
