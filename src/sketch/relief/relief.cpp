#include "sketch/relief/relief.h"

#include <fmt/format.h>

#include <map>

#include "drawing/shape/drawing_shape.h"
#include "world/edit/edit.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::sketch {
namespace {

/// Makes the objects of a design.
class ReliefMaker {
 public:
  explicit ReliefMaker(const ReliefSettings& settings) : settings_(settings) {}

  base::Result<world::World> make(const Drawing& drawing) {
    drawing::StrokeRidges known;
    auto ridges = drawing::ridges_of(drawing, settings_.heights, known);
    if (!ridges) return tl::unexpected(ridges.error());
    if (settings_.sheet > 0.0) add_sheet(drawing);
    auto ridge = ridges->begin();
    for (const Layer& layer : drawing.layers) {
      if (!layer.visible || layer.strokes.empty()) continue;
      const world::ObjectId group = add({.name = layer.name});
      for (std::size_t i = 0; i < layer.strokes.size(); ++i) add_ridge(*ridge++, group);
    }
    if (!error_.empty()) return base::fail(error_);
    if (areas_ == 0) return base::fail("nothing of this drawing can be seen, so there is nothing to touch");
    return std::move(world_);
  }

  base::Result<world::World> make_one(const Drawing& drawing, const std::string& name) {
    auto shape = drawing::DrawingShape::create(drawing, {settings_.heights, settings_.sheet});
    if (!shape) return tl::unexpected(shape.error());
    world::PhysicalObject object = {.name = name};
    object.geometry = add_shape(std::move(*shape));
    object.material = add_material(paper_material());
    add(std::move(object));
    if (!error_.empty()) return base::fail(error_);
    return std::move(world_);
  }

 private:
  template <typename EditKind>
  void put(EditKind edit) {
    if (!error_.empty()) return;
    if (const auto done = world::replay(world_, world::Edit(std::move(edit))); !done)
      error_ = done.error().message;
  }

  world::ObjectId add(world::PhysicalObject object) {
    const auto id = ids_.next<world::ObjectId>();
    std::size_t place = 0;
    if (object.parent) {
      place = children_[object.parent.value]++;
    } else {
      place = roots_++;
    }
    put(world::CreateObject{id, place, std::move(object)});
    return id;
  }

  world::GeometryId add_shape(world::GeometryPointer shape) {
    const auto id = ids_.next<world::GeometryId>();
    put(world::CreateGeometry{id, std::move(shape)});
    return id;
  }

  world::MaterialId add_material(world::Material material) {
    const auto id = ids_.next<world::MaterialId>();
    put(world::CreateMaterial{id, std::move(material)});
    return id;
  }

  world::TouchProperties touch() const {
    world::TouchProperties touch;
    if (settings_.paper.stiffness > 0.0) touch.stiffness = settings_.paper.stiffness;
    touch.static_friction = touch.dynamic_friction = settings_.paper.friction;
    touch.texture = settings_.paper.texture;
    return touch;
  }

  world::Material paper_material() const {
    world::Material material;
    material.name = std::string(settings_.paper.name);
    material.diffuse = {1.0F, 1.0F, 1.0F};
    material.touch = touch();
    return material;
  }

  void add_sheet(const Drawing& drawing) {
    const base::Vector3 half(0.5 * drawing.size.x(), 0.5 * drawing.size.y(), 0.5 * settings_.sheet);
    world::PhysicalObject sheet = {.name = "sheet"};
    sheet.parent_from_object = base::Affine3(Eigen::Translation3d(0.0, 0.0, -0.5 * settings_.sheet));
    sheet.geometry = add_shape(std::make_shared<world::PrimitiveGeometry>(geometry::Box{half}));
    sheet.material = add_material(paper_material());
    add(std::move(sheet));
  }

  void add_ridge(const drawing::Ridge& ridge, world::ObjectId group) {
    const Stroke& stroke = *ridge.stroke;
    if (stroke.fill) add_area(stroke, ridge.areas->fill, ridge.fill_height, *stroke.fill, "fill", group);
    add_area(stroke, ridge.areas->line, ridge.height, stroke.colour, "stroke", group);
  }

  void add_area(const Stroke& stroke, geometry::TriangleMesh mesh, double height, const Colour& colour,
                const char* what, world::ObjectId group) {
    if (mesh.triangles.empty()) return;
    for (base::Vector3& at : mesh.positions) at.z() *= height;
    world::Material material;
    material.name = fmt::format("{} {}", what, stroke.id.value);
    material.diffuse = colour;
    material.transparency = float(1.0 - stroke.opacity);
    world::PhysicalObject area = {.name = material.name, .parent = group};
    area.geometry = add_shape(std::make_shared<world::MeshGeometry>(std::move(mesh)));
    area.material = add_material(std::move(material));
    add(std::move(area));
    ++areas_;
  }

  const ReliefSettings& settings_;
  world::World world_;
  world::IdSource ids_;
  std::map<std::uint64_t, std::size_t> children_;  // of each group
  std::size_t roots_ = 0;
  std::size_t areas_ = 0;
  std::string error_;
};

}  // namespace

base::Result<world::World> relief_of(const Drawing& drawing, const ReliefSettings& settings) {
  return ReliefMaker(settings).make(drawing);
}

base::Result<world::World> drawing_design_of(const Drawing& drawing, const ReliefSettings& settings,
                                             const std::string& name) {
  return ReliefMaker(settings).make_one(drawing, name);
}

}  // namespace icome::sketch
