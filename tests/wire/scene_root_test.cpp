// Roots that no client of ours writes.
#include <limits>

#include "proto/wire/part_count.h"
#include "proto/wire/scene_package.h"
#include "tests/film/expect_error.h"
#include "tests/scene/full_scene.h"

namespace antipode::wire {
namespace {

using test::expectError;

farm::SceneRoot goodRoot() { return parseSceneRoot(*packageScene(testing::richScene()).blobs.front().bytes); }

/// Expects that a root is refused once it is spoilt.
template <class Spoil>
void refuse(const std::string& words, Spoil spoil) {
    farm::SceneRoot root = goodRoot();
    spoil(root);
    expectError(ErrorCode::Input, words, [&] { parseSceneRoot(root.SerializeAsString()); });
}

TEST(SceneRoot, GoodOnesAreTaken) { EXPECT_EQ(goodRoot().skeleton().mesh_size(), 4); }

TEST(SceneRoot, WhatIsNoMessageIsRefused) {
    expectError(ErrorCode::Input, "", [] { parseSceneRoot(""); });
    expectError(ErrorCode::Input, "cannot be parsed", [] { parseSceneRoot("\x0A\x7F"); });
    const std::string good = goodRoot().SerializeAsString();
    for (size_t size = 0; size < good.size(); ++size)
        EXPECT_THROW(parseSceneRoot(std::string_view(good).substr(0, size)), Error) << size;
}

TEST(SceneRoot, CountsThatDoNotMatchSizesAreRefused) {
    refuse("where its counts say", [](auto& r) { r.mutable_mesh(0)->mutable_blob()->set_size(1); });
    refuse("where its counts say", [](auto& r) { r.mutable_mesh(0)->mutable_mesh(0)->set_vertices(4); });
    refuse("where its counts say", [](auto& r) { r.mutable_mesh(0)->mutable_mesh(0)->set_triangles(2); });
    refuse("where its counts say", [](auto& r) { r.mutable_mesh(0)->mutable_mesh(0)->set_normals(true); });
    refuse("where its counts say", [](auto& r) { r.mutable_mesh(0)->mutable_mesh(1)->set_uvs(false); });
    refuse("where its counts say", [](auto& r) { r.mutable_mesh(0)->mutable_mesh(1)->set_more_uv_sets(0); });
    refuse("where its counts say", [](auto& r) { r.mutable_mesh(0)->mutable_mesh(1)->set_colors(false); });
    refuse("where its counts say", [](auto& r) { r.mutable_mesh(0)->mutable_mesh(0)->set_tangents(true); });
    refuse("where its counts say", [](auto& r) { r.mutable_texture(0)->set_size(9); });
    refuse("where its counts say",
           [](auto& r) { r.mutable_skeleton()->mutable_texture(0)->mutable_texels()->set_width(3); });
    refuse("where its counts say", [](auto& r) { r.mutable_environment()->set_size(23); });
}

TEST(SceneRoot, CountsThatWrapIn32BitsAreRefused) {
    // 12 · 0x55555556 = 2^32 + 8.
    refuse("where its counts say", [](auto& r) {
        r.mutable_mesh()->erase(r.mutable_mesh()->begin() + 1, r.mutable_mesh()->end());
        r.mutable_mesh(0)->mutable_mesh(0)->set_vertices(0x55555556);
        r.mutable_mesh(0)->mutable_blob()->set_size(8 + 12);
    });
}

TEST(SceneRoot, ImagesThatWrapIn64BitsAreRefused) {
    // 2^31 · 2^31 · 4 = 2^64.
    refuse("too many", [](auto& r) {
        auto* texels = r.mutable_skeleton()->mutable_texture(0)->mutable_texels();
        texels->set_width(1u << 31), texels->set_height(1u << 31);
        r.mutable_texture(0)->set_size(0);
    });
    refuse("too many", [](auto& r) {
        auto* map = r.mutable_skeleton()->mutable_environment()->mutable_map();
        map->set_width(0xFFFFFFFF), map->set_height(0xFFFFFFFF);
    });
}

TEST(SceneRoot, MoreBytesThanAnyMachineHoldsAreRefused) {
    refuse("more bytes than any machine", [](auto& r) {
        farm::MeshBlob* blob = r.mutable_mesh(0);
        const uint64_t bytes = uint64_t(0xFFFFFFFF) * 24;
        for (int i = 0; i < 50; ++i) {
            r.mutable_skeleton()->add_mesh()->set_material("#0");
            farm::MeshBlob* more = r.add_mesh();
            *more->mutable_blob() = blob->blob();
            more->mutable_blob()->set_sha256(sha256Of(std::to_string(i)));
            more->mutable_blob()->set_size(bytes);
            farm::MeshCounts* counts = more->add_mesh();
            counts->set_vertices(0xFFFFFFFF), counts->set_triangles(0xFFFFFFFF);
        }
    });
}

TEST(SceneRoot, EmptyListsAreRefused) {
    refuse("without vertices", [](auto& r) { r.mutable_mesh(0)->mutable_mesh(0)->set_vertices(0); });
    refuse("without vertices", [](auto& r) { r.mutable_mesh(0)->mutable_mesh(0)->set_triangles(0); });
    refuse("16 sets of uvs", [](auto& r) { r.mutable_mesh(0)->mutable_mesh(0)->set_more_uv_sets(16); });
    refuse("blob without meshes", [](auto& r) { *r.add_mesh()->mutable_blob() = r.mesh(0).blob(); });
    refuse("without texels", [](auto& r) {
        r.mutable_skeleton()->mutable_texture(0)->mutable_texels()->set_width(0);
        r.mutable_texture(0)->set_size(0);
    });
    refuse("without texels", [](auto& r) {
        r.mutable_skeleton()->mutable_environment()->mutable_map()->set_height(0);
        r.mutable_environment()->set_size(0);
    });
}

TEST(SceneRoot, NamesOfBlobsThatAreNoHashAreRefused) {
    refuse("SHA-256", [](auto& r) { r.mutable_texture(0)->set_sha256(""); });
    refuse("SHA-256", [](auto& r) { r.mutable_texture(0)->mutable_sha256()->pop_back(); });
    refuse("SHA-256", [](auto& r) { r.mutable_mesh(0)->mutable_blob()->mutable_sha256()->push_back('x'); });
    refuse("SHA-256", [](auto& r) { r.mutable_mesh(0)->clear_blob(); });
}

TEST(SceneRoot, ABlobOfTwoSizesIsRefused) {
    refuse("two sizes", [](auto& r) { r.mutable_environment()->set_sha256(r.texture(0).sha256()); });
}

TEST(SceneRoot, MoreOrFewerBlobsThanListsAreRefused) {
    refuse("exactly its meshes", [](auto& r) { r.mutable_skeleton()->mutable_mesh()->RemoveLast(); });
    refuse("exactly its meshes", [](auto& r) { r.mutable_skeleton()->add_mesh()->set_material("#0"); });
    refuse("exactly its textures", [](auto& r) { *r.add_texture() = r.texture(0); });
    refuse("exactly its textures", [](auto& r) { r.mutable_texture()->RemoveLast(); });
    refuse("exactly its environment", [](auto& r) { r.clear_environment(); });
    refuse("exactly its environment", [](auto& r) { r.mutable_skeleton()->mutable_environment()->clear_map(); });
    refuse("exactly its environment", [](auto& r) { r.mutable_skeleton()->clear_environment(); });
}

TEST(SceneRoot, SkeletonsWithArraysAreRefused) {
    refuse("mesh that is not empty", [](auto& r) {
        r.mutable_skeleton()->mutable_mesh(0)->add_triangles(1),
            r.mutable_skeleton()->mutable_mesh(0)->add_triangles(1),
            r.mutable_skeleton()->mutable_mesh(0)->add_triangles(1);
    });
    refuse("mesh that is not empty", [](auto& r) { r.mutable_skeleton()->mutable_mesh(0)->mutable_transform(); });
    refuse("mesh that is not empty", [](auto& r) {
        for (int i = 0; i < 4; ++i) r.mutable_skeleton()->mutable_mesh(0)->add_tangents(0);
    });
    refuse("texture that is not empty",
           [](auto& r) { r.mutable_skeleton()->mutable_texture(0)->mutable_texels()->set_rgba("12345678"); });
    refuse("map that is not empty", [](auto& r) {
        for (int i = 0; i < 3; ++i) r.mutable_skeleton()->mutable_environment()->mutable_map()->add_rgb(1);
    });
}

TEST(SceneRoot, FilesAndHelperShapesAreRefused) {
    refuse("files", [](auto& r) { r.mutable_skeleton()->add_model()->set_file("/etc/passwd"); });
    refuse("files", [](auto& r) { r.mutable_skeleton()->mutable_texture(0)->set_file("/etc/passwd"); });
    refuse("files", [](auto& r) { r.mutable_skeleton()->mutable_environment()->set_file("x.exr"); });
    refuse("meshes and spheres only", [](auto& r) { r.mutable_skeleton()->add_quad(); });
    refuse("meshes and spheres only", [](auto& r) { r.mutable_skeleton()->add_box(); });
    refuse("meshes and spheres only", [](auto& r) { r.mutable_skeleton()->add_disk()->set_segments(0xFFFFFFFF); });
    refuse("meshes and spheres only", [](auto& r) { r.mutable_skeleton()->add_ripple_grid()->set_cells_x(60000); });
    refuse("camera", [](auto& r) { r.mutable_skeleton()->clear_camera(); });
}

TEST(SceneRoot, ReferencesThatLeadNowhereAreRefused) {
    refuse("does not exist", [](auto& r) { r.mutable_skeleton()->mutable_mesh(0)->set_material("#3"); });
    refuse("does not exist", [](auto& r) { r.mutable_skeleton()->mutable_material(0)->set_normal_texture("#2"); });
}

TEST(SceneRoot, TooManyBytesOrPartsAreRefused) {
    expectError(ErrorCode::Input, "more bytes", [] { parseSceneRoot(std::string(maxSceneRootBytes + 1, '\0')); });
    // Two bytes each that would become messages: blobs without a name.
    std::string bytes;
    for (size_t i = 0; i <= maxSceneRootParts; ++i) bytes += std::string("\x1A\0", 2);
    expectError(ErrorCode::Input, "more parts", [&] { parseSceneRoot(bytes); });
}

TEST(SceneRoot, DeepNestingIsRefused) {
    std::string bytes;
    for (int i = 0; i < 100000; ++i) bytes += "\xA3\x06";
    expectError(ErrorCode::Input, "more parts", [&] { parseSceneRoot(bytes); });
}

TEST(PartCount, CountsMessagesAtAllDepthsStringsInListsAndUnknownFields) {
    farm::SceneRoot root;
    const auto count = [&] { return partCount(root.SerializeAsString(), *farm::SceneRoot::descriptor(), 100); };
    EXPECT_EQ(count(), 0u);
    root.mutable_skeleton()->set_name("name");
    EXPECT_EQ(count(), 1u);
    root.mutable_skeleton()->add_notice("one");
    root.mutable_skeleton()->add_notice("two");
    EXPECT_EQ(count(), 3u);
    root.mutable_skeleton()->mutable_camera()->set_vertical_fov(1);
    EXPECT_EQ(count(), 4u);
    root.add_mesh()->add_mesh()->set_triangles(7);
    EXPECT_EQ(count(), 6u);
    root.add_texture()->set_size(1);
    EXPECT_EQ(count(), 7u);
    EXPECT_EQ(partCount(root.SerializeAsString() + "\xA2\x06\x01x", *farm::SceneRoot::descriptor(), 100), 8u);
}

TEST(PartCount, StopsAboveTheLimit) {
    std::string bytes;
    for (int i = 0; i < 1000; ++i) bytes += std::string("\x1A\0", 2);
    EXPECT_EQ(partCount(bytes, *farm::SceneRoot::descriptor(), 10), 11u);
}

}  // namespace
}  // namespace antipode::wire
