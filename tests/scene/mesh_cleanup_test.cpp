#include "scene/mesh_cleanup.h"

#include <gtest/gtest.h>

#include "scene/affine.h"

namespace antipode {
namespace {

Mesh twoTriangles() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    return mesh;
}

TEST(MeshCleanup, DropsOnlyTrianglesWithoutArea) {
    Mesh mesh = twoTriangles();
    mesh.triangles.push_back({0, 1, 1});
    mesh.positions.push_back({2, 0, 0});
    mesh.triangles.push_back({0, 1, 6});  // three points in a line
    mesh.positions.push_back({0.5f, 1e-30f, 0});
    mesh.triangles.push_back({0, 1, 7});  // a needle
    EXPECT_EQ(dropDegenerateTriangles(mesh), 2u);
    EXPECT_EQ(mesh.triangles.size(), 3u);
}

TEST(MeshCleanup, DropsNormalsThatRepeatTheFaces) {
    Mesh mesh = twoTriangles();
    mesh.normals.assign(6, Vec3f(0, 0, 1));
    EXPECT_FALSE(dropIdleNormals(mesh));
    EXPECT_TRUE(mesh.normals.empty());
}

TEST(MeshCleanup, DropsOneNormalOnFacesOfSeveralDirections) {
    Mesh mesh = twoTriangles();
    mesh.positions[4].z = 0.5f;
    mesh.normals.assign(6, Vec3f(0, 0, 1));
    EXPECT_TRUE(dropIdleNormals(mesh));
    EXPECT_TRUE(mesh.normals.empty());
}

TEST(MeshCleanup, KeepsSmoothNormals) {
    Mesh mesh = twoTriangles();
    mesh.positions[4].z = 0.5f;
    mesh.normals.assign(6, Vec3f(0, 0, 1));
    mesh.normals[4] = normalize(Vec3f(-1, -1, 2));
    EXPECT_FALSE(dropIdleNormals(mesh));
    EXPECT_EQ(mesh.normals.size(), 6u);
}

TEST(MeshCleanup, JoinsEqualVerticesAndKeepsTriangles) {
    Mesh mesh = twoTriangles();
    joinVertices(mesh);
    EXPECT_EQ(mesh.positions.size(), 4u);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.positions[mesh.triangles[1][1]], Vec3f(1, 1, 0));
}

TEST(MeshCleanup, KeepsVerticesApartWhoseNormalsOrUvsDiffer) {
    Mesh mesh = twoTriangles();
    mesh.uvs = {{0, 0}, {0, 0}, {0, 0}, {0, 1}, {0, 0}, {0, 0}};
    joinVertices(mesh);
    EXPECT_EQ(mesh.positions.size(), 5u);
    EXPECT_EQ(mesh.uvs.size(), 5u);
}

TEST(MeshCleanup, NormalsGetUnitLengthAndUnitOnesStay) {
    Mesh mesh = twoTriangles();
    const Vec3f unit = Vec3f(normalize(Vec3d(1, 2, 3)));
    mesh.normals.assign(6, unit);
    mesh.normals[0] = {0, 0, 5};
    mesh.normals[1] = {0, 0, 0};
    normalizeNormals(mesh);
    EXPECT_EQ(mesh.normals[0], Vec3f(0, 0, 1));
    EXPECT_EQ(mesh.normals[1], Vec3f(0, 0, 1)) << "a zero normal becomes the triangle's";
    EXPECT_EQ(mesh.normals[2], unit);
}

TEST(Affine, MirroringKeepsFrontsAndNormalsTogether) {
    Mesh mesh = twoTriangles();
    mesh.normals.assign(6, {0, 0, 1});
    transformMesh(mesh, Affine{{2, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 7}});
    const auto& t = mesh.triangles[0];
    const Vec3f front = cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
    EXPECT_EQ(mesh.normals[0], Vec3f(0, 0, -1));
    EXPECT_GT(dot(front, mesh.normals[0]), 0);
}

TEST(Affine, NormalsFollowTheInverseTranspose) {
    const Affine squash{{4, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}};
    const Vec3d normal = normalize(Vec3d(1, 1, 0)), tangent = Vec3d(1, -1, 0);
    EXPECT_NEAR(dot(squash.normal(normal), squash.vector(tangent)), 0, 1e-15);
}

}  // namespace
}  // namespace antipode
