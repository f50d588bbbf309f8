#include "tests/benchmarks/embree_scene.h"

#include <cstring>
#include <thread>

#include "renderengine/error.h"
#include "tests/benchmarks/clock.h"

namespace antipode::benchmark {
namespace {

RTCRayHit trace1(RTCScene scene, const Ray& ray) {
    RTCRayHit query{};
    query.ray.org_x = ray.origin.x, query.ray.org_y = ray.origin.y, query.ray.org_z = ray.origin.z;
    query.ray.dir_x = ray.direction.x, query.ray.dir_y = ray.direction.y, query.ray.dir_z = ray.direction.z;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
    return query;
}

void attach(RTCDevice device, RTCScene scene, const Mesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f),
                                              mesh.positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof mesh.triangles[0], mesh.triangles.size());
    if (!positions || !indices)
        throw Error(ErrorCode::Device, "Embree has no memory for the mesh '" + mesh.name + "'.");
    std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3f));
    std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * sizeof mesh.triangles[0]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

}  // namespace

EmbreeScene::EmbreeScene(const Scene& scene) : device_(rtcNewDevice(nullptr)) {
    if (!device_) throw Error(ErrorCode::Device, "Embree does not start.");
    scene_ = rtcNewScene(device_);
    const double start = wallSeconds();
    for (const Mesh& mesh : scene.meshes) attach(device_, scene_, mesh);
    rtcCommitScene(scene_);
    buildSeconds_ = wallSeconds() - start;
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

EmbreeHit EmbreeScene::closestHit(const Ray& ray) const {
    const RTCRayHit query = trace1(scene_, ray);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {true, query.ray.tfar, normalize(Vec3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z))};
}

void EmbreeScene::trace(std::span<const Ray> rays, std::span<float> distances) const {
    const auto traceRange = [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) distances[i] = trace1(scene_, rays[i]).ray.tfar;
    };
    std::thread other(traceRange, rays.size() / 2, rays.size());
    traceRange(0, rays.size() / 2);
    other.join();
}

}  // namespace antipode::benchmark
