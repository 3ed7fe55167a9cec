#include "files/vrml/read/vrml_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "files/vrml_answers.h"
#include "world/motion.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::files {
namespace {

using base::Vector3;
using world::Material;
using world::ObjectId;
using world::PhysicalObject;
using world::World;

const std::string kPngHead = "\x89PNG\r\n\x1a\nrest";

base::Result<LoadedDesign> try_build(const std::string& bytes, std::vector<VrmlScript> scripts = {}) {
  VrmlSources sources;
  sources.name = "test.wrl";
  sources.scripts = std::move(scripts);
  sources.find_mesh = [](const std::string&, const std::string& url) -> base::Result<FoundMesh> {
    return base::fail("there is no " + url);
  };
  sources.fetch_picture = [](const std::string& base, const std::string& url,
                             std::uint64_t limit) -> base::Result<std::string> {
    if (url == "passwd") return std::string("root:x:0:0");
    if (url == "a.jpg") return "\xff\xd8\xff" + base;
    if (url == "a.gif") return std::string("GIF89a");
    if (url.ends_with(".png") && kPngHead.size() <= limit) return kPngHead;
    return base::fail("there is no " + url);
  };
  io::TimeBudget time_budget;
  io::MemoryBudget memory;
  return build_vrml(bytes, sources, time_budget, memory);
}

LoadedDesign built_from(const Answer& answer) {
  auto design = try_build(bytes_of(answer));
  EXPECT_TRUE(design.has_value()) << (design ? "" : design.error().message);
  return design ? std::move(*design) : LoadedDesign{};
}

std::vector<std::string> texts_of(const LoadedDesign& design) {
  std::vector<std::string> result;
  for (const Remark& remark : design.remarks) result.push_back(remark.text);
  return result;
}
using RemarkTexts = std::vector<std::string>;

std::string build_failure(const Answer& answer) {
  const auto design = try_build(bytes_of(answer));
  return design ? "none" : design.error().message;
}

const PhysicalObject& root_of(const World& world, std::size_t place = 0) {
  return *world.find(world.roots().at(place));
}
const PhysicalObject& child_of(const World& world, const PhysicalObject& object, std::size_t place = 0) {
  return *world.find(object.children.at(place));
}
const world::Geometry& geometry_of(const World& world, const PhysicalObject& object) {
  return *world.find(object.geometry)->shape;
}
template <typename Kind>
const Kind& primitive_of(const World& world, const PhysicalObject& object) {
  return std::get<Kind>(dynamic_cast<const world::PrimitiveGeometry&>(geometry_of(world, object)).primitive);
}

AnswerGeometry box_piece(double x, double y, double z) {
  return {.kind = flat::GeometryKind::Box, .sizes = {x, y, z}};
}
AnswerGeometry triangle_piece() {
  return {.kind = flat::GeometryKind::Faces,
          .name = "triangle",
          .positions = {0, 0, 0, 1, 0, 0, 0, 1, 0},
          .polygons = {0, 1, 2, -1}};
}
const AnswerAppearance kRedLook = {.name = "red", .diffuse = {1, 0, 0}};

// ---- Hierarchy ----------------------------------------------------------------------------------------

TEST(VrmlBuilder, MergesTheOnlyShapeIntoItsParent) {
  // DEF leg Transform { translation 1 2 3 children [ Shape {} DEF foot Transform { children Shape {} } ] }
  const LoadedDesign design = built_from({.nodes = {{.name = "leg", .matrix = moved(1, 2, 3)},
                                                    {.parent = 0, .geometry = 0, .appearance = 0},
                                                    {.parent = 0, .name = "foot"},
                                                    {.parent = 2, .geometry = 1, .appearance = 0}},
                                          .geometries = {box_piece(1, 2, 3), box_piece(4, 5, 6)},
                                          .appearances = {kRedLook}});
  const World& world = design.world;
  EXPECT_EQ(world.objects().size(), 2U);
  ASSERT_EQ(world.roots().size(), 1U);
  const PhysicalObject& leg = root_of(world);
  EXPECT_EQ(leg.name, "leg");
  EXPECT_EQ(leg.parent_from_object.translation(), Vector3(1, 2, 3));
  EXPECT_EQ(primitive_of<geometry::Box>(world, leg).half, Vector3(0.5, 1, 1.5));
  EXPECT_EQ(world.find(leg.material)->name, "red");
  ASSERT_EQ(leg.children.size(), 1U);
  const PhysicalObject& foot = child_of(world, leg);
  EXPECT_EQ(foot.name, "foot");
  EXPECT_EQ(primitive_of<geometry::Box>(world, foot).half, Vector3(2, 2.5, 3));
  EXPECT_EQ(foot.material, leg.material);
  EXPECT_EQ(world.find(leg.material)->users, 2U);
  EXPECT_EQ(design.format, "VRML 2.0");
  EXPECT_EQ(texts_of(design), RemarkTexts{});
}

TEST(VrmlBuilder, KeepsShapesApartThatAreNotAlone) {
  const LoadedDesign design = built_from({.nodes = {{},
                                                    {.parent = 0, .geometry = 0, .appearance = 0},
                                                    {.parent = 0, .geometry = 0, .appearance = 0}},
                                          .geometries = {box_piece(1, 1, 1)},
                                          .appearances = {kRedLook}});
  EXPECT_EQ(design.world.objects().size(), 3U);
  EXPECT_FALSE(root_of(design.world).geometry);
  EXPECT_EQ(root_of(design.world).children.size(), 2U);
}

TEST(VrmlBuilder, KeepsShapesApartThatHaveANameAPlaceOrChildren) {
  const std::vector<std::vector<AnswerNode>> cases = {
      {{}, {.parent = 0, .name = "own", .geometry = 0, .appearance = 0}},
      {{}, {.parent = 0, .geometry = 0, .appearance = 0, .def = "own"}},
      {{}, {.parent = 0, .matrix = moved(1, 0, 0), .geometry = 0, .appearance = 0}},
      {{.geometry = 0, .appearance = 0}, {.parent = 0, .geometry = 0, .appearance = 0}},
  };
  for (const auto& nodes : cases) {
    const LoadedDesign design =
        built_from({.nodes = nodes, .geometries = {box_piece(1, 1, 1)}, .appearances = {kRedLook}});
    EXPECT_EQ(design.world.objects().size(), 2U);
    EXPECT_TRUE(child_of(design.world, root_of(design.world)).geometry);
  }
}

TEST(VrmlBuilder, MakesShapesWithoutParentObjects) {
  const LoadedDesign design =
      built_from({.nodes = {{.geometry = 0, .appearance = 0}, {.name = "b", .geometry = 0, .appearance = 0}},
                  .geometries = {box_piece(1, 1, 1)},
                  .appearances = {kRedLook}});
  EXPECT_EQ(design.world.roots().size(), 2U);
  EXPECT_EQ(root_of(design.world, 1).name, "b");
}

TEST(VrmlBuilder, SharesWhatIsUsedAgain) {
  const LoadedDesign design =
      built_from({.nodes = {{.name = "a"},
                            {.parent = 0, .geometry = 0, .appearance = 0},
                            {.name = "b", .reused = true},
                            {.parent = 2, .geometry = 0, .appearance = 0, .reused = true}},
                  .geometries = {triangle_piece()},
                  .appearances = {kRedLook}});
  const World& world = design.world;
  EXPECT_EQ(world.geometries().size(), 1U);
  EXPECT_EQ(world.materials().size(), 1U);
  EXPECT_EQ(root_of(world, 0).geometry, root_of(world, 1).geometry);
  EXPECT_EQ(world.find(root_of(world).geometry)->users, 2U);
}

TEST(VrmlBuilder, LeavesOutWhatNobodyUses) {
  const LoadedDesign design = built_from({.nodes = {{.name = "a"}},
                                          .geometries = {triangle_piece()},
                                          .appearances = {kRedLook},
                                          .pictures = {{.urls = {"a.png"}}}});
  EXPECT_TRUE(design.world.geometries().empty());
  EXPECT_TRUE(design.world.materials().empty());
  EXPECT_TRUE(design.world.textures().empty());
}

TEST(VrmlBuilder, LeavesFlattenedObjectsOutWithAllBelow) {
  for (const double bad : {0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const LoadedDesign design =
        built_from({.nodes = {{.name = "hidden", .matrix = {bad, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}},
                              {.parent = 0, .geometry = 0, .appearance = 0},
                              {.parent = 0, .name = "below"},
                              {.name = "seen"}},
                    .geometries = {box_piece(1, 1, 1)},
                    .appearances = {kRedLook}});
    EXPECT_EQ(design.world.objects().size(), 1U);
    EXPECT_EQ(root_of(design.world).name, "seen");
    EXPECT_EQ(
        texts_of(design),
        RemarkTexts{"Objects that their transforms flatten are left out: 3 objects, first \"hidden\"."});
  }
}

TEST(VrmlBuilder, LeavesOutShapesOfNothing) {
  const LoadedDesign design =
      built_from({.nodes = {{.name = "empty"}, {.parent = 0, .appearance = 0}}, .appearances = {kRedLook}});
  EXPECT_EQ(design.world.objects().size(), 1U);
}

// ---- Lamps and eyes -----------------------------------------------------------------------------------

Vector3 faced(const PhysicalObject& object) { return object.parent_from_object.linear() * -Vector3::UnitZ(); }

TEST(VrmlBuilder, MergesFixturesThatStandAsTheirParent) {
  const LoadedDesign design = built_from(
      {.nodes = {{.name = "lamp", .matrix = moved(1, 0, 0)},
                 {.parent = 0, .light = AnswerLight{.kind = flat::LightKind::Spot, .intensity = 0.5F}},
                 {.name = "eye"},
                 {.parent = 2, .viewpoint = AnswerViewpoint{.position = {0, 0, 0}, .field_of_view = 1.0}},
                 {.parent = 2, .viewpoint = AnswerViewpoint{.position = {0, 0, 0}}}}});
  const World& world = design.world;
  EXPECT_EQ(world.objects().size(), 3U);
  const auto& light = std::get<world::Light>(*root_of(world).fixture);
  EXPECT_EQ(light.kind, world::Light::Kind::Spot);
  EXPECT_EQ(light.intensity, 0.5F);
  EXPECT_EQ(root_of(world).parent_from_object.translation(), Vector3(1, 0, 0));
  EXPECT_EQ(std::get<world::Viewpoint>(*root_of(world, 1).fixture).field_of_view, 1.0);
  EXPECT_TRUE(child_of(world, root_of(world, 1)).fixture);
}

TEST(VrmlBuilder, PlacesOtherFixtures) {
  const LoadedDesign design = built_from(
      {.nodes = {
           {.name = "group"},
           {.parent = 0,
            .light =
                AnswerLight{.kind = flat::LightKind::Spot, .location = {1, 2, 3}, .direction = {0, -2, 0}}},
           {.parent = 0, .light = AnswerLight{.direction = {0, 0, 5}}},
           {.parent = 0,
            .light =
                AnswerLight{.kind = flat::LightKind::Point, .location = {4, 5, 6}, .direction = {1, 0, 0}}},
           {.parent = 0, .name = "front", .viewpoint = AnswerViewpoint{}},
           {.parent = 0,
            .viewpoint =
                AnswerViewpoint{.position = {0, 7, 0}, .axis = {2, 0, 0}, .angle = -std::numbers::pi / 2}}}});
  const World& world = design.world;
  const PhysicalObject& group = root_of(world);
  ASSERT_EQ(group.children.size(), 5U);
  EXPECT_FALSE(group.fixture);
  EXPECT_EQ(child_of(world, group, 0).parent_from_object.translation(), Vector3(1, 2, 3));
  EXPECT_LT((faced(child_of(world, group, 0)) - Vector3(0, -1, 0)).norm(), 1e-15);
  EXPECT_LT((faced(child_of(world, group, 1)) - Vector3(0, 0, 1)).norm(), 1e-15);
  EXPECT_EQ(child_of(world, group, 2).parent_from_object.translation(), Vector3(4, 5, 6));
  EXPECT_EQ(faced(child_of(world, group, 2)), Vector3(0, 0, -1));
  EXPECT_EQ(child_of(world, group, 3).name, "front");
  EXPECT_EQ(child_of(world, group, 3).parent_from_object.translation(), Vector3(0, 0, 10));
  EXPECT_LT((faced(child_of(world, group, 4)) - Vector3(0, -1, 0)).norm(), 1e-15);
  for (const ObjectId id : group.children)
    EXPECT_NEAR(world.find(id)->parent_from_object.linear().determinant(), 1.0, 1e-15);
}

TEST(VrmlBuilder, PutsFixtureNumbersRight) {
  const double nan = std::nan("");
  const LoadedDesign design = built_from(
      {.nodes = {{.light = AnswerLight{.kind = flat::LightKind::Spot,
                                       .location = {nan, 0, 0},
                                       .direction = {0, 0, 0},
                                       .intensity = 7.0F}},
                 {.viewpoint = AnswerViewpoint{
                      .position = {0, 0, 1}, .axis = {0, 0, 0}, .angle = nan, .field_of_view = -1.0}}}});
  EXPECT_EQ(std::get<world::Light>(*root_of(design.world).fixture).intensity, 1.0F);
  EXPECT_TRUE(root_of(design.world).parent_from_object.matrix().isIdentity(0.0));
  EXPECT_EQ(std::get<world::Viewpoint>(*root_of(design.world, 1).fixture).field_of_view, 0.785398);
}

// ---- Shapes -------------------------------------------------------------------------------------------

TEST(VrmlBuilder, MakesExactPrimitives) {
  using flat::GeometryKind;
  const LoadedDesign design =
      built_from({.nodes = {{.geometry = 0, .appearance = 0},
                            {.geometry = 1, .appearance = 0},
                            {.geometry = 2, .appearance = 0},
                            {.geometry = 3, .appearance = 0}},
                  .geometries = {{.kind = GeometryKind::Sphere, .sizes = {0.3}},
                                 {.kind = GeometryKind::Cylinder, .sizes = {1, 4}},
                                 {.kind = GeometryKind::Cone, .sizes = {2, 3}},
                                 {.kind = GeometryKind::Primitive, .text = "torus:0.3x0.1", .along_y = true}},
                  .appearances = {kRedLook}});
  const World& world = design.world;
  EXPECT_EQ(primitive_of<geometry::Sphere>(world, root_of(world, 0)).radius, 0.3);
  EXPECT_EQ(primitive_of<geometry::Cylinder>(world, root_of(world, 1)).height, 4.0);
  EXPECT_EQ(geometry_of(world, root_of(world, 1)).bounds().max(), Vector3(1, 2, 1));
  const auto& cone = primitive_of<geometry::Cone>(world, root_of(world, 2));
  EXPECT_EQ(cone.bottom_radius, 2.0);
  EXPECT_EQ(cone.top_radius, 0.0);
  EXPECT_EQ(geometry_of(world, root_of(world, 2)).bounds().max(), Vector3(2, 1.5, 2));
  EXPECT_NEAR(geometry_of(world, root_of(world, 3)).bounds().max().y(), 0.1, 1e-15);
}

TEST(VrmlBuilder, LeavesPrimitivesOutWithoutASize) {
  const LoadedDesign design = built_from(
      {.nodes = {{.name = "a", .geometry = 0, .appearance = 0},
                 {.name = "b", .geometry = 1, .appearance = 0}},
       .geometries = {box_piece(0, 1, 1), {.kind = flat::GeometryKind::Cone, .name = "cone", .sizes = {1}}},
       .appearances = {kRedLook}});
  EXPECT_EQ(design.world.objects().size(), 2U);
  EXPECT_TRUE(design.world.geometries().empty());
  EXPECT_EQ(
      texts_of(design),
      RemarkTexts{"Boxes, spheres, cylinders and cones must have sizes from 1e-9 to 1e6 m: shapes are left "
                  "out: 2 shapes, first one without a name."});
}

AnswerGeometry tetrahedron_piece(flat::GeometryKind kind) {
  return {.kind = kind,
          .name = "own",
          .positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
          .polygons = {0, 2, 1, -1, 0, 1, 3, -1, 1, 2, 3, -1, 2, 0, 3, -1}};
}

TEST(VrmlBuilder, MakesLoopSurfaces) {
  AnswerGeometry geometry = tetrahedron_piece(flat::GeometryKind::Loop);
  geometry.creases = {0, 1, 3, 9};
  geometry.corners = {2, -5};
  const LoadedDesign design = built_from(
      {.nodes = {{.geometry = 0, .appearance = 0}}, .geometries = {geometry}, .appearances = {kRedLook}});
  const auto& loop =
      dynamic_cast<const world::LoopGeometry&>(geometry_of(design.world, root_of(design.world)));
  EXPECT_EQ(loop.control.mesh.triangles.size(), 4U);
  EXPECT_EQ(loop.control.creases, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}}));
  EXPECT_EQ(loop.control.corners, std::vector<std::uint32_t>{2});
  EXPECT_EQ(texts_of(design),
            RemarkTexts{"Creases and corners at vertices that are not there are left out: 2 of \"own\"."});
}

TEST(VrmlBuilder, MakesImplicitSurfacesAndCsgTrees) {
  const LoadedDesign design = built_from(
      {.nodes = {{.geometry = 0, .appearance = 0}, {.geometry = 1, .appearance = 0}},
       .geometries = {{.kind = flat::GeometryKind::Implicit,
                       .text = "x^2+y^2+z^2-1",
                       .box = {-2, -2, -2, 2, 2, 2}},
                      {.kind = flat::GeometryKind::Csg, .text = "box:1x1x1\nsphere:0.6\ndifference 0 1\n"}},
       .appearances = {kRedLook}});
  EXPECT_EQ(geometry_of(design.world, root_of(design.world)).kind(), "implicit");
  EXPECT_EQ(geometry_of(design.world, root_of(design.world, 1)).kind(), "csg");
  EXPECT_EQ(texts_of(design), RemarkTexts{});
}

TEST(VrmlBuilder, TakesTrianglesOfOwnShapesThatCannotBeMade) {
  for (const auto kind :
       {flat::GeometryKind::Implicit, flat::GeometryKind::Csg, flat::GeometryKind::Primitive}) {
    AnswerGeometry geometry = tetrahedron_piece(kind);
    geometry.text = "nonsense (";
    geometry.box = {-1, -1, -1, 1, 1, 1};
    const LoadedDesign design = built_from(
        {.nodes = {{.geometry = 0, .appearance = 0}}, .geometries = {geometry}, .appearances = {kRedLook}});
    EXPECT_EQ(geometry_of(design.world, root_of(design.world)).kind(), "mesh");
    ASSERT_EQ(design.remarks.size(), 1U);
    EXPECT_TRUE(design.remarks[0].text.starts_with("The shape \"own\" becomes a mesh of triangles: "));
  }
  AnswerGeometry geometry = tetrahedron_piece(flat::GeometryKind::Loop);
  geometry.polygons = {0, 1, 2, -1, 0, 1, 3, -1, 1, 0, 2, -1};  // three triangles at an edge
  const LoadedDesign design = built_from(
      {.nodes = {{.geometry = 0, .appearance = 0}}, .geometries = {geometry}, .appearances = {kRedLook}});
  EXPECT_EQ(geometry_of(design.world, root_of(design.world)).kind(), "mesh");
}

// ---- Looks --------------------------------------------------------------------------------------------

TEST(VrmlBuilder, MakesMaterials) {
  const AnswerAppearance appearance = {.name = "rubber",
                                       .diffuse = {0.1F, 0.2F, 0.3F},
                                       .emission = {0, 0.5F, 0},
                                       .transparency = 0.25F,
                                       .stiffness = 300.0,
                                       .static_friction = 0.5,
                                       .dynamic_friction = 0.25};
  const LoadedDesign design = built_from({.nodes = {{.geometry = 0, .appearance = 0}},
                                          .geometries = {triangle_piece()},
                                          .appearances = {appearance}});
  const Material& material = *design.world.find(root_of(design.world).material);
  EXPECT_EQ(material.name, "rubber");
  EXPECT_EQ(material.diffuse, (world::Colour{0.1F, 0.2F, 0.3F}));
  EXPECT_EQ(material.emission, (world::Colour{0, 0.5F, 0}));
  EXPECT_EQ(material.ambient, 0.2F);
  EXPECT_EQ(material.transparency, 0.25F);
  EXPECT_EQ(material.touch.stiffness, 300.0);
  EXPECT_FALSE(material.touch.damping.has_value());
  EXPECT_EQ(material.touch.static_friction, 0.5);
  EXPECT_EQ(material.touch.dynamic_friction, 0.25);
}

TEST(VrmlBuilder, PutsMaterialsRight) {
  const AnswerAppearance appearance = {.name = "odd",
                                       .diffuse = {2, -1, std::nanf("")},
                                       .stiffness = -1.0,
                                       .static_friction = 0.1,
                                       .dynamic_friction = 0.2};
  const LoadedDesign design = built_from({.nodes = {{.geometry = 0, .appearance = 0}},
                                          .geometries = {triangle_piece()},
                                          .appearances = {appearance}});
  const Material& material = *design.world.find(root_of(design.world).material);
  EXPECT_EQ(material.diffuse, (world::Colour{1, 0, 0}));
  EXPECT_FALSE(material.touch.stiffness.has_value());
  EXPECT_EQ(material.touch.static_friction, 0.2);
  EXPECT_EQ(design.remarks.size(), 3U);
}

TEST(VrmlBuilder, LightsWhatIsUnlit) {
  const LoadedDesign design = built_from(
      {.nodes = {{.geometry = 0}, {.geometry = 0, .appearance = 0}, {.geometry = 0, .appearance = 1}},
       .geometries = {triangle_piece()},
       .appearances = {{.lit = false}, {.lit = false, .picture = 0}},
       .pictures = {{.urls = {"a.png"}}}});
  const World& world = design.world;
  EXPECT_FALSE(root_of(world, 0).material);
  EXPECT_FALSE(root_of(world, 1).material);
  const Material& textured = *world.find(root_of(world, 2).material);
  EXPECT_EQ(textured.diffuse, (world::Colour{1, 1, 1}));
  EXPECT_TRUE(textured.texture);
  EXPECT_EQ(texts_of(design),
            RemarkTexts{"Shapes without a Material are lit here: 3 shapes, first one without a name."});
}

// ---- Textures -----------------------------------------------------------------------------------------

Answer textured(std::vector<AnswerPicture> pictures) {
  Answer answer;
  answer.geometries = {triangle_piece()};
  answer.pictures = std::move(pictures);
  for (int i = 0; i < int(answer.pictures.size()); ++i) {
    answer.appearances.push_back({.name = "look", .picture = i});
    answer.nodes.push_back({.geometry = 0, .appearance = i});
  }
  return answer;
}

TEST(VrmlBuilder, TakesTheFirstPictureThatIsThere) {
  const LoadedDesign design = built_from(textured({{.urls = {"gone.png.txt", "passwd", "a.gif", "a.png"}}}));
  ASSERT_EQ(design.world.textures().size(), 1U);
  const world::Texture& texture = design.world.textures().begin()->second;
  EXPECT_EQ(texture.name, "a.gif");
  EXPECT_EQ(texture.media_type, "image/gif");
  EXPECT_EQ(*texture.bytes, "GIF89a");
  EXPECT_EQ(texts_of(design), RemarkTexts{});
}

TEST(VrmlBuilder, MakesOneTextureOfOneFile) {
  const LoadedDesign design = built_from(textured({{.urls = {"a.png"}},
                                                   {.urls = {"b.png"}},
                                                   {.urls = {"a.png"}, .repeat_s = false},
                                                   {.urls = {"a.jpg"}, .base = "x"},
                                                   {.urls = {"a.jpg"}, .base = "y"}}));
  const World& world = design.world;
  EXPECT_EQ(world.textures().size(), 4U);
  const auto texture = [&](std::size_t i) { return world.find(root_of(world, i).material)->texture; };
  EXPECT_EQ(texture(0), texture(1));
  EXPECT_NE(texture(0), texture(2));
  EXPECT_EQ(world.find(texture(0))->bytes, world.find(texture(2))->bytes);
  EXPECT_EQ(world.find(texture(2))->repeats, (std::array<bool, 2>{false, true}));
  EXPECT_NE(texture(3), texture(4));
}

TEST(VrmlBuilder, TakesNothingThatIsNoPicture) {
  const LoadedDesign design =
      built_from(textured({{.urls = {"passwd"}}, {.urls = {"gone"}}, {.urls = {""}}}));
  EXPECT_TRUE(design.world.textures().empty());
  EXPECT_EQ(texts_of(design),
            (RemarkTexts{"The picture \"passwd\" is left out: it is not a PNG, JPEG or GIF picture.",
                         "The picture \"gone\" is left out: there is no gone.",
                         "The picture one without a name is left out: there is no ."}));
}

TEST(VrmlBuilder, KeepsPicturesWithinTheLimit) {
  VrmlSources sources;
  sources.picture_limit = 20;
  sources.fetch_picture = [](const std::string&, const std::string& url, std::uint64_t limit) {
    return kPngHead.size() > limit ? base::Result<std::string>(base::fail("it is too large"))
                                   : base::Result<std::string>(kPngHead + url);
  };
  io::TimeBudget time_budget;
  io::MemoryBudget memory;
  const auto design =
      build_vrml(bytes_of(textured({{.urls = {"a"}}, {.urls = {"b"}}})), sources, time_budget, memory);
  ASSERT_TRUE(design.has_value());
  EXPECT_EQ(design->world.textures().size(), 1U);
  EXPECT_EQ(texts_of(*design), RemarkTexts{"The picture \"b\" is left out: it is too large."});
}

TEST(VrmlBuilder, MakesPngFilesOfPixels) {
  const LoadedDesign design =
      built_from(textured({{.width = 2, .height = 1, .channels = 3, .pixels = {1, 2, 3, 4, 5, 6}},
                           {.width = 2, .height = 2, .channels = 3, .pixels = {1}},
                           {}}));
  ASSERT_EQ(design.world.textures().size(), 1U);
  EXPECT_EQ(design.world.textures().begin()->second.media_type, "image/png");
  EXPECT_EQ(texts_of(design), RemarkTexts{"A PixelTexture is left out: pixels of it are missing."});
}

TEST(VrmlBuilder, LaysPicturesByTheMaterial) {
  Answer answer = textured({{.urls = {"a.png"}}, {.urls = {"a.png"}}, {.urls = {"a.png"}}});
  answer.appearances[1].texture_transform = {2, 0, 0.25, 0, 3, 0.5, 0, 0, 1};
  answer.appearances[2].texture_transform = {1, 0, 0, 0, 1, 0, 0, 0, 0};
  const LoadedDesign design = built_from(answer);
  const World& world = design.world;
  EXPECT_EQ(world.geometries().size(), 1U);
  const auto frame_of = [&](std::size_t root) {
    return world.find(root_of(world, root).material)->picture_frame;
  };
  EXPECT_EQ(frame_of(0), world::kPictureAsItLies);
  EXPECT_EQ(frame_of(1), (world::PictureFrame{2, 0, 0.25, 0, 3, 0.5}));
  EXPECT_EQ(frame_of(2), world::kPictureAsItLies);
  EXPECT_EQ(texts_of(design),
            RemarkTexts{"Texture transforms that make no sense are left out: one without a name."});
}

// ---- Scenes, scripts, notes ---------------------------------------------------------------------------

TEST(VrmlBuilder, MakesScenes) {
  const LoadedDesign design =
      built_from({.nodes = {{.name = "table", .reused = true},
                            {.name = "Table 1", .def = "table"},
                            {.name = "lamp"},
                            {.scene = "kitchen", .members = {"table", "lamp", "table", "gone"}},
                            {.scene = ""}}});
  const World& world = design.world;
  EXPECT_EQ(world.objects().size(), 3U);
  ASSERT_EQ(world.scenes().size(), 2U);
  for (const auto& [id, scene] : world.scenes()) {
    if (scene.name == "kitchen")
      EXPECT_EQ(scene.roots, (std::vector<ObjectId>{world.roots()[1], world.roots()[2]}));
    else
      EXPECT_TRUE(scene.roots.empty());
  }
  EXPECT_EQ(texts_of(design), RemarkTexts{"Scenes name objects that are not there: 1 of \"kitchen\"."});
}

TEST(VrmlBuilder, KeepsScripts) {
  const auto design = try_build(bytes_of({.nodes = {{.name = "a"}}}), {{"door", "DEF door Script {}", 3}});
  ASSERT_TRUE(design.has_value());
  const PhysicalObject& script = root_of(design->world, 1);
  EXPECT_EQ(script.name, "door");
  EXPECT_EQ(std::get<world::Inert>(*script.fixture), (world::Inert{"Script", "DEF door Script {}"}));
}

TEST(VrmlBuilder, PassesNotesOn) {
  const LoadedDesign design = built_from({.notes = {{"part.wrl", 7, "A Text is left out."}, {"", -3, "b"}}});
  EXPECT_EQ(design.remarks, (std::vector<Remark>{{"part.wrl", 7, "A Text is left out."}, {"", 0, "b"}}));
  Answer many;
  many.notes.resize(5000, {"", 1, std::string(5000, 'x')});
  const LoadedDesign other = built_from(many);
  EXPECT_EQ(other.remarks.size(), 1001U);
  EXPECT_EQ(other.remarks.front().text.size(), 1000U);
  EXPECT_EQ(other.remarks.back().text, "There are 4000 more remarks like the ones before.");
}

// ---- Answers that cannot be used -----------------------------------------------------------------------

TEST(VrmlBuilder, GivesMotionsThatAreUsedAgainToAll) {
  const LoadedDesign design = built_from(
      {.nodes = {{.name = "a", .motion = 0}, {.name = "b", .motion = 0}}, .motions = {AnswerMotion()}});
  ASSERT_EQ(design.world.roots().size(), 2U);
  const PhysicalObject &a = *design.world.find(design.world.roots()[0]),
                       &b = *design.world.find(design.world.roots()[1]);
  ASSERT_NE(a.motion, nullptr);
  EXPECT_EQ(a.motion, b.motion);
  EXPECT_EQ(a.motion->translation.values, AnswerMotion().values);
}

TEST(VrmlBuilder, RefusesMotionsThatNobodyCouldPlay) {
  const std::string why =
      "test.wrl: the process that reads VRML gave an answer that makes no sense: a motion cannot be played";
  const auto failure = [](const AnswerMotion& motion) {
    return build_failure({.nodes = {{.motion = 0}}, .motions = {motion}});
  };
  EXPECT_EQ(failure({}), "none");
  EXPECT_EQ(failure({.rest = {1, 2, 3}}), why);
  EXPECT_EQ(failure({.times = {1.0, 0.0}}), why);
  EXPECT_EQ(failure({.times = {0.0, std::nan("")}}), why);
  EXPECT_EQ(failure({.times = {0.0}}), why);
  EXPECT_EQ(failure({.cycle = -1.0}), why);
  EXPECT_EQ(
      build_failure({.nodes = {{.motion = 0}}}),
      "test.wrl: the process that reads VRML gave an answer that makes no sense: a node names what is not "
      "there");
}

TEST(VrmlBuilder, FailsWithTheError) {
  EXPECT_EQ(build_failure({.error = "line 3 makes no sense"}), "test.wrl: line 3 makes no sense");
}

TEST(VrmlBuilder, RefusesNonsense) {
  const std::string head = "test.wrl: the process that reads VRML gave an answer that makes no sense: ";
  EXPECT_EQ(build_failure({.nodes = {{.parent = 0}}}), head + "a node comes before its parent");
  EXPECT_EQ(build_failure({.nodes = {{.parent = -2}}}), head + "a node comes before its parent");
  EXPECT_EQ(build_failure({.nodes = {{.geometry = 0}}}), head + "a node names what is not there");
  EXPECT_EQ(build_failure({.nodes = {{.appearance = 3}}}), head + "a node names what is not there");
  EXPECT_EQ(build_failure({.nodes = {{.matrix = {1, 2, 3}}}}), head + "a node has half a matrix");
  EXPECT_EQ(build_failure({.nodes = {{.scene = "a"}, {.parent = 0}}}), head + "a node lies below a scene");
  EXPECT_EQ(build_failure({.appearances = {{.picture = 0}}}), head + "an appearance names what is not there");
  Answer deep;
  deep.nodes.resize(20'000);
  for (int i = 1; i < 20'000; ++i) deep.nodes[std::size_t(i)].parent = i - 1;
  EXPECT_EQ(build_failure(deep), head + "nodes lie too deep within each other");
}

TEST(VrmlBuilder, RefusesWhatIsNoAnswer) {
  for (const std::string& bytes : {std::string(), std::string("VRML"), std::string(100, '\xff')}) {
    const auto design = try_build(bytes);
    ASSERT_FALSE(design.has_value());
    EXPECT_EQ(design.error().message, "test.wrl: the process that reads VRML gave an answer that is damaged");
  }
}

TEST(VrmlBuilder, StopsWhenTold) {
  const std::string bytes = bytes_of({.nodes = {{}, {}}});
  VrmlSources sources;
  sources.name = "test.wrl";
  io::TimeBudget stopped(
      1e9, [](double) { return false; }, 0.5);
  io::MemoryBudget memory;
  EXPECT_EQ(build_vrml(bytes, sources, stopped, memory).error().message, "interrupted");
  io::TimeBudget over(-1.0, nullptr, 0.5);
  EXPECT_EQ(build_vrml(bytes, sources, over, memory).error().message,
            "test.wrl: making a design of it takes too long");
}

}  // namespace
}  // namespace icome::files
