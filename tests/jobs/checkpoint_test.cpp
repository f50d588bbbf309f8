// The format: what is written comes back, and nothing else is accepted.
#include "farm/jobs/checkpoint.h"

#include <functional>
#include <limits>

#include "proto/farm.pb.h"
#include "proto/wire/block_codec.h"
#include "proto/wire/job_messages.h"
#include "proto/wire/scene_package.h"
#include "tests/film/expect_error.h"
#include "tests/jobs/job_fixture.h"

using namespace antipode;
using namespace antipode::test;

namespace {

Checkpoint smallCheckpoint() {
    Checkpoint checkpoint;
    checkpoint.job = smallJob();
    checkpoint.job.settings.maxPathLength = 9;
    checkpoint.job.settings.precision = Precision::Double;
    checkpoint.deviceClasses = {"one", "two"};
    checkpoint.committed = IterationSet({{0, 3}, {8, 4}});
    checkpoint.sums = fakeSums(checkpoint.job.settings, checkpoint.committed.ranges());
    checkpoint.sums.values[1] = -5;
    checkpoint.sums.events.at(EventSource::Merge, EventKind::ZeroPdf) = 3;
    checkpoint.sums.events.at(EventSource::LightTrace, EventKind::StackOverflow) = uint64_t(1) << 40;
    checkpoint.statistics.rays = 77;
    checkpoint.statistics.stages = {{"light trace", 1.5, 70}};
    checkpoint.wallSeconds = 12.25;
    return checkpoint;
}

/// A file of this format, with a right digest whatever is in it.
std::string sealed(std::string body) { return body + sha256Of(body); }

std::string little(uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += char(uint8_t(value >> (8 * i)));
    return text;
}

const std::string magic = "antipode checkpoint 1\n";

/// "none" where the settings cannot be read.
std::string hashOfJob(const farm::Checkpoint& header) {
    try {
        return wire::jobHash(wire::fromMessage(header.settings()), header.scene_hash(), header.kernel_hash());
    } catch (const Error&) {
        return "none";
    }
}

/// A checkpoint with another header, as a forger would make it.
std::string forged(const Checkpoint& checkpoint, const std::function<void(farm::Checkpoint&)>& change) {
    const std::string whole = encodeCheckpoint(checkpoint);
    const size_t headerAt = magic.size() + 8;
    size_t headerBytes = 0;
    for (int i = 0; i < 8; ++i) headerBytes |= size_t(uint8_t(whole[magic.size() + size_t(i)])) << (8 * i);
    farm::Checkpoint header;
    EXPECT_TRUE(header.ParseFromString(whole.substr(headerAt, headerBytes)));
    const std::string sealedJob = header.settings().SerializeAsString();
    change(header);
    if (header.settings().SerializeAsString() != sealedJob) header.set_job_hash(hashOfJob(header));
    const std::string text = header.SerializeAsString();
    const size_t restAt = headerAt + headerBytes;
    return sealed(magic + little(text.size(), 8) + text + whole.substr(restAt, whole.size() - 32 - restAt));
}

std::string forged(const std::function<void(farm::Checkpoint&)>& change) { return forged(smallCheckpoint(), change); }

void expectRefused(const std::string& words, const std::string& bytes) {
    expectError(ErrorCode::Input, words, [&] { decodeCheckpoint(bytes); });
}

}  // namespace

TEST(Checkpoint, ComesBackAsItWas) {
    const Checkpoint before = smallCheckpoint(), after = decodeCheckpoint(encodeCheckpoint(before));
    EXPECT_EQ(after.job.sceneHash, before.job.sceneHash);
    EXPECT_EQ(after.job.kernelHash, before.job.kernelHash);
    EXPECT_EQ(after.job.settings.initialRadius, before.job.settings.initialRadius);
    EXPECT_EQ(after.job.settings.maxPathLength, before.job.settings.maxPathLength);
    EXPECT_EQ(after.job.settings.precision, before.job.settings.precision);
    EXPECT_EQ(after.deviceClasses, before.deviceClasses);
    EXPECT_EQ(after.committed, before.committed);
    EXPECT_EQ(after.sums.values, before.sums.values);
    EXPECT_EQ(after.sums.iterations, 7u);
    EXPECT_EQ(after.sums.layout, before.sums.layout);
    EXPECT_EQ(after.sums.events, before.sums.events);
    EXPECT_EQ(after.statistics.rays, 77u);
    ASSERT_EQ(after.statistics.stages.size(), 1u);
    EXPECT_EQ(after.statistics.stages[0].seconds, 1.5);
    EXPECT_EQ(after.wallSeconds, 12.25);
    EXPECT_NO_THROW(requireSameJob(after, before.job));
    EXPECT_EQ(encodeCheckpoint(after), encodeCheckpoint(before));
}

TEST(Checkpoint, KnowsItsLayers) {
    Checkpoint before = smallCheckpoint();
    const Checkpoint after = decodeCheckpoint(encodeCheckpoint(before));
    EXPECT_EQ(after.sums.residueIterations, (std::vector<uint64_t>{2, 2, 3}));  // of 0 to 2 and 8 to 11, modulo 3
    EXPECT_EQ(after.sums.sha256(), before.sums.sha256());
    const auto refused = [&](const char* what, const std::function<void(RenderSettings&)>& change) {
        JobDefinition other = before.job;
        change(other.settings);
        expectError(ErrorCode::Usage, what, [&] { requireSameJob(after, other); });
    };
    refused("residue classes is 3, not 2", [](RenderSettings& s) { s.residueClasses = 2; });
    refused("layers is albedo, not none", [](RenderSettings& s) { s.layers = {}; });
    refused("guides is first-diffuse, not first-hit", [](RenderSettings& s) { s.guides = Guides::FirstHit; });
}

TEST(Checkpoint, KnowsItsErrorClasses) {
    Checkpoint before = smallCheckpoint();
    before.job.settings.residueClasses.reset();
    before.committed = IterationSet({{0, 3}});
    before.sums = inErrorClasses(fakeSums(before.job.settings, {{0, 1}}), 0);
    for (uint64_t i = 1; i < 3; ++i) before.sums.merge(fakeSums(before.job.settings, {{i, 1}}), errorClass(i));
    const Checkpoint after = decodeCheckpoint(encodeCheckpoint(before));
    EXPECT_EQ(after.sums.layout, before.sums.layout);
    EXPECT_EQ(after.sums.residueIterations, (std::vector<uint64_t>{1, 1, 1, 0}));
    EXPECT_EQ(after.sums.sha256(), before.sums.sha256());
    // What was summed in classes goes on without, and the other way about.
    const Coordinator without(before.job, {.iterations = 3}, after);
    EXPECT_EQ(without.sums().sha256(), fakeSums(before.job.settings, {{0, 3}}).sha256());
    const Coordinator with(before.job, {.iterations = 3, .errorClasses = true}, without.checkpoint(1));
    EXPECT_EQ(with.sums().residueIterations, (std::vector<uint64_t>{3, 0, 0, 0}));
    EXPECT_EQ(with.sums().imageAlone().sha256(), before.sums.imageAlone().sha256());

    const auto ofClasses = [&](const std::vector<uint64_t>& counts) {
        return forged(before, [&](farm::Checkpoint& header) {
            header.mutable_error_class_iterations()->Assign(counts.begin(), counts.end());
        });
    };
    expectRefused("more iterations than it has", ofClasses({1, 1, 1, 1}));
    expectRefused("more iterations than it has", ofClasses({3, ~uint64_t(0), 1, 0}));
    expectRefused("fewer iterations than it has", ofClasses({1, 1, 0, 0}));
    expectRefused("classes that this build does not know", ofClasses({1, 2}));
    expectRefused("a chunk of film sums", ofClasses({}));
}

TEST(Checkpoint, OfNothingComesBackToo) {
    Checkpoint before;
    before.job = smallJob();
    const Checkpoint after = decodeCheckpoint(encodeCheckpoint(before));
    EXPECT_TRUE(after.committed.empty());
    EXPECT_TRUE(after.sums.values.empty());
}

TEST(Checkpoint, HasManyChunks) {
    Checkpoint before = smallCheckpoint();
    before.job.settings.width = 300;
    before.job.settings.height = 200;
    before.sums = fakeSums(before.job.settings, before.committed.ranges());
    for (size_t i = 0; i < before.sums.values.size(); ++i) before.sums.values[i] += int64_t(i * i * i);
    ASSERT_GT(wire::chunkCount(before.sums.values.size(), wire::checkpointChunkValues), 2u);
    EXPECT_EQ(decodeCheckpoint(encodeCheckpoint(before)).sums.values, before.sums.values);
}

TEST(Checkpoint, TornAnywhereIsRefused) {
    const std::string whole = encodeCheckpoint(smallCheckpoint());
    for (size_t size = 0; size < whole.size(); ++size)
        EXPECT_THROW(decodeCheckpoint(std::string_view(whole).substr(0, size)), Error) << size;
    expectRefused("", whole + '\0');
    expectRefused("", whole + whole);
}

TEST(Checkpoint, AnyFlippedBitIsFound) {
    const std::string whole = encodeCheckpoint(smallCheckpoint());
    for (size_t i = 0; i < 8 * whole.size(); ++i) {
        std::string flipped = whole;
        flipped[i / 8] = char(flipped[i / 8] ^ (1 << (i % 8)));
        EXPECT_THROW(decodeCheckpoint(flipped), Error) << i;
    }
}

TEST(Checkpoint, AForgersNumbersAreCheckedBeforeTheyAreUsed) {
    EXPECT_NO_THROW(decodeCheckpoint(forged([](farm::Checkpoint&) {})));
    expectRefused("too long", sealed(magic + little(~uint64_t(0), 8)));
    expectRefused("too early", sealed(magic + little(64 << 20, 8)));
    expectRefused("too early", sealed(magic));
    expectRefused("cannot be parsed", sealed(magic + little(3, 8) + "\xff\xff\xff"));
    expectRefused("", forged([](auto& header) { header.mutable_settings()->set_width(1 << 30); }));
    expectRefused("", forged([](auto& header) { header.mutable_settings()->set_height(0); }));
    expectRefused("do not fit its image", forged([](auto& header) { header.mutable_settings()->set_width(40000); }));
    expectRefused("do not fit its image", forged([](auto& header) { header.set_chunks(2); }));
    expectRefused("do not fit its image", forged([](auto& header) { header.set_chunks(0); }));
    expectRefused("sums of no iterations", forged([](auto& header) { header.clear_committed(); }));
    expectRefused(
        "too early", forged([](auto& header) {
            header.mutable_settings()->set_width(300);
            header.mutable_settings()->set_height(200);
            header.set_chunks(uint32_t(wire::chunkCount(size_t(300) * 200 * filmLayout(smallJob().settings).channels(),
                                                        wire::checkpointChunkValues)));
        }));
    // Three sums more or less than the chunk holds.
    expectRefused("", forged([](auto& header) { header.mutable_settings()->set_width(3); }));
    expectRefused("", forged([](auto& header) { header.mutable_settings()->set_width(1); }));
    expectRefused("not in order", forged([](auto& header) { header.mutable_committed(1)->set_first(1); }));
    expectRefused("not in order", forged([](auto& header) { header.mutable_committed(1)->set_first(3); }));
    expectRefused("impossible", forged([](auto& header) { header.mutable_committed(1)->set_count(0); }));
    expectRefused("impossible", forged([](auto& header) { header.mutable_committed(1)->set_count(~uint64_t(0)); }));
    expectRefused("do not match their hash", forged([](auto& header) { header.mutable_committed(1)->set_count(5); }));
    expectRefused("do not match their hash", forged([](auto& header) { header.set_sums_sha256("x"); }));
    expectRefused("does not have", forged([](auto& header) {
                      header.mutable_settings()->set_precision(farm::JobSettings::Precision(2));
                  }));
    expectRefused("does not know",
                  forged([](auto& header) { header.mutable_events()->mutable_entry(0)->set_kind(eventKinds); }));
    expectRefused("counted twice", forged([](auto& header) {
                      header.mutable_events()->add_entry()->CopyFrom(header.events().entry(0));
                  }));
    expectRefused("scale", forged([](auto& header) { header.set_scale_exponent(0, 2000000000); }));
    expectRefused("render time", forged([](auto& header) { header.set_wall_seconds(-1); }));
    expectRefused("render time",
                  forged([](auto& header) { header.set_wall_seconds(std::numeric_limits<double>::quiet_NaN()); }));
}

TEST(Checkpoint, HoldsTheHashOfItsJob) {
    expectRefused("settings that this build does not know", forged([](auto& header) { header.set_job_hash("x"); }));
    expectRefused("older build", forged([](auto& header) { header.clear_job_hash(); }));
    expectRefused("settings that this build does not know", forged([](auto& header) { header.set_scene_hash("x"); }));
}

TEST(Checkpoint, NamesTheFirstDifference) {
    const Checkpoint checkpoint = smallCheckpoint();
    const auto expectDifference = [&](const std::string& words, const std::function<void(JobDefinition&)>& change) {
        JobDefinition job = checkpoint.job;
        change(job);
        expectError(ErrorCode::Usage, words, [&] { requireSameJob(checkpoint, job); });
    };
    expectDifference("scene", [](auto& job) { job.sceneHash += "x"; });
    expectDifference("width is 2, not 4", [](auto& job) { job.settings.width = 4; });
    expectDifference("height is 1, not 4", [](auto& job) { job.settings.height = 4; });
    expectDifference("technique is 'vcm', not 'cm'", [](auto& job) { job.settings.technique.erase(0, 1); });
    expectDifference("seed is 1, not 2", [](auto& job) { job.settings.seed = 2; });
    expectDifference("initial radius is 0.25, not 0.5", [](auto& job) { job.settings.initialRadius = 0.5; });
    expectDifference("alpha", [](auto& job) { job.settings.alpha = 0.5; });
    expectDifference("greatest path length is 9, not unset", [](auto& job) { job.settings.maxPathLength.reset(); });
    expectDifference("Russian roulette is on, not off", [](auto& job) { job.settings.russianRoulette = false; });
    expectDifference("light paths is unset, not 5", [](auto& job) { job.settings.lightPathCount = 5; });
    expectDifference("connections per vertex is 1, not 2", [](auto& job) { job.settings.connectionsPerVertex = 2; });
    expectDifference("precision is double, not float", [](auto& job) { job.settings.precision = Precision::Float; });
    expectDifference("sampler is sobol, not independent",
                     [](auto& job) { job.settings.sampler = Sampler::Independent; });
    expectDifference("curving of triangles is on, not off", [](auto& job) { job.settings.curvedTriangles = false; });
    expectDifference("some of all paths", [](auto& job) { job.settings.minPathLength = 2; });
    expectDifference("other kernels", [](auto& job) { job.kernelHash += "x"; });
}
