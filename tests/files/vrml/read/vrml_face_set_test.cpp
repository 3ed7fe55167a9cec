#include "files/vrml/read/vrml_face_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace icome::files {
namespace {

using base::Vector2;
using base::Vector3;
using MeshTriangle = geometry::TriangleMesh::Triangle;

struct MadeMesh {
  std::shared_ptr<world::MeshGeometry> mesh;
  std::vector<std::string> found;
};

MadeMesh made_of(const VrmlFaceSet& faces, bool shows_picture = false) {
  Findings findings;
  io::TimeBudget time_budget;
  MadeMesh result{mesh_of_faces(faces, shows_picture, findings, time_budget), {}};
  for (const Remark& remark : findings.remarks()) result.found.push_back(remark.text);
  return result;
}

/// Two triangles that make the square from (0, 0) to (1, 1).
VrmlFaceSet square_faces() {
  VrmlFaceSet faces;
  faces.name = "square";
  faces.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  faces.polygons = {0, 1, 2, -1, 0, 2, 3, -1};
  return faces;
}

using FoundTexts = std::vector<std::string>;

TEST(VrmlFaceSet, BecomeTriangles) {
  const MadeMesh it = made_of(square_faces());
  ASSERT_TRUE(it.mesh);
  EXPECT_EQ(it.mesh->mesh.positions, (std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(it.mesh->mesh.triangles, (std::vector<MeshTriangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(it.mesh->normals.empty());
  EXPECT_TRUE(it.mesh->colours.empty());
  EXPECT_TRUE(it.mesh->texture_coordinates.empty());
  EXPECT_EQ(it.found, FoundTexts{});
}

TEST(VrmlFaceSet, KeepNumbersAsTheyWereWritten) {
  VrmlFaceSet faces = square_faces();
  faces.positions[3] = 0.1F;
  EXPECT_EQ(made_of(faces).mesh->mesh.positions[1].x(), 0.1);
}

TEST(VrmlFaceSet, NeedNoMarkAtTheEnd) {
  VrmlFaceSet faces = square_faces();
  faces.polygons.pop_back();
  EXPECT_EQ(made_of(faces).mesh->mesh.triangles.size(), 2U);
}

TEST(VrmlFaceSet, CutConcavePolygons) {
  VrmlFaceSet faces;
  // An L of area 3.
  faces.positions = {0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0};
  faces.polygons = {0, 1, 2, 3, 4, 5, -1};
  const MadeMesh it = made_of(faces);
  ASSERT_EQ(it.mesh->mesh.triangles.size(), 4U);
  EXPECT_DOUBLE_EQ(geometry::surface_area(it.mesh->mesh), 3.0);
  for (const MeshTriangle& t : it.mesh->mesh.triangles) {
    const Vector3 a = it.mesh->mesh.positions[t[0]];
    EXPECT_GT((it.mesh->mesh.positions[t[1]] - a).cross(it.mesh->mesh.positions[t[2]] - a).z(), 0.0);
  }
}

TEST(VrmlFaceSet, TurnRoundWhenClockwise) {
  VrmlFaceSet faces = square_faces();
  faces.ccw = false;
  // Colours stay with their vertices.
  faces.colours = {0, 0, 0, 0.25F, 0, 0, 0.5F, 0, 0, 1, 0, 0};
  const MadeMesh it = made_of(faces);
  EXPECT_EQ(it.mesh->mesh.triangles[0], (MeshTriangle{2, 1, 0}));
  EXPECT_EQ(it.mesh->colours[0][0][0], 0.5F);
  EXPECT_EQ(it.mesh->colours[0][2][0], 0.0F);
}

TEST(VrmlFaceSet, LeaveShortFacesOut) {
  VrmlFaceSet faces = square_faces();
  faces.polygons = {0, 1, -1, -1, 0, 1, 1, -1, 0, 0, 1, 2, 2, 0, -1, 0, 1, 0, -1};
  const MadeMesh it = made_of(faces);
  EXPECT_EQ(it.mesh->mesh.triangles, (std::vector<MeshTriangle>{{0, 1, 2}}));
  EXPECT_EQ(it.found, FoundTexts{"Faces with fewer than three corners are left out: 4 of \"square\"."});
}

TEST(VrmlFaceSet, LeaveFacesOutWhoseVerticesAreNotThere) {
  VrmlFaceSet faces = square_faces();
  faces.polygons = {0, 1, 4, -1, 0, 1, -2, -1, 1, 2, 3, -1, 0, 1, 2, -1};
  faces.positions[0] = std::numeric_limits<float>::quiet_NaN();
  const MadeMesh it = made_of(faces);
  EXPECT_EQ(it.mesh->mesh.triangles, (std::vector<MeshTriangle>{{0, 1, 2}}));
  EXPECT_EQ(it.mesh->mesh.positions.size(), 3U);
  EXPECT_EQ(it.found, FoundTexts{"Faces with vertices that are not there are left out: 3 of \"square\"."});
}

TEST(VrmlFaceSet, LeaveVerticesOutThatNoFaceUses) {
  VrmlFaceSet faces = square_faces();
  faces.positions.insert(faces.positions.begin(), {100, 100, 100});
  for (std::int32_t& vertex : faces.polygons) vertex += vertex >= 0 ? 1 : 0;
  const MadeMesh it = made_of(faces);
  EXPECT_EQ(it.mesh->mesh.positions.size(), 4U);
  EXPECT_EQ(it.mesh->bounds().max(), Vector3(1, 1, 0));
}

TEST(VrmlFaceSet, AreNullWhereNothingIsLeft) {
  VrmlFaceSet faces = square_faces();
  faces.polygons = {0, 1, -1};
  EXPECT_FALSE(made_of(faces).mesh);
  EXPECT_FALSE(made_of(VrmlFaceSet{}).mesh);
}

TEST(VrmlFaceSet, HaveNormalsByTheirCreaseAngle) {
  VrmlFaceSet faces = square_faces();
  faces.positions[8] = 1.0F;  // folds it along the diagonal
  MadeMesh it = made_of(faces);
  ASSERT_EQ(it.mesh->normals.size(), 2U);
  EXPECT_NE(it.mesh->normals[0][0], it.mesh->normals[1][0]);
  faces.crease_angle = 3.0;
  EXPECT_TRUE(made_of(faces).mesh->normals.empty());
}

// The ways in which VRML 2.0, 6.23, finds the normal, colour or texture coordinate of a corner.

TEST(VrmlFaceSet, TakeNormalsOfVertices) {
  VrmlFaceSet faces = square_faces();
  faces.normals = {2, 0, 0, 0, 3, 0, 0, 0, 1, 0, 0, -1};
  MadeMesh it = made_of(faces);
  EXPECT_EQ(it.mesh->normals[0],
            (std::array<Vector3, 3>{Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)}));
  EXPECT_EQ(it.mesh->normals[1],
            (std::array<Vector3, 3>{Vector3(1, 0, 0), Vector3(0, 0, 1), Vector3(0, 0, -1)}));
  faces.normal_polygons = {3, 2, 1, -1, 0, 0, 1, -1};
  it = made_of(faces);
  EXPECT_EQ(it.mesh->normals[0],
            (std::array<Vector3, 3>{Vector3(0, 0, -1), Vector3(0, 0, 1), Vector3(0, 1, 0)}));
  EXPECT_EQ(it.mesh->normals[1],
            (std::array<Vector3, 3>{Vector3(1, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)}));
}

TEST(VrmlFaceSet, TakeNormalsOfFaces) {
  VrmlFaceSet faces = square_faces();
  faces.normal_per_vertex = false;
  faces.normals = {1, 0, 0, 0, 1, 0};
  MadeMesh it = made_of(faces);
  for (int corner = 0; corner < 3; ++corner) {
    EXPECT_EQ(it.mesh->normals[0][corner], Vector3(1, 0, 0));
    EXPECT_EQ(it.mesh->normals[1][corner], Vector3(0, 1, 0));
  }
  faces.normal_polygons = {1, 1};
  EXPECT_EQ(made_of(faces).mesh->normals[0][0], Vector3(0, 1, 0));
}

TEST(VrmlFaceSet, CountFacesThatAreLeftOut) {
  VrmlFaceSet faces = square_faces();
  faces.polygons = {0, 1, -1, 0, 1, 2, -1};
  faces.normal_per_vertex = false;
  faces.normals = {1, 0, 0, 0, 1, 0};
  EXPECT_EQ(made_of(faces).mesh->normals[0][0], Vector3(0, 1, 0));
}

TEST(VrmlFaceSet, MakeNormalsAnewThatDoNotFit) {
  for (const std::vector<float>& normals : {std::vector<float>{0, 0, 1},
                                            {0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1},
                                            {0, 0, 1, 0, 0, 1, 0, 0, NAN, 0, 0, 1}}) {
    VrmlFaceSet faces = square_faces();
    faces.normals = normals;
    const MadeMesh it = made_of(faces);
    EXPECT_TRUE(it.mesh->normals.empty());
    EXPECT_EQ(it.found, FoundTexts{"Normals that do not fit the faces are made anew: \"square\"."});
  }
}

TEST(VrmlFaceSet, TakeColoursOfVerticesAndFaces) {
  VrmlFaceSet faces = square_faces();
  faces.colours = {1, 0, 0, 0, 1, 0};
  faces.colour_per_vertex = false;
  EXPECT_EQ(made_of(faces).mesh->colours[1][2], (world::Colour{0, 1, 0}));
  faces.colour_polygons = {1, 0};
  EXPECT_EQ(made_of(faces).mesh->colours[1][2], (world::Colour{1, 0, 0}));
  faces.colour_per_vertex = true;
  EXPECT_EQ(made_of(faces).found, FoundTexts{"Colours that do not fit the faces are left out: \"square\"."});
  faces.colour_polygons = {0, 1, 0, -1, 1, 0, 1, -1};
  const MadeMesh it = made_of(faces);
  EXPECT_EQ(it.mesh->colours[0][1], (world::Colour{0, 1, 0}));
  EXPECT_EQ(it.mesh->colours[1][0], (world::Colour{0, 1, 0}));
}

TEST(VrmlFaceSet, CutColoursOff) {
  VrmlFaceSet faces = square_faces();
  faces.colour_per_vertex = false;
  faces.colours = {2, -1, 0.5F, NAN, 0, 0};
  const MadeMesh it = made_of(faces);
  EXPECT_EQ(it.mesh->colours[0][0], (world::Colour{1, 0, 0.5F}));
  EXPECT_EQ(it.mesh->colours[1][0], (world::Colour{0, 0, 0}));
  EXPECT_EQ(it.found,
            FoundTexts{"Colours of vertices and faces are cut off to lie between 0 and 1: \"square\"."});
}

TEST(VrmlFaceSet, TakeTextureCoordinatesByTheirList) {
  VrmlFaceSet faces = square_faces();
  faces.texture_coordinates = {0, 0, 0.5F, 0, 0.5F, 0.1F, 0, 1};
  EXPECT_EQ(made_of(faces).mesh->texture_coordinates[0][2], Vector2(0.5, 0.1));
  faces.texture_polygons = {3, 2, 1, -1, 0, 0, 0, -1};
  const MadeMesh it = made_of(faces);
  EXPECT_EQ(it.mesh->texture_coordinates[0][0], Vector2(0, 1));
  EXPECT_EQ(it.mesh->texture_coordinates[0][2], Vector2(0.5, 0));
  faces.texture_polygons = {3, 2, 1, -1, 0, 0};
  EXPECT_EQ(made_of(faces).found,
            FoundTexts{"Texture coordinates that do not fit the faces are left out: \"square\"."});
}

TEST(VrmlFaceSet, HaveTextureCoordinatesByTheirBoxIfThereIsAPicture) {
  VrmlFaceSet faces = square_faces();
  // 4 along y, 2 along z, 1 along x, somewhere.
  faces.positions = {5, 1, 1, 6, 1, 1, 6, 5, 3, 5, 5, 3};
  EXPECT_TRUE(made_of(faces).mesh->texture_coordinates.empty());
  const MadeMesh it = made_of(faces, true);
  EXPECT_EQ(it.mesh->texture_coordinates[0],
            (std::array<Vector2, 3>{Vector2(0, 0), Vector2(0, 0), Vector2(1, 0.5)}));
  // Of sides as long as each other x comes first.
  EXPECT_EQ(made_of(square_faces(), true).mesh->texture_coordinates[1][2], Vector2(0, 1));
}

TEST(VrmlFaceSet, StopWhenPatienceEnds) {
  VrmlFaceSet faces;
  for (int i = 0; i < 4000; ++i)
    faces.positions.insert(faces.positions.end(), {float(i % 7), float(i % 5), 0});
  for (int face = 0; face < 600; ++face) {
    for (int i = 0; i < 6; ++i) faces.polygons.push_back(6 * face + i);
    faces.polygons.push_back(-1);
  }
  Findings findings;
  io::TimeBudget time_budget(-1.0, nullptr, 0.0);
  EXPECT_FALSE(mesh_of_faces(faces, {}, findings, time_budget));
}

}  // namespace
}  // namespace icome::files
