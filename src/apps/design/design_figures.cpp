#include "apps/design/design_figures.h"

#include <fmt/format.h>

#include <algorithm>

#include "world/motion.h"

namespace icome::apps {
namespace {

using world::ObjectId;
using world::PhysicalObject;
using world::World;

/// The box around a shape where it stands. Meshes are measured by their vertices: the box around a turned
/// box would be too large.
base::Bounds bounds_at(const world::MeshGeometry& mesh, const base::Affine3& world_from_object) {
  base::Bounds box;
  for (const auto& triangle : mesh.mesh.triangles) {
    for (const std::uint32_t corner : triangle) box.extend(world_from_object * mesh.mesh.positions[corner]);
  }
  return box;
}

void count_fixture(const PhysicalObject& object, DesignFigures& figures) {
  if (!object.fixture) return;
  figures.lights += std::holds_alternative<world::Light>(*object.fixture) ? 1 : 0;
  figures.viewpoints += std::holds_alternative<world::Viewpoint>(*object.fixture) ? 1 : 0;
  figures.scripts += std::holds_alternative<world::Inert>(*object.fixture) ? 1 : 0;
}

void count_tables(const World& world, DesignFigures& figures) {
  figures.objects = world.objects().size();
  figures.materials = world.materials().size();
  figures.textures = world.textures().size();
  figures.scenes = world.scenes().size();
  for (const auto& [id, geometry] : world.geometries()) {
    figures.clones += geometry.users > 1 ? geometry.users - 1 : 0;
    figures.bytes += geometry.shape->bytes();
    ++figures.kinds[std::string(geometry.shape->kind())];
  }
  for (const auto& [id, texture] : world.textures()) figures.bytes += texture.bytes->size();
  for (const ObjectId id : world::moving_objects(world)) {
    const PhysicalObject& object = *world.find(id);
    figures.motions.push_back({object.name, world::key_count(*object.motion), world::duration(*object.motion),
                               world::loops(*object.motion)});
  }
}

/// Walks down the tree, measuring the shapes that are shown.
class Measuring {
 public:
  Measuring(const World& world, DesignFigures& figures, files::ShownShapes::Maker maker)
      : world_(world), figures_(figures), shapes_(world, maker) {}

  base::Result<void> run(const std::function<bool(std::size_t, std::size_t)>& go_on) {
    std::size_t done = 0;
    for (const ObjectId root : world_.roots()) open_.push_back({root, base::Affine3::Identity(), 1});
    while (!open_.empty()) {
      if (!go_on(done++, world_.objects().size())) return base::fail("interrupted");
      const Visit visit = open_.back();
      open_.pop_back();
      const PhysicalObject& object = *world_.find(visit.id);
      const base::Affine3 here = visit.world_from_parent * object.parent_from_object;
      figures_.depth = std::max(figures_.depth, visit.depth);
      for (const ObjectId child : object.children) open_.push_back({child, here, visit.depth + 1});
      count_fixture(object, figures_);
      if (object.geometry) measure(object.geometry, here);
    }
    return {};
  }

 private:
  struct Visit {
    ObjectId id;
    base::Affine3 world_from_parent;
    std::size_t depth;
  };

  void measure(world::GeometryId id, const base::Affine3& here) {
    const auto mesh = shapes_.triangles(id);
    if (!mesh) return;
    figures_.shown[id] = mesh->mesh.triangles.size();
    figures_.triangles += mesh->mesh.triangles.size();
    const world::Geometry& shape = *world_.find(id)->shape;
    const bool exact_box = shape.kind() != "mesh" && here.linear().isDiagonal();
    figures_.bounds.extend(exact_box ? shape.bounds().transformed(here) : bounds_at(*mesh, here));
  }

  const World& world_;
  DesignFigures& figures_;
  files::ShownShapes shapes_;
  std::vector<Visit> open_;
};

}  // namespace

base::Result<DesignFigures> figures_of(const files::LoadedDesign& design, const std::string& file,
                                       files::ShownShapes::Maker maker,
                                       const std::function<bool(std::size_t, std::size_t)>& go_on) {
  DesignFigures figures;
  figures.file = file;
  figures.format = design.format;
  count_tables(design.world, figures);
  for (const files::Remark& remark : design.remarks) figures.warnings.push_back(sentence(remark, file));
  if (const auto measured = Measuring(design.world, figures, maker).run(go_on); !measured)
    return tl::unexpected(measured.error());
  return figures;
}

}  // namespace icome::apps
