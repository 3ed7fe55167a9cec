#pragma once
#include "world/motion.h"
#include "world/sample_world.h"

namespace icome::world {

inline geometry::TriangleMesh tetrahedron() {
  return {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

inline GeometryPointer textured_mesh() {
  auto shape = std::make_shared<MeshGeometry>(tetrahedron());
  shape->texture_coordinates.assign(4, {Vector2(0.0, 0.0), Vector2(1.0, -0.0), Vector2(0.25, 1.0)});
  shape->normals.assign(4, {Vector3::UnitX(), Vector3::UnitY(), -Vector3::UnitZ()});
  shape->colours.assign(4, {Colour{0.1F, 0.2F, 0.3F}, Colour{-0.0F, 1.0F, 0.5F}, Colour{}});
  return shape;
}

inline GeometryPointer sharp_loop() {
  return std::make_shared<LoopGeometry>(geometry::ControlMesh{tetrahedron(), {{0, 1}, {1, 2}}, {3, 0}});
}

/// A mesh that two leaves share, another one, colours, transforms and a node that the root is not above.
inline GeometryPointer csg() {
  using geometry::CsgOperator;
  geometry::CsgTree tree;
  const auto solid = std::make_shared<const geometry::MeshSolid>(tetrahedron());
  const auto other = std::make_shared<const geometry::MeshSolid>(tetrahedron());
  const auto one = tree.add_leaf(solid, at(1.0, 2.0, 3.0));
  const auto two = tree.add_leaf(solid, Affine3(Eigen::Scaling(-1.0, 2.0, 0.5)), {{0.1F, 0.2F, 0.3F, 1.0F}});
  const auto three = tree.add_leaf(geometry::Primitive(geometry::Box{Vector3(0.1, 0.2, 0.3)}));
  const auto four = tree.add_leaf(geometry::Primitive(geometry::Plane{}), at(0.0, 0.0, 0.1));
  const auto five = tree.add_leaf(other);
  const auto six = tree.add(CsgOperator::Difference, one, three, at(0.0, -0.0, 5.0));
  const auto seven = tree.add(CsgOperator::Intersection, six, four);
  const auto eight = tree.add(CsgOperator::Union, two, seven);
  tree.add(CsgOperator::Union, five, eight);
  tree.set_root(eight);
  return std::make_shared<CsgGeometry>(std::move(tree));
}

inline std::vector<GeometryPointer> every_shape() {
  using namespace geometry;
  std::vector<GeometryPointer> shapes{one_triangle(),
                                      textured_mesh(),
                                      sharp_loop(),
                                      csg(),
                                      std::make_shared<MeshGeometry>(TriangleMesh{}),
                                      std::make_shared<CsgGeometry>(CsgTree{})};
  for (const Primitive& it :
       {Primitive(Plane{}), Primitive(Box{Vector3(0.1, 1.0 / 3.0, 2e-9)}), Primitive(Sphere{0.7}),
        Primitive(Cylinder{0.1, 0.2}), Primitive(Cone{0.0, 0.1, 0.2}), Primitive(Cone{0.1, 0.0, 0.2}),
        Primitive(Torus{0.3, 0.1}), Primitive(Capsule{0.1, 0.5})})
    shapes.push_back(std::make_shared<PrimitiveGeometry>(it));
  shapes.push_back(std::make_shared<PrimitiveGeometry>(Cone{0.1, 0.0, 0.2}, Axis::Y));
  shapes.push_back(*ImplicitGeometry::create("x^2 + y^2 + z^2 - 0.05^2",
                                             Bounds(Vector3::Constant(-0.1), Vector3::Constant(0.1))));
  return shapes;
}

inline Material rich_material(TextureId texture) {
  return {.name = "w\xc3\xb6od",
          .ambient = -0.0F,
          .diffuse = {0.1F, 0.2F, 0.3F},
          .specular = {0.4F, 0.5F, 0.6F},
          .emission = {0.7F, 0.8F, 0.9F},
          .shininess = 0.25F,
          .transparency = 0.5F,
          .texture = texture,
          .touch = {.stiffness = 900.0,
                    .damping = 0.0,
                    .static_friction = 0.5,
                    .dynamic_friction = 0.25,
                    .texture = "grain"}};
}

/// What glTF says of a material beyond VRML 2.0.
inline Material beyond_vrml() {
  return {.name = "paint",
          .picture_frame = {2.0, 0.1, -0.5, 0.2, 3.0, 0.25},
          .tints = true,
          .alpha_mode = AlphaMode::Mask,
          .alpha_cutoff = 0.7F,
          .unlit = true,
          .double_sided = false,
          .metallic = 0.0F,
          .roughness = 0.3F};
}

inline FixturePointer spot_light() {
  return std::make_shared<const Fixture>(Light{.kind = Light::Kind::Spot,
                                               .on = false,
                                               .colour = {0.1F, 0.2F, 0.3F},
                                               .intensity = 0.4F,
                                               .ambient = 0.5F,
                                               .attenuation = {0.6F, 0.7F, 0.8F},
                                               .radius = 9.0,
                                               .cut_off_angle = 0.6,
                                               .beam_width = 0.5});
}

/// Key frames of every kind.
inline MotionPointer spinning() {
  return std::make_shared<const Motion>(Motion{
      .rest = {.translation = {1.0, -0.0, 3.0}, .scale = {2.0, 1.0, -1.0}, .centre = {0.0, 0.5, 0.0}},
      .translation = {.interpolation = Interpolation::CubicSpline,
                      .times = {0.25},
                      .values = {0, 0, 0, 1, 2, 3, -0.0, 0, 0},
                      .cycle = 0.5},
      .rotation = {.times = {0.0, 1.0 / 3.0}, .values = {0, 0, 0, 1, 1, 0, 0, 0}, .loops = false},
      .scale = {.interpolation = Interpolation::Step, .times = {0.0}, .values = {1, 1, 1}, .cycle = 7.0}});
}

/// Edits of all kinds that an empty world allows one after the other.
inline std::vector<Edit> every_edit() {
  const TextureId picture{1}, sketch{2};
  const MaterialId wood{3}, paint{4};
  const SceneId room{5}, garden{6};
  const ObjectId table{7}, leg{8};
  const Affine3 turned = at(0.1, -0.0, 3.0) * Eigen::AngleAxisd(0.3, Vector3::UnitX());
  std::vector<Edit> edits{
      CreateTexture{picture,
                    {"wood.png",
                     "image/png",
                     std::make_shared<std::string>(std::string("\x89PNG\0\n", 6)),
                     {true, false}}},
      CreateTexture{sketch, {"", "", std::make_shared<std::string>()}},
      DeleteTexture{sketch},
      CreateMaterial{wood, rich_material(picture)},
      CreateMaterial{paint, {}},
      ChangeMaterial{paint, beyond_vrml()},
      ChangeMaterial{paint, {.name = "paint", .touch = {.damping = 2.0, .dynamic_friction = -0.0}}},
      CreateScene{room, "room"},
      CreateScene{garden, ""},
      DeleteScene{garden},
      RenameScene{room, std::string(300, 'r')}};
  std::uint64_t id = 100;
  for (const GeometryPointer& shape : every_shape()) edits.push_back(CreateGeometry{{++id}, shape});
  edits.push_back(CopyGeometry{{++id}, {101}});
  edits.push_back(CreateGeometry{{++id}, made_mesh()});
  const std::vector<Edit> rest{
      CreateObject{
          table, 0, {.name = "table", .parent_from_object = turned, .geometry = {101}, .material = wood}},
      CreateObject{
          leg, 0, {.parent = table, .geometry = {102}, .fixture = spot_light(), .motion = spinning()}},
      MoveObject{leg, {}, 1, turned},
      PlaceObject{leg, turned},
      RenameObject{leg, "leg"},
      ChooseGeometry{leg, {103}},
      ChooseGeometry{leg, {}},
      ChooseMaterial{leg, paint},
      ChooseMaterial{leg, {}},
      ChangeFixture{leg, std::make_shared<const Fixture>(Light{.scoped = true})},
      ChangeFixture{leg, std::make_shared<const Fixture>(Viewpoint{1.0})},
      ChangeFixture{leg, std::make_shared<const Fixture>(Inert{"Script", "Script { url \"a\" }"})},
      ChangeFixture{leg, std::make_shared<const Fixture>(ForceEffect{"viscous:2", false})},
      ChangeFixture{leg, nullptr},
      ChangeMotion{leg, nullptr},
      ChangeMotion{table, spinning()},
      DeleteMaterial{paint},
      ReplaceGeometry{{102}, csg()},
      DeleteGeometry{{103}},
      MoveVertices{{101}, {2, 0}, {{0.0, 2.0, 0.0}, {0.0, -0.0, 1.0}}},
      EnterScene{room, leg, 0},
      EnterScene{room, table, 1},
      LeaveScene{room, leg},
      ReserveIds{3, 77},
      EditGroup{},
      EditGroup{{RenameObject{leg, "one"}, EditGroup{{EditGroup{}, EditGroup{{PlaceObject{leg, turned}}}}}}},
      DeleteObject{leg}};
  edits.insert(edits.end(), rest.begin(), rest.end());
  return edits;
}

}  // namespace icome::world
