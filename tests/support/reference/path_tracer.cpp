#include "support/reference/path_tracer.h"

#include <cmath>
#include <utility>

#include "renderengine/error.h"

namespace antipode::reference {

void RadianceMoments::add(const Vec3d& radiance) {
    r.add(radiance.x);
    g.add(radiance.y);
    b.add(radiance.z);
}

PathTracer::PathTracer(Scene scene) : scene_(std::move(scene)), geometry_(scene_), lights_(scene_, geometry_) {
    for (const Material& material : scene_.materials) requireSupported(material);
}

/// Solid-angle density with which next event estimation picks this direction, picking of the light included.
double PathTracer::nextEventPdf(const Light& light, double pick, const LightPoint& point, double distance) const {
    const double pdf = pick * pdfDirect(light, point);
    return light.isInfinite() ? pdf : pdf * distance * distance / cosineAtLight(light, point);
}

Vec3d PathTracer::nextEvent(const Hit& hit, const Frame& frame, const Vec3d& wo, const PathTracerOptions& options,
                            Random& random) const {
    const Material& material = scene_.materials[hit.material];
    const size_t index = lights_.pick(random);
    const Light& light = lights_.lights()[index];
    const auto sample = sampleDirect(light, hit.position, random);
    if (!sample) return {};
    const Vec3d wi = frame.toLocal(sample->wi);
    const Vec3d f = evalBsdf(material, wo, wi);
    if (!(maxComponent(f) > 0)) return {};
    if (geometry_.occluded({hit.position, sample->wi, hit.primitive}, sample->distance, light.primitive)) return {};

    const double pick = lights_.pickProbability(index);
    const double survival = options.russianRoulette ? rouletteSurvival(material) : 1;
    const double hitPdf = light.isDelta() ? 0 : survival * pdfBsdf(material, wo, wi);
    const double weight = light.isDelta() ? 1 : pick * sample->pdf / (pick * sample->pdf + hitPdf);
    return f * sample->weight * (std::abs(wi.z) / pick * weight);
}

Vec3d PathTracer::radiance(const Ray& start, const PathTracerOptions& options, Random& random) const {
    if (!options.russianRoulette && options.maxPathLength == std::numeric_limits<uint32_t>::max())
        throw Error(ErrorCode::Usage, "Without Russian roulette the path length must be bounded.");

    Vec3d sum, throughput(1.0);
    Ray ray = start;
    double scatterPdf = 0;  // solid-angle density of ray.direction, survival included
    bool onlyHit = true;    // next event could not have made this edge: first edge, or a specular vertex before it
    for (uint32_t edges = 1; edges <= options.maxPathLength; ++edges) {
        const auto hit = geometry_.intersect(ray);

        // Emission at the end of this edge.
        const auto index = hit ? lights_.ofPrimitive(hit->primitive) : lights_.environment();
        if (index && edges >= options.minPathLength) {
            const Light& light = lights_.lights()[*index];
            const LightPoint point{hit ? hit->position : Vec3d(), hit ? hit->normal : Vec3d(), -ray.direction};
            const double competing =
                onlyHit || !options.nextEvent
                    ? 0
                    : nextEventPdf(light, lights_.pickProbability(*index), point, hit ? hit->distance : 1);
            const double weight = competing == 0 ? 1 : scatterPdf / (scatterPdf + competing);
            sum += throughput * emitted(light, point) * weight;
        }
        if (!hit || edges == options.maxPathLength) break;

        const Material& material = scene_.materials[hit->material];
        const Frame frame(hit->normal);
        const Vec3d wo = frame.toLocal(-ray.direction);
        if (options.nextEvent && !isSpecular(material) && edges + 1 >= options.minPathLength)
            sum += throughput * nextEvent(*hit, frame, wo, options, random);

        const double survival = options.russianRoulette ? rouletteSurvival(material) : 1;
        if (survival < 1 && random.uniform() >= survival) break;
        const auto sample = sampleBsdf(material, wo, random);
        if (!sample) break;
        throughput *= sample->weight / survival;
        scatterPdf = sample->pdf * survival;
        onlyHit = sample->specular;
        ray = {hit->position, frame.toWorld(sample->wi), hit->primitive};
    }
    return sum;
}

RadianceMoments PathTracer::radianceMoments(const Ray& ray, const PathTracerOptions& options, uint64_t samples,
                                            uint64_t seed) const {
    Random random(seed);
    RadianceMoments moments;
    for (uint64_t i = 0; i < samples; ++i) moments.add(radiance(ray, options, random));
    return moments;
}

std::vector<RadianceMoments> PathTracer::image(uint32_t width, uint32_t height, const PathTracerOptions& options,
                                               uint64_t samples, uint64_t seed) const {
    const PinholeCamera camera(scene_.camera, width, height);
    Random random(seed);
    std::vector<RadianceMoments> pixels(size_t(width) * height);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            for (uint64_t i = 0; i < samples; ++i) {
                const double px = x + random.uniform(), py = y + random.uniform();
                pixels[size_t(y) * width + x].add(radiance(camera.ray(px, py), options, random));
            }
    return pixels;
}

}  // namespace antipode::reference
