// The hash grid over light vertices: the real sort stages, checked for order and completeness, and queries that walk
// the grid as merge.comp does, against brute force. Fixed seeds.
#include <cmath>
#include <numeric>

#include "kernels/embedded.h"
#include "support/hard_case.h"
#include "support/random.h"
#include "techniques/vertex_buffers.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {
namespace {

using namespace shared;

uint32_t hashed(uint32_t number) { return number * 2654435761u ^ (number >> 7); }

class GridTest : public DeviceTest {
protected:
    struct Cloud {
        std::vector<Vec3f> vertices;
        Vec3f least;  ///< of the scene's bounds
        double sceneRadius;
        double radius;  ///< of a merge
    };

    /// Puts the vertices into a grid, checks its order, and compares every query with brute force. `buckets` is a power
    /// of two of at least 64, or 0 for about one a vertex.
    void expectExact(const std::string& difficulty, const Cloud& cloud, const std::vector<Vec3f>& queries,
                     uint32_t buckets = 0) {
        JobParameters<double> job;
        job.gridOrigin = {cloud.least.x, cloud.least.y, cloud.least.z, 0};
        job.sceneCenter.w = cloud.sceneRadius;
        KernelHarness harness(*device, PackedScene{}, job);
        const auto count = uint32_t(cloud.vertices.size());
        // More room than vertices, as in the renderer.
        VertexBuffers buffers(*device, count + 1000, 64, buckets ? buckets : std::bit_ceil(std::max(count, 64u)),
                              Precision::Float);
        buffers.bind(harness.table());

        DispatchParameters<float> push{};
        push.vertexCount = count;
        push.vertexCapacity = buffers.capacity();
        push.bucketCount = buffers.bucketCount();
        push.radius = float(cloud.radius);
        // As techniques/wavefront.cpp has it.
        push.cellSize = float(2.002 * cloud.radius + cloud.sceneRadius * 0x1p-20);
        ProbeData inputs;
        for (uint32_t i = 0; i < count; ++i) inputs.a.push_back(texel(cloud.vertices[i], i));
        harness.run(kernel_probes::grid_probe(), inputs, 0, push);
        sort(harness, buffers, push);
        push.stageIndex = buffers.sortPasses();
        expectSorted(harness.run(kernel_probes::grid_probe(), inputs, 1, push), cloud, count);
        expectQueries(difficulty, harness, cloud, queries, push);
    }

private:
    /// The stages of Wavefront::gridPass.
    void sort(KernelHarness& harness, const VertexBuffers& buffers, DispatchParameters<float> push) {
        constexpr uint32_t group = 64;
        const auto pipeline = [&](std::span<const uint32_t> spirv, uint32_t variant) {
            return ComputePipeline(*device, harness.table(), spirv,
                                   {{SPEC_VARIANT, variant}, {SPEC_GROUP_SIZE, group}});
        };
        const auto keys = pipeline(kernels::sort_keys(Precision::Float), 0),
                   counts = pipeline(kernels::sort_count(Precision::Float), 0),
                   scan = pipeline(kernels::exclusive_scan(Precision::Float), 1),
                   scatter = pipeline(kernels::sort_scatter(Precision::Float), 0),
                   gather = pipeline(kernels::sort_gather(Precision::Float), 0);
        const uint32_t chunks = (push.vertexCount + SORT_CHUNK - 1) / SORT_CHUNK;
        push.elementCount = SORT_DIGITS * chunks;
        Commands commands(*device);
        const auto run = [&](const ComputePipeline& stage, uint32_t invocations) {
            commands.dispatch(stage, (invocations + group - 1) / group, std::as_bytes(std::span(&push, 1)));
            commands.barrier();
        };
        commands.begin();
        commands.bind(harness.table());
        commands.fill(buffers.cells(), 0, buffers.cells().bytes(), 0);
        commands.barrier();
        run(keys, push.vertexCount);
        for (push.stageIndex = 0; push.stageIndex < buffers.sortPasses(); ++push.stageIndex) {
            run(counts, chunks);
            run(scan, 1);
            run(scatter, chunks);
        }
        run(gather, push.vertexCount);
        commands.submitAndWait();
    }

    static void expectSorted(const ProbeData& sorted, const Cloud& cloud, uint32_t count) {
        std::vector<bool> seen(count);
        size_t faults = 0;
        uint32_t lastBucket = 0, lastNumber = 0;
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t number = bitsOf(sorted.a[i].w), bucket = bitsOf(sorted.b[i].x);
            ASSERT_LT(number, count);
            faults += seen[number] || xyz(sorted.a[i]) != cloud.vertices[number] || bitsOf(sorted.b[i].y) != number;
            seen[number] = true;
            faults += bucket != bitsOf(sorted.c[i].x);
            // Ascending buckets, and ascending numbers within each: the sort is stable.
            faults += i > 0 && (bucket < lastBucket || (bucket == lastBucket && number <= lastNumber));
            faults += !(bitsOf(sorted.b[i].z) <= i && i < bitsOf(sorted.b[i].w));
            faults += i > 0 && bucket != lastBucket && bitsOf(sorted.b[i].z) != i;
            lastBucket = bucket;
            lastNumber = number;
        }
        EXPECT_EQ(faults, 0u);
    }

    void expectQueries(const std::string& difficulty, KernelHarness& harness, const Cloud& cloud,
                       const std::vector<Vec3f>& queries, DispatchParameters<float> push) {
        ProbeData inputs;
        for (const Vec3f& q : queries) inputs.a.push_back(texel(q));
        std::vector<std::array<uint32_t, 3>> found(queries.size());
        bool more = true;
        for (push.stageIndex = 0; more; ++push.stageIndex) {
            const ProbeData outputs = harness.run(kernel_probes::grid_probe(), inputs, 2, push);
            more = false;
            for (size_t i = 0; i < queries.size(); ++i) {
                found[i][0] += bitsOf(outputs.a[i].x), found[i][1] += bitsOf(outputs.a[i].y),
                    found[i][2] += bitsOf(outputs.a[i].z);
                more = more || bitsOf(outputs.a[i].w) != 0;
            }
        }
        size_t wrong = 0, total = 0;
        const double low = double(push.radius) * (1 - 1e-6), high = double(push.radius) * (1 + 1e-6);
        for (size_t i = 0; i < queries.size(); ++i) {
            // Vertices at the radius itself, within rounding, may count or not: such queries are left out.
            std::array<uint32_t, 3> expected{};
            bool doubtful = false;
            for (uint32_t k = 0; k < cloud.vertices.size(); ++k) {
                const double d = length(Vec3d(cloud.vertices[k]) - Vec3d(queries[i]));
                doubtful = doubtful || (d > low && d < high);
                if (d < high) expected = {expected[0] + 1, expected[1] + k, expected[2] + hashed(k)};
            }
            if (doubtful) continue;
            total += expected[0];
            wrong += found[i] != expected;
        }
        expectWithin({"Merging", difficulty, "queries that differ from brute force", 0}, double(wrong),
                     device->info().name);
        EXPECT_GT(total, 0u);
    }
};

/// Points of a cube about `center` of half the edge `size`.
std::vector<Vec3f> pointsAbout(const Vec3d& center, double size, size_t count, Random& random) {
    std::vector<Vec3f> points;
    for (size_t i = 0; i < count; ++i)
        points.push_back(Vec3f(
            center + Vec3d{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)}));
    return points;
}

/// Every third vertex is moved near another one, so that queries find company whatever the radius.
void crowd(std::vector<Vec3f>& points, double radius, Random& random) {
    for (size_t i = 0; i + 1 < points.size(); i += 3)
        points[i] = pointsAbout(Vec3d(points[i + 1]), radius, 1, random).front();
}

TEST_F(GridTest, FindsEveryVertexOnce) {
    Random random(1);
    for (double radius : {0.5, 0.05, 0.003}) {
        SCOPED_TRACE(radius);
        auto vertices = pointsAbout({}, 1, 20000, random);
        crowd(vertices, radius, random);
        // Also from beyond the bounds, where cells have negative numbers.
        auto queries = pointsAbout({}, 1.2, 500, random);
        queries.insert(queries.end(), vertices.begin(), vertices.begin() + 500);
        expectExact("radii from .5 to .003 in a scene of 2, queries from outside",
                    {vertices, Vec3f(-1.0f), std::sqrt(3.0), radius}, queries);
    }
}

TEST_F(GridTest, OriginInTheMiddleGivesNegativeCells) {
    Random random(2);
    auto vertices = pointsAbout({-5, -5, -5}, 10, 20000, random);
    crowd(vertices, 0.2, random);
    expectExact("cells of negative coordinates", {vertices, Vec3f(0.0f), 17, 0.2},
                std::vector<Vec3f>(vertices.begin(), vertices.begin() + 1000));
}

TEST_F(GridTest, AllVerticesInOneCell) {
    Random random(3);
    const auto vertices = pointsAbout({0.3, 0.3, 0.3}, 0.01, 100000, random);
    auto queries = pointsAbout({0.3, 0.3, 0.3}, 0.02, 20, random);
    expectExact("100,000 photons in one cell", {vertices, Vec3f(-1.0f), std::sqrt(3.0), 0.015}, queries);
}

TEST_F(GridTest, AllVerticesAtOnePoint) {
    const std::vector<Vec3f> vertices(100000, Vec3f(0.25f));
    expectExact("100,000 photons at one point", {vertices, Vec3f(-1.0f), std::sqrt(3.0), 0.01},
                {{0.25f, 0.25f, 0.25f}, {0.255f, 0.25f, 0.25f}, {0.3f, 0.3f, 0.3f}});
}

TEST_F(GridTest, RadiusBeyondTheScene) {
    Random random(4);
    expectExact("a radius beyond the scene", {pointsAbout({}, 1, 5000, random), Vec3f(-1.0f), std::sqrt(3.0), 100},
                pointsAbout({}, 2, 100, random));
}

// Cells of the order of the floats' spacing: neighbours on that grid are one or two steps apart.
TEST_F(GridTest, RadiusOfOneTenMillionthOfTheScene) {
    Random random(5);
    for (double radius : {1e-6, 4e-7, 1e-7}) {
        SCOPED_TRACE(radius);
        auto vertices = pointsAbout({}, 1, 20000, random);
        for (size_t i = 0; i + 1 < vertices.size(); i += 2)
            vertices[i] = pointsAbout(Vec3d(vertices[i + 1]), 3 * radius, 1, random).front();
        expectExact("a radius of 10⁻⁷ of the scene, of the order of the floats' spacing",
                    {vertices, Vec3f(-1.0f), std::sqrt(3.0), radius},
                    std::vector<Vec3f>(vertices.begin(), vertices.begin() + 2000));
    }
}

// Cells share buckets, but no two cells of a query do.
TEST_F(GridTest, FewBuckets) {
    Random random(6);
    auto vertices = pointsAbout({}, 1, 20000, random);
    expectExact("many cells share a bucket", {vertices, Vec3f(-1.0f), std::sqrt(3.0), 0.05},
                pointsAbout({}, 1, 500, random), 64);
}

TEST_F(GridTest, FewVertices) {
    for (uint32_t count : {1u, 2u, 63u, 257u}) {
        Random random(count);
        expectExact("1, 2, 63 and 257 photons", {pointsAbout({}, 1, count, random), Vec3f(-1.0f), std::sqrt(3.0), 0.7},
                    pointsAbout({}, 0.5, 50, random));
    }
}

}  // namespace
}  // namespace antipode
