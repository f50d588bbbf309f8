// Writes the inputs that fuzzing starts from: make_corpus FOLDER. The committed ones are in corpus/.
#include <google/protobuf/text_format.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "farm/jobs/checkpoint.h"
#include "proto/scene_translation.h"
#include "proto/wire/block_codec.h"
#include "proto/wire/frame.h"
#include "proto/wire/job_messages.h"
#include "proto/wire/scene_package.h"
#include "renderengine/error.h"
#include "tests/scene/full_scene.h"

namespace antipode {
namespace {

using wire::FrameType;

class Folder {
public:
    explicit Folder(std::filesystem::path path) : path_(std::move(path)) { std::filesystem::create_directories(path_); }
    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(path_ / name, std::ios::binary) << bytes;
    }

private:
    std::filesystem::path path_;
};

RenderSettings settings() {
    RenderSettings s;
    s.width = 4, s.height = 3, s.initialRadius = 0.01, s.maxPathLength = 10;
    s.precision = Precision::Double;
    return s;
}

EngineStatistics statistics() {
    EngineStatistics s;
    s.stages = {{"light emission", 0.25, 100}, {"shadow rays", 0.5, 200}};
    s.rays = 300, s.shadowRays = 200, s.lightVertices = 50;
    return s;
}

FilmSums sums() {
    FilmSums film;
    film.layout = filmLayout(settings());
    film.layout.layers[0].scaleExponent = 40;
    film.iterations = 5;
    for (int i = 0; i < 36; ++i) film.values.push_back(int64_t(i) * 123456789);
    film.events.at(EventSource::Merge, EventKind::ZeroPdf) = 1;
    film.events.at(EventSource::Film, EventKind::Saturated) = 300;
    return film;
}

void fill(farm::BlobRef* blob, const std::string& bytes) {
    blob->set_sha256(sha256Of(bytes));
    blob->set_size(bytes.size());
}

/// One frame of each type that has fields.
std::vector<wire::Frame> frames() {
    farm::Hello hello;
    hello.set_oldest_protocol(wire::protocolVersion), hello.set_newest_protocol(wire::protocolVersion);
    hello.set_build("0.1.0"), hello.set_kernel_hash(std::string(64, 'a')), hello.set_client("host:1");
    farm::Welcome welcome;
    welcome.set_protocol(wire::protocolVersion), welcome.set_build("0.1.0"),
        welcome.set_kernel_hash(std::string(64, 'a'));
    welcome.mutable_device()->set_name("device"), welcome.mutable_device()->set_memory_bytes(1 << 30);
    welcome.mutable_device()->set_device_class("class"), welcome.set_lease_depth(2);
    farm::Refusal refusal;
    refusal.set_code(farm::Refusal::BUSY), refusal.set_sentence("later");
    farm::OpenJob open;
    open.set_job(std::string(16, 'j')), open.set_scene_hash(std::string(64, 'b'));
    open.set_job_hash(wire::jobHash(settings(), open.scene_hash(), std::string(64, 'a')));
    *open.mutable_settings() = wire::toMessage(settings());
    fill(open.mutable_scene(), "scene");
    farm::NeedBlobs need;
    fill(need.add_need()->mutable_blob(), "a"), fill(need.add_need()->mutable_blob(), "b");
    farm::BlobChunk blob;
    blob.set_sha256(sha256Of("a")), blob.set_offset(1 << 20);
    farm::JobReady ready;
    ready.set_initial_radius(0.01), ready.set_light_paths_per_iteration(12), ready.set_build_seconds(0.5);
    ready.set_renderings("GPU"), ready.set_width(16);
    farm::Capacity capacity;
    capacity.set_width(15);
    farm::LeaseGrant grant;
    grant.set_lease(7), grant.set_first(8), grant.set_count(8);
    farm::Progress progress;
    progress.set_lease(7), progress.set_done(3);
    farm::Truncate truncate;
    truncate.set_lease(7);
    farm::LeaseReturned returned;
    returned.set_lease(7), returned.set_reason("the device failed");
    farm::ResultOffer offer;
    offer.set_lease(7), offer.set_first(8), offer.set_count(5), offer.set_sha256(std::string(32, 'h'));
    offer.set_width(4), offer.set_height(3), offer.add_scale_exponent(40), offer.set_chunks(1);
    *offer.mutable_events() = wire::toMessage(sums().events);
    *offer.mutable_statistics() = wire::toMessage(statistics());
    farm::ResultCredit credit;
    credit.set_lease(7), credit.set_chunks(8);
    farm::ResultChunk chunk;
    chunk.set_lease(7), chunk.set_index(1);
    farm::ResultVerdict verdict;
    verdict.set_lease(7), verdict.set_verdict(farm::ResultVerdict::COMMITTED);
    return {makeFrame(FrameType::Hello, hello),
            makeFrame(FrameType::Welcome, welcome),
            makeFrame(FrameType::Refusal, refusal),
            makeFrame(FrameType::OpenJob, open),
            makeFrame(FrameType::NeedBlobs, need),
            makeFrame(FrameType::BlobChunk, blob, "payload"),
            makeFrame(FrameType::JobReady, ready),
            makeFrame(FrameType::Capacity, capacity),
            makeFrame(FrameType::LeaseGrant, grant),
            makeFrame(FrameType::Progress, progress),
            makeFrame(FrameType::Truncate, truncate),
            makeFrame(FrameType::LeaseReturned, returned),
            makeFrame(FrameType::ResultOffer, offer),
            makeFrame(FrameType::ResultCredit, credit),
            makeFrame(FrameType::ResultChunk, chunk, wire::encodeChunk(sums().values)),
            makeFrame(FrameType::ResultVerdict, verdict)};
}

void writeFrames(const Folder& folder) {
    std::string stream;
    for (const wire::Frame& frame : frames()) {
        const auto type = unsigned(frame.type);
        folder.write("message_" + std::to_string(type), char(type) + frame.message);
        stream += wire::encodeFrame(frame);
    }
    folder.write("stream", '\0' + stream);
    folder.write("heartbeat", '\0' + wire::encodeFrame({FrameType::Heartbeat, "", ""}));
    folder.write("scene_root", '\xFF' + *wire::packageScene(testing::richScene()).blobs[0].bytes);
}

void writeChunks(const Folder& folder) {
    const auto write = [&](const std::string& name, const std::vector<int64_t>& values) {
        const auto count = uint16_t(values.size());
        folder.write(name, std::string{char(count), char(count >> 8)} + wire::encodeChunk(values));
    };
    write("one", {1});
    write("film", sums().values);
    write("zeros", std::vector<int64_t>(5000));
    std::vector<int64_t> mixed(300);
    for (size_t i = 0; i < mixed.size(); ++i) mixed[i] = int64_t(i * 0x9E3779B97F4A7C15u) >> (i % 64);
    write("mixed", mixed);
}

void writeScenes(const Folder& folder) {
    const auto text = [](const schema::Scene& scene) {
        std::string out;
        google::protobuf::TextFormat::PrintToString(scene, &out);
        return out;
    };
    folder.write("rich", text(toProto(testing::richScene())));
    folder.write("shapes", R"(camera { position: [0, -3, 1] look_at: [0, 0, 0] up: [0, 0, 1] vertical_fov: 40 }
material { name: "grey" }
material { name: "lamp" emission: [1, 2, 3] }
quad { material: "lamp" corner: [0, 0, 2] edge_u: [0, 1, 0] edge_v: [1, 0, 0] uv_repeat: [2, 3] }
box { material: "grey" low: [-1, -1, -1] high: [1, 1, 0]
      transform { scale: 2 rotate { axis: [0, 0, 1] degrees: 30 } translate: [0, 0, 1] } }
disk { material: "grey" center: [0, 0, 1] normal: [0, 1, 1] radius: 0.5 segments: 7 }
ripple_grid { material: "grey" size_x: 1 size_z: 2 cells_x: 3 cells_z: 4
              wave { amplitude: 0.1 wavelength: 0.5 direction: 30 phase: 10 } }
sphere { material: "grey" center: [0, 0, 3] radius: 0.5 }
)");
    folder.write("lights", R"(image { width: 8 height: 8 } max_path_length: 5
material { kind: PHONG base_color: [0.5, 0.5, 0.5] specular: [0.25, 0.25, 0.25] phong_exponent: 20 }
sphere { radius: 1 material: "#0" }
point_light { position: [0, 0, 3] intensity: [1, 1, 1] }
spot_light { position: [0, 0, 3] direction: [0, 0, -1] intensity: [1, 1, 1] inner_half_angle: 10 outer_half_angle: 20 }
directional_light { direction: [0, 0, -1] irradiance: [1, 1, 1] }
environment { radiance: [0.1, 0.2, 0.3] rotation: 90 z_up: true }
)");
}

void writeCheckpoints(const Folder& folder) {
    Checkpoint checkpoint;
    checkpoint.job = {settings(), std::string(64, 'b'), std::string(64, 'a')};
    checkpoint.deviceClasses = {"class"};
    checkpoint.committed = IterationSet({{0, 4}, {8, 1}});
    checkpoint.sums = sums();
    checkpoint.statistics = statistics();
    checkpoint.wallSeconds = 12.5;
    const auto write = [&](const std::string& name) {
        std::string bytes = encodeCheckpoint(checkpoint);
        bytes.resize(bytes.size() - 32);  // checkpoint_fuzz appends the digest
        folder.write(name, bytes);
    };
    write("five_iterations");
    checkpoint.job.settings.width = checkpoint.sums.layout.width = 200;
    checkpoint.job.settings.height = checkpoint.sums.layout.height = 150;
    checkpoint.sums.values.assign(checkpoint.sums.layout.values(), 0);
    write("two_chunks");
}

/// A model in importer_fuzz's own notation: a lit, textured square seen by a camera of its own, or without any of that.
void writeModels(const Folder& folder) {
    std::string bytes;
    const auto put = [&](std::initializer_list<int> values) {
        for (const int value : values) bytes.push_back(char(value));
    };
    const auto reals = [&](std::initializer_list<float> values) {
        for (const float value : values) {
            const auto bits = std::bit_cast<uint32_t>(value);
            for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(char(bits >> shift));
        }
    };
    const auto square = [&](bool attributes) {
        put({0, 4});  // material, vertices
        reals({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
        put({attributes});
        if (attributes) reals({0, 0, 1, 0, 0, 1, 0, 0.6f, 0.8f, 0, 0, 1});
        put({attributes});
        if (attributes) reals({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
        put({3, 3, 0, 1, 2, 3, 0, 2, 3, 5, 1, 2, 3});  // faces: of three indices each
    };
    const auto material = [&] {
        reals({0.5f, 0.4f, 0.3f, 0.2f, 0.2f, 0.2f, 1, 2, 3});
        reals({20, 1.5f, 1});
        put({2});
    };
    put({0, 1});  // .obj, one material
    material();
    put({0, 0, 0});  // no lights, no cameras, a root
    put({0, 1, 0, 0, 0, 1});
    square(false);
    folder.write("square", bytes);

    bytes.clear();
    put({1, 1});  // .fbx
    material();
    put({2, 1, 3});  // two lights: a spot on the child, a point
    reals({0, 0, 2, 0, 0, -1, 5, 5, 5, 0.5f, 1});
    put({0, 2});
    reals({0, 1, 2, 0, 0, -1, 5, 5, 5, 0, 0});
    put({1, 1});  // a camera on the child
    reals({0, 0, 3, 0, 0, -1, 0, 1, 0, 1, 1.5f});
    put({0, 0, 1, 0});  // a root with the first mesh
    put({1});           // a child with a map of its own
    reals({1, 0, 0, 0.5f, 0, -2, 0, 0, 0, 0, 1, 0.25f});
    put({2, 0, 1, 2});  // and two meshes, of two
    square(true);
    square(false);
    folder.write("lights_and_camera", bytes);
}

}  // namespace
}  // namespace antipode

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: make_corpus FOLDER\n";
        return 2;
    }
    try {
        const std::filesystem::path folder = argv[1];
        antipode::writeFrames(antipode::Folder(folder / "frame_fuzz"));
        antipode::writeChunks(antipode::Folder(folder / "block_codec_fuzz"));
        antipode::writeScenes(antipode::Folder(folder / "scene_fuzz"));
        antipode::writeCheckpoints(antipode::Folder(folder / "checkpoint_fuzz"));
        antipode::writeModels(antipode::Folder(folder / "importer_fuzz"));
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
