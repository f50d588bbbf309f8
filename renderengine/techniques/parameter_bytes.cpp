#include "techniques/parameter_bytes.h"

#include <span>

namespace antipode {
namespace {

using namespace shared;

Real4<float> rounded(const Real4<double>& v) { return {float(v.x), float(v.y), float(v.z), float(v.w)}; }

JobParameters<float> rounded(const JobParameters<double>& p) {
    return {.cameraPosition = rounded(p.cameraPosition),
            .cameraForward = rounded(p.cameraForward),
            .cameraRight = rounded(p.cameraRight),
            .cameraUp = rounded(p.cameraUp),
            .sceneCenter = rounded(p.sceneCenter),
            .gridOrigin = rounded(p.gridOrigin),
            .environment = rounded(p.environment),
            .worldOrigin = rounded(p.worldOrigin),
            .image = p.image,
            .environmentSize = p.environmentSize,
            .crop = p.crop,
            .lengths = p.lengths};
}

DispatchParameters<float> rounded(const DispatchParameters<double>& p) {
    return {.randomKey0 = p.randomKey0,
            .randomKey1 = p.randomKey1,
            .sampleIndex = p.sampleIndex,
            .pathBase = p.pathBase,
            .batchSize = p.batchSize,
            .queueParity = p.queueParity,
            .stageIndex = p.stageIndex,
            .vertexCount = p.vertexCount,
            .vertexCapacity = p.vertexCapacity,
            .bucketCount = p.bucketCount,
            .splatEnabled = p.splatEnabled,
            .elementCount = p.elementCount,
            .lightPathCount = float(p.lightPathCount),
            .radius = float(p.radius),
            .cellSize = float(p.cellSize),
            .mergeCount = float(p.mergeCount),
            .inverseMergeCount = float(p.inverseMergeCount),
            .connectCount = float(p.connectCount),
            .connectScale = float(p.connectScale),
            .hitCount = float(p.hitCount),
            .nextEventCount = float(p.nextEventCount),
            .splatCount = float(p.splatCount)};
}

template <class Parameters>
std::vector<std::byte> bytesOf(const Parameters& parameters) {
    const auto bytes = std::as_bytes(std::span(&parameters, 1));
    return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<std::byte> parameterBytes(const JobParameters<double>& parameters, Precision precision) {
    return precision == Precision::Double ? bytesOf(parameters) : bytesOf(rounded(parameters));
}

std::vector<std::byte> parameterBytes(const Real4<double>& parameters, Precision precision) {
    return precision == Precision::Double ? bytesOf(parameters) : bytesOf(rounded(parameters));
}

std::vector<std::byte> parameterBytes(const DispatchParameters<double>& parameters, Precision precision) {
    return precision == Precision::Double ? bytesOf(parameters) : bytesOf(rounded(parameters));
}

}  // namespace antipode
