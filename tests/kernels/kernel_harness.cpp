#include "tests/kernels/kernel_harness.h"

#include <algorithm>
#include <stdexcept>

#include "techniques/parameter_bytes.h"

namespace antipode {
namespace {

using namespace shared;

constexpr uint32_t groupSize = 64;
const FilmLayout film64{64, 1, {{LayerKind::Image, "", "RGB", 0}}};
// As probes/probe.glsl numbers them.
constexpr uint32_t firstInput = BIND_COUNT, firstOutput = BIND_COUNT + 3;

std::vector<Binding> probeBindings() {
    std::vector<Binding> bindings = kernelBindings();
    for (uint32_t i = 0; i < 6; ++i) bindings.push_back({firstInput + i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
    return bindings;
}

}  // namespace

std::vector<Texel> uniformTexels(size_t count, Random& random) {
    const auto number = [&] { return float(random.index(1u << 24)) * 0x1p-24f; };
    std::vector<Texel> u(count);
    for (Texel& t : u) t = {number(), number(), number(), number()};
    return u;
}

KernelHarness::KernelHarness(Device& device, const PackedScene& packed, const JobParameters<double>& job)
    : device_(device),
      features_(packed.features),
      lobes_(packed.lobes),
      stackDepth_(std::max(packed.bvh.stackDepth, 1u)),
      scene_(device, packed),
      table_(device, probeBindings(), sizeof(DispatchParameters<double>)),
      commands_(device),
      job_(device, sizeof job, Residency::DeviceOnly),
      counters_(device, 4ull * COUNTER_COUNT, Residency::DeviceOnly),
      film_(device, film64) {
    const std::vector<std::byte> parameters = parameterBytes(job, Precision::Float);
    job_.upload(parameters.data(), parameters.size());
    counters_.fill(0);
    scene_.bind(table_);
    table_.set(BIND_JOB, job_);
    table_.set(BIND_COUNTERS, counters_);
    table_.set(BIND_WAVELENGTH, counters_);  // something must be bound; no probe asks for dispersion
    film_.bind(table_);
}

void KernelHarness::reserve(size_t count) {
    if (count <= capacity_) return;
    capacity_ = count;
    inputs_.clear();
    outputs_.clear();
    for (uint32_t i = 0; i < 3; ++i) {
        table_.set(firstInput + i, inputs_.emplace_back(device_, 16 * count, Residency::HostVisible));
        table_.set(firstOutput + i, outputs_.emplace_back(device_, 16 * count, Residency::HostVisible));
    }
}

const ComputePipeline& KernelHarness::pipeline(std::span<const uint32_t> probe, uint32_t variant) {
    const std::pair key(probe.data(), variant);
    const auto found = pipelines_.find(key);
    if (found != pipelines_.end()) return found->second;
    const std::vector<std::pair<uint32_t, uint32_t>> specialisation{{SPEC_FEATURES, features_},
                                                                    {SPEC_LOBES, lobes_},
                                                                    {SPEC_STACK_DEPTH, stackDepth_},
                                                                    {SPEC_VARIANT, variant},
                                                                    {SPEC_GROUP_SIZE, groupSize}};
    return pipelines_.emplace(key, ComputePipeline(device_, table_, probe, specialisation)).first->second;
}

ProbeData KernelHarness::run(std::span<const uint32_t> probe, const ProbeData& inputs, uint32_t variant,
                             DispatchParameters<float> push) {
    const size_t count = inputs.a.size();
    const auto groups = uint32_t((count + groupSize - 1) / groupSize);
    if (groups > commands_.maxGroups()[0]) throw std::invalid_argument("too many elements for one run");
    reserve(count);
    const std::vector<Texel>* arrays[] = {&inputs.a, &inputs.b, &inputs.c};
    for (size_t i = 0; i < 3; ++i)
        if (!arrays[i]->empty()) inputs_[i].upload(arrays[i]->data(), 16 * arrays[i]->size());
    push.elementCount = uint32_t(count);
    const ComputePipeline& kernel = pipeline(probe, variant);
    commands_.begin();
    commands_.bind(table_);
    commands_.dispatch(kernel, groups, std::as_bytes(std::span(&push, 1)));
    commands_.submitAndWait();
    ProbeData result;
    std::vector<Texel>* results[] = {&result.a, &result.b, &result.c};
    for (size_t i = 0; i < 3; ++i) {
        results[i]->resize(count);
        outputs_[i].download(results[i]->data(), 16 * count);
    }
    return result;
}

uint32_t KernelHarness::events(EventSource source, EventKind kind) const {
    uint32_t value = 0;
    counters_.download(&value, 4, 4ull * (COUNTER_EVENTS + uint32_t(source) * EVENT_KINDS + uint32_t(kind)));
    return value;
}

std::vector<int64_t> KernelHarness::film() const { return film_.download(); }

void KernelHarness::clearFilm() { film_.clear(); }

}  // namespace antipode
