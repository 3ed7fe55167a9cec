// What the process that parses VRML makes of each kind of node.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "base/vector.h"
#include "files/vrml_seen.h"

namespace icome::files {
namespace {

template <typename Numbers>
auto vector_of(const Numbers* numbers) {
  using Number = std::remove_cvref_t<decltype(numbers->Get(0))>;
  return numbers ? std::vector<Number>(numbers->begin(), numbers->end()) : std::vector<Number>();
}

/// The one answer to a text that must be read without a remark.
SeenAnswer clean(const std::string& text) {
  SeenAnswer answer = ask_about(text);
  EXPECT_EQ(answer.refusal(), "");
  EXPECT_EQ(answer.notes(), "");
  return answer;
}

base::Affine3 matrix_of(const flat::Node* node) {
  base::Affine3 matrix = base::Affine3::Identity();
  const auto numbers = vector_of(node->matrix());
  EXPECT_EQ(numbers.size(), 12U);
  if (numbers.size() == 12)
    matrix.affine() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers.data());
  return matrix;
}

/// The volume within faces whose corners go round as seen from outside; each is cut from its first corner.
double volume(const flat::Geometry* geometry) {
  const auto point = [&](int v) {
    const auto at = static_cast<flatbuffers::uoffset_t>(3 * v);
    return base::Vector3(geometry->positions()->Get(at), geometry->positions()->Get(at + 1),
                         geometry->positions()->Get(at + 2));
  };
  double sum = 0.0;
  std::vector<int> face;
  for (const int v : *geometry->polygons()) {
    if (v >= 0) {
      face.push_back(v);
      continue;
    }
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      sum += point(face[0]).dot(point(face[i]).cross(point(face[i + 1]))) / 6.0;
    face.clear();
  }
  return sum;
}

/// Each edge of a closed surface is passed once in each direction.
bool is_closed(const flat::Geometry* geometry) {
  std::map<std::pair<int, int>, int> edges;
  std::vector<int> face;
  for (const int v : *geometry->polygons()) {
    if (v >= 0) {
      face.push_back(v);
      continue;
    }
    for (std::size_t i = 0; i < face.size(); ++i) ++edges[{face[i], face[(i + 1) % face.size()]}];
    face.clear();
  }
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto other = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && other != edges.end();
  });
}

const std::string kSquare =
    "coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0, 0 0 1 ] } coordIndex [ 0 1 2 3 -1 0 1 9 -1 0 1 4 "
    "] ";

TEST(VrmlWorker, TransformsAreWhatTheirFieldsSay) {
  const SeenAnswer answer = clean(
      "Transform { translation 1.1 2.2 -3.3 center 0.5 0 0.25 rotation 1 2 3 0.7 scale 1 2 0.5\n"
      "  scaleOrientation 0 0 1 0.3 }");
  const base::Vector3 centre(0.5, 0.0, 0.25);
  const Eigen::AngleAxisd rotation(0.7, base::Vector3(1, 2, 3).normalized());
  const Eigen::AngleAxisd along(0.3, base::Vector3::UnitZ());
  base::Affine3 expected = base::Affine3::Identity();
  expected.translate(base::Vector3(1.1, 2.2, -3.3)).translate(centre).rotate(rotation).rotate(along);
  expected.scale(base::Vector3(1, 2, 0.5)).rotate(along.inverse()).translate(-centre);
  // Coin keeps rotations as single precision quaternions.
  EXPECT_TRUE(matrix_of(answer->nodes()->Get(0)).matrix().isApprox(expected.matrix(), 1e-6));
}

TEST(VrmlWorker, NumbersAreAsTheyWereWritten) {
  const SeenAnswer answer = clean(
      "Transform { translation 0.1 -2.7 1e-3 rotation 0 1 0 1.5708 }\n"
      "Transform { translation 0.3 0 0 center 0.1 0.2 0.7 scale 3 3 3 scaleOrientation 1 0 0 1 }\n"
      "Viewpoint { position 0 1.6 9.9 orientation 1 0 0 -0.3 fieldOfView 0.9 description \"front\" }");
  const base::Affine3 turned = matrix_of(answer->nodes()->Get(0));
  EXPECT_EQ(turned.translation(), base::Vector3(0.1, -2.7, 1e-3));
  EXPECT_EQ(turned.linear(), Eigen::AngleAxisd(1.5708, base::Vector3::UnitY()).toRotationMatrix());
  EXPECT_EQ(matrix_of(answer->nodes()->Get(1)).linear(), base::Matrix3(3.0 * base::Matrix3::Identity()));
  const flat::Node* view = answer->nodes()->Get(2);
  EXPECT_EQ(view->name()->str(), "front");
  EXPECT_EQ(view->viewpoint()->position()->y(), 1.6);
  EXPECT_EQ(view->viewpoint()->field_of_view(), 0.9);
  EXPECT_EQ(std::abs(view->viewpoint()->angle()), 0.3);
  EXPECT_EQ(view->viewpoint()->axis()->x() * view->viewpoint()->angle(), -0.3);
}

TEST(VrmlWorker, NodesKeepTheirNames) {
  const SeenAnswer answer = clean(
      "DEF Stra\xc3\x9f"
      "e Group { children [ WorldInfo { title \"Main street\" } ] }\n"
      "DEF a.b(c)|d Group {} DEF 9x Group {} DEF with+3 Group {} DEF plain_1-2 Group {}\n"
      "PROTO P [] { DEF inner Group {} } P {} DEF outer P {}");
  const std::vector<std::string> defs = {
      "Stra\xc3\x9f"
      "e",
      "a.b(c)|d",
      "9x",
      "with",
      "plain_1-2",
      "",
      "outer"};
  ASSERT_EQ(answer->nodes()->size(), defs.size());
  for (std::size_t i = 0; i < defs.size(); ++i) {
    const auto* def = answer->nodes()->Get(static_cast<flatbuffers::uoffset_t>(i))->def();
    EXPECT_EQ(def ? def->str() : "", defs[i]);
  }
  EXPECT_EQ(answer->nodes()->Get(0)->name()->str(), "Main street");
  EXPECT_EQ(answer->nodes()->Get(5)->name()->str(), "inner");
}

TEST(VrmlWorker, UsesStandAnewAndShareShapes) {
  const SeenAnswer answer = clean(
      "DEF G Group { children [ DEF S Shape { geometry Box {} } Group {} ] } USE G USE S\n"
      "Shape { appearance Appearance { material DEF M Material {} } geometry DEF B Box {} }\n"
      "Shape { appearance Appearance { material USE M } geometry USE B }");
  ASSERT_EQ(answer->nodes()->size(), 9U);
  EXPECT_EQ(answer->geometries()->size(), 2U);
  EXPECT_EQ(answer->appearances()->size(), 1U);
  const std::vector<bool> reused = {false, false, false, true, true, true, true, false, false};
  for (std::size_t i = 0; i < reused.size(); ++i)
    EXPECT_EQ(answer->nodes()->Get(static_cast<flatbuffers::uoffset_t>(i))->reused(), reused[i]) << i;
  EXPECT_EQ(answer->nodes()->Get(4)->parent(), 3);
  EXPECT_EQ(answer->nodes()->Get(4)->geometry(), 0);
}

TEST(VrmlWorker, GroupsShowWhatAViewerShows) {
  const SeenAnswer answer = ask_about(
      "LOD { level [ DEF Fine Group {} DEF Coarse Group {} ] range 5 }\n"
      "Switch { whichChoice 1 choice [ DEF No Group {} DEF Yes Group {} ] } Switch { choice DEF Off Group {} "
      "}\n"
      "Anchor { url \"x\" children DEF A Group {} } Billboard { children DEF B Group {} }\n"
      "Collision { children DEF C Group {} proxy DEF P Group {} } TouchSensor {} Fog {}");
  std::string defs;
  for (const flat::Node* node : *answer->nodes()) defs += node->def() ? node->def()->str() + " " : "";
  EXPECT_EQ(defs, "Fine Yes A B C ");
  EXPECT_EQ(answer.notes(),
            ":0: Of a Switch only what it shows is kept.\n:0: Of a Switch only what it shows is kept.\n");
}

TEST(VrmlWorker, ProtosArePutIntoPlace) {
  const SeenAnswer answer = clean(
      "PROTO Ball [ field SFFloat size 1 field SFNode look NULL ] {\n"
      "  PROTO Skin [ field SFColor c 0 0 0 ] { Material { diffuseColor IS c } }\n"
      "  Shape { appearance Appearance { material Skin { c 0.25 0.5 1 } } geometry Sphere { radius IS size } "
      "}\n"
      "  Group {} }\n"
      "PROTO Two [ field SFFloat r 3 field MFNode more [] ] {\n"
      "  Group { children [ Ball { size IS r } Group { children IS more } ] } }\n"
      "Two { r 0.7 more [ Ball { } Group {} ] }");
  ASSERT_EQ(answer->nodes()->size(), 5U);
  EXPECT_EQ(answer->geometries()->Get(0)->sizes()->Get(0), 0.7);
  EXPECT_EQ(answer->geometries()->Get(1)->sizes()->Get(0), 1.0);
  EXPECT_EQ(answer->appearances()->Get(0)->diffuse()->r(), 0.25F);
}

TEST(VrmlWorker, LightsAreTold) {
  const SeenAnswer answer = clean(
      "DirectionalLight { direction 1 0 0 color 1 0.5 0 } PointLight { location 1 2 3 on FALSE }\n"
      "SpotLight { cutOffAngle 0.4 beamWidth 0.2 attenuation 0 1 0.1 }");
  EXPECT_EQ(answer->nodes()->Get(0)->light()->direction()->x(), 1.0);
  EXPECT_EQ(answer->nodes()->Get(0)->light()->colour()->g(), 0.5F);
  EXPECT_EQ(answer->nodes()->Get(1)->light()->kind(), flat::LightKind::Point);
  EXPECT_FALSE(answer->nodes()->Get(1)->light()->on());
  EXPECT_EQ(answer->nodes()->Get(2)->light()->cut_off_angle(), 0.4);
  EXPECT_EQ(answer->nodes()->Get(2)->light()->attenuation()->z(), 0.1);
}

TEST(VrmlWorker, PicturesAndTheirTransformsAreTold) {
  const SeenAnswer answer = clean(
      "Shape { appearance DEF App Appearance { texture PixelTexture { image 2 1 3 0xff0080 1 repeatS FALSE "
      "}\n"
      "  textureTransform TextureTransform { translation 1 0 scale 2 3 rotation 0.5 center 0.5 0.5 } }\n"
      "  geometry Box {} }\n"
      "Shape { appearance Appearance { texture ImageTexture { url [ \"a.png\" \"b.png\" ] } } geometry Box "
      "{} }");
  const flat::Picture* pixels = answer->pictures()->Get(0);
  EXPECT_EQ(pixels->width(), 2U);
  EXPECT_EQ(pixels->channels(), 3U);
  EXPECT_FALSE(pixels->repeat_s());
  EXPECT_EQ(vector_of(pixels->pixels()), (std::vector<std::uint8_t>{255, 0, 128, 0, 0, 1}));
  EXPECT_EQ(answer->pictures()->Get(1)->urls()->Get(1)->text()->str(), "b.png");
  const flat::Appearance* appearance = answer->appearances()->Get(0);
  EXPECT_EQ(appearance->name()->str(), "App");
  EXPECT_FALSE(appearance->lit());
  // -C S R C T of the point (0.25, 0).
  const base::Vector2 centre(0.5, 0.5);
  const base::Vector2 turned =
      Eigen::Rotation2Dd(0.5) * (base::Vector2(0.25, 0) + base::Vector2(1, 0) + centre);
  const base::Vector2 expected = base::Vector2(2, 3).cwiseProduct(turned) - centre;
  const auto m = vector_of(appearance->texture_transform());
  EXPECT_NEAR(m[0] * 0.25 + m[2], expected.x(), 1e-12);
  EXPECT_NEAR(m[3] * 0.25 + m[5], expected.y(), 1e-12);
}

TEST(VrmlWorker, FacesAreCheckedBeforeTheyAreTold) {
  const SeenAnswer answer = ask_about("Shape { geometry IndexedFaceSet { " + kSquare +
                                      "colorPerVertex FALSE color Color { color [ 1 0 0, 0 1 0, 0 0 1 ] }\n"
                                      "texCoord TextureCoordinate { point [ 0 0, 1 1 ] }\n"
                                      "texCoordIndex [ 0 1 0 1 -1 0 1 0 -1 0 0 1 -1 ] } }");
  const flat::Geometry* geometry = answer->geometries()->Get(0);
  EXPECT_EQ(vector_of(geometry->polygons()), (std::vector<int>{0, 1, 2, 3, -1, 0, 1, 4, -1}));
  EXPECT_EQ(vector_of(geometry->texture_polygons()), (std::vector<int>{0, 1, 0, 1, -1, 0, 0, 1, -1}));
  EXPECT_EQ(vector_of(geometry->colour_polygons()), (std::vector<int>{0, 2}));
  EXPECT_NE(answer.notes().find("1 of 3 faces are left out"), std::string::npos) << answer.notes();
}

TEST(VrmlWorker, ListsThatDoNotFitAreLeftOut) {
  const auto notes = [](const std::string& fields) {
    const SeenAnswer answer = ask_about(
        "Shape { geometry IndexedFaceSet { coord Coordinate { point [\n"
        "0 0 0, 1 0 0, 1 1 0 ] } coordIndex [ 0 1 2 -1 ] " +
        fields + " } }");
    EXPECT_EQ(answer->geometries()->size(), 1U);
    return answer.notes();
  };
  EXPECT_EQ(notes(""), "");
  EXPECT_EQ(notes("normal Normal { vector [ 0 0 1 0 0 1 0 0 1 ] } normalIndex [ 0 1 2 ]"), "");
  const std::string head = ":0: IndexedFaceSet: its ";
  EXPECT_EQ(notes("color Color { color [ 1 0 0 ] }"), head + "colours are left out: there are not enough.\n");
  EXPECT_EQ(notes("normal Normal { vector [ 0 0 1 ] } normalIndex [ 0 0 7 -1 ]"),
            head + "normals are left out: an index is wrong.\n");
  EXPECT_EQ(notes("normal Normal { vector [ 0 0 1 ] } normalIndex [ 0 0 ]"),
            head + "normals are left out: its list of indices is too short.\n");
  EXPECT_EQ(notes("texCoord TextureCoordinate { point [ 0 0 ] } texCoordIndex [ 0 0 -1 0 ]"),
            head + "texture coordinates are left out: its list of indices has other faces.\n");
  EXPECT_EQ(notes("color Color { color [ 1 0 0 ] } colorPerVertex FALSE colorIndex [ -1 ]"),
            head + "colours are left out: an index is wrong.\n");
}

TEST(VrmlWorker, RoundSolidsWithoutAPartAreFaces) {
  const SeenAnswer answer = clean(
      "Shape { geometry Cone { bottomRadius 2 height 3 bottom FALSE } } Shape { geometry Cylinder { side "
      "FALSE } }\n"
      "Shape { geometry Cone { bottomRadius 2 height 3 } }");
  EXPECT_EQ(answer->geometries()->Get(0)->kind(), flat::GeometryKind::Faces);
  EXPECT_EQ(answer->geometries()->Get(0)->positions()->size(), 3U * 49U);
  // Open towards the bottom, whose plane lies at y = -1.5: its cone of the origin is missing.
  const double disc = 0.5 * 48 * 4.0 * std::sin(2 * M_PI / 48);
  EXPECT_NEAR(volume(answer->geometries()->Get(0)), disc * 3.0 / 3.0 - disc * 1.5 / 3.0, 1e-5);
  EXPECT_EQ(answer->geometries()->Get(1)->polygons()->size(), 2U * 49U);
  EXPECT_GT(volume(answer->geometries()->Get(1)), 0.0);
  EXPECT_EQ(answer->geometries()->Get(2)->kind(), flat::GeometryKind::Cone);
}

TEST(VrmlWorker, ExtrusionsAreClosedAndLookOutward) {
  const SeenAnswer answer = clean(
      "Shape { geometry Extrusion {} }\n"
      // Bent, with a scale that ends in a point.
      "Shape { geometry Extrusion { spine [ 0 0 0, 0 1 0, 1 2 0 ] scale [ 1 1, 1 1, 0 0 ] } }\n"
      // An L, whose caps are concave, along z.
      "Shape { geometry Extrusion { crossSection [ 0 0, 0 2, 1 2, 1 1, 2 1, 2 0, 0 0 ] spine [ 0 0 0, 0 0 5 "
      "] } }\n"
      // A ring of square section: the middle of the section goes round at radius 3.
      "Shape { geometry Extrusion { crossSection [ 1 1, 1 -1, -1 -1, -1 1, 1 1 ]\n"
      "  spine [ 3 0 0, 0 0 -3, -3 0 0, 0 0 3, 3 0 0 ] } }");
  for (const flat::Geometry* geometry : *answer->geometries()) {
    EXPECT_TRUE(is_closed(geometry));
    EXPECT_GT(volume(geometry), 0.0);
    EXPECT_EQ(geometry->texture_polygons()->size(), geometry->polygons()->size());
  }
  EXPECT_NEAR(volume(answer->geometries()->Get(0)), 4.0, 1e-6);
  EXPECT_EQ(answer->geometries()->Get(0)->positions()->size(), 3U * 8U);
  EXPECT_NEAR(volume(answer->geometries()->Get(2)), 3.0 * 5.0, 1e-5);
  EXPECT_EQ(answer->geometries()->Get(3)->positions()->size(), 3U * 16U);
}

TEST(VrmlWorker, ElevationGridsRiseAlongY) {
  const SeenAnswer answer = ask_about(
      "Shape { geometry ElevationGrid { xDimension 3 zDimension 5 xSpacing 2 zSpacing 0.1 height [ 0 1 2 3 4 "
      "5 6 ]\n"
      "  colorPerVertex FALSE color Color { color [ 1 0 0, 0 1 0 ] } } }");
  EXPECT_NE(answer.notes().find("fewer heights than it says"), std::string::npos);
  const flat::Geometry* geometry = answer->geometries()->Get(0);
  EXPECT_EQ(vector_of(geometry->polygons()), (std::vector<int>{0, 3, 4, 1, -1, 1, 4, 5, 2, -1}));
  EXPECT_EQ(vector_of(geometry->positions()),
            (std::vector<float>{0, 0, 0, 2, 1, 0, 4, 2, 0, 0, 3, 0.1F, 2, 4, 0.1F, 4, 5, 0.1F}));
  EXPECT_EQ(geometry->colours()->size(), 6U);
}

TEST(VrmlWorker, TextBecomesFlatTriangles) {
  const SeenAnswer answer = ask_about("Shape { geometry Text { string [ \"Ab\" \"\xc3\xa9\" ] } }");
  EXPECT_NE(answer.notes().find("only the letters of ASCII"), std::string::npos);
  const flat::Geometry* geometry = answer->geometries()->Get(0);
  EXPECT_GT(geometry->polygons()->size(), 40U);
  for (flatbuffers::uoffset_t i = 2; i < geometry->positions()->size(); i += 3)
    EXPECT_EQ(geometry->positions()->Get(i), 0.0F);
}

TEST(VrmlWorker, OwnShapesAreKnownByTheirProtos) {
  const std::string csg =
      "PROTO IcomeCsg [ field SFString tree \"\" field SFNode coord NULL field MFInt32 coordIndex [] ]\n"
      "  { IndexedFaceSet { coord IS coord coordIndex IS coordIndex } }\n";
  const std::string long_tree(100'000, 'x');
  const SeenAnswer answer = clean(
      csg + "Shape { geometry DEF Part IcomeCsg { tree \"" + long_tree + "\" } }\n" +
      "Shape { geometry IcomeCsg { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0 ] } coordIndex [ 0 1 2 -1 "
      "] } }\n"
      "PROTO IcomeLoopSurface [ field MFVec3f controlPoint [] field MFInt32 controlIndex [] field MFInt32 "
      "crease []\n"
      "  field MFInt32 corner [] ] { IndexedFaceSet {} }\n"
      "Shape { geometry IcomeLoopSurface { controlPoint [ 0 0 0, 1 0 0, 1 1 0 ] controlIndex [ 0 1 2 -1 ]\n"
      "  crease [ 0 1 ] corner [ 2 ] } }\n"
      "PROTO IcomeImplicit [ field SFString formula \"\" field SFString box \"\" ] { IndexedFaceSet {} }\n"
      "Shape { geometry IcomeImplicit { formula \"x^2\" box \"-1 -1 -1 1 1 0.1\" } }\n"
      "PROTO IcomePrimitive [ field SFString shape \"\" field SFString axis \"z\" ] { IndexedFaceSet {} }\n"
      "Shape { geometry IcomePrimitive { shape \"torus 2 1\" axis \"y\" } }\n"
      "PROTO IcomeMaterial [ field SFString name \"\" field SFFloat stiffness -1 field SFFloat "
      "staticFriction 0\n"
      "  field SFColor diffuseColor 1 1 1 ] { Material { diffuseColor IS diffuseColor } }\n"
      "Shape { appearance Appearance { material IcomeMaterial { name \"Rubber\" stiffness 0.2 } } geometry "
      "Box {} }\n"
      "PROTO IcomeScene [ field SFString name \"\" field MFString objects [] ] { Group {} }\n"
      "IcomeScene { name \"Second\" objects [ \"A\" \"B\" ] }");
  const auto& geometries = *answer->geometries();
  EXPECT_EQ(geometries.Get(0)->kind(), flat::GeometryKind::Csg);
  EXPECT_EQ(geometries.Get(0)->text()->str(), long_tree);
  EXPECT_EQ(geometries.Get(0)->name()->str(), "Part");
  EXPECT_EQ(geometries.Get(1)->kind(), flat::GeometryKind::Faces);
  EXPECT_EQ(geometries.Get(2)->kind(), flat::GeometryKind::Loop);
  EXPECT_EQ(vector_of(geometries.Get(2)->creases()), (std::vector<int>{0, 1}));
  EXPECT_EQ(geometries.Get(3)->box()->Get(5), 0.1);
  EXPECT_TRUE(geometries.Get(4)->along_y());
  const flat::Appearance* rubber = answer->appearances()->Get(0);
  EXPECT_EQ(rubber->name()->str(), "Rubber");
  EXPECT_EQ(rubber->stiffness(), flatbuffers::Optional<double>(0.2));
  EXPECT_FALSE(rubber->damping().has_value());
  const flat::Node* scene = answer->nodes()->Get(answer->nodes()->size() - 1);
  EXPECT_EQ(scene->scene()->str(), "Second");
  EXPECT_EQ(scene->members()->Get(1)->text()->str(), "B");
}

TEST(VrmlWorker, WhatItDoesNotKnowIsLeftOutWithItsLine) {
  const SeenAnswer answer = ask_about(
      "Group { children [\n  Strange { children [ Group {} ] }\n  Shape { shading \"x\" geometry Box {} }\n"
      "  USE Nothing ] }\nROUTE A.b TO C.d\nShape { appearance Strange {} geometry Box {} }");
  ASSERT_EQ(answer.refusal(), "");
  EXPECT_EQ(answer->geometries()->size(), 2U);
  EXPECT_EQ(answer.notes(),
            ":4: The field 'shading' is left out: Shape has none of this name.\n"
            ":5: USE 'Nothing' is left out: no node before it has this name.\n");
}

TEST(VrmlWorker, KeepsWhatComesBeforeAMistake) {
  const SeenAnswer answer = ask_about("Shape { geometry Box {} }\nTransform { translation 1 x }");
  ASSERT_EQ(answer.refusal(), "");
  EXPECT_EQ(answer->nodes()->size(), 1U);
  EXPECT_NE(answer.notes().find(":3: What follows this could not be read."), std::string::npos)
      << answer.notes();
  EXPECT_NE(ask_about("\nTransform { translation 1 x }").refusal().find("cannot be read: line 3:"),
            std::string::npos);
}

}  // namespace
}  // namespace icome::files
