#include "interaction/shaping/shaping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "interaction/object_move.h"
#include "world/shape/mesh_geometry.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::fail;
using base::Result;
using geometry::TriangleMesh;

constexpr std::size_t kMostFinders = 8;  // shapes that are kept ready
constexpr std::size_t kMostDots = 400;   // of one mesh, and round what is marked

void add_line(std::vector<Vector3>& lines, std::initializer_list<Vector3> points) {
  lines.insert(lines.end(), points);
  lines.push_back(Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
}

/// The mesh of an object whose vertices can be dragged; null: none.
const TriangleMesh* mesh_of_object(const world::World& world, world::ObjectId id) {
  const world::PhysicalObject* object = world.find(id);
  const world::GeometryObject* geometry = object ? world.find(object->geometry) : nullptr;
  return geometry ? draggable_mesh(*geometry->shape) : nullptr;
}

bool is_control_mesh(const world::World& world, world::ObjectId id) {
  return world.find(world.find(id)->geometry)->shape->kind() == "loop";
}

}  // namespace

bool same_handle(const ShapingHandle& one, const ShapingHandle& other) {
  if (one.point || other.point) return one.point == other.point;
  return one.object == other.object && one.part.vertices == other.part.vertices;
}

Result<void> Shaping::set(const ShapingSettings& settings) {
  if (!(settings.soft.radius >= 0.0) || !std::isfinite(settings.soft.radius))
    return fail("The radius within which others follow must be 0 (none does) or more.");
  for (const int cells : settings.cells) {
    if (cells < 1 || cells > ShapingSettings::kMostCells)
      return fail(fmt::format("A lattice has 1 to {} cells along each side, not {}.",
                              ShapingSettings::kMostCells, cells));
  }
  if (settings.cells != settings_.cells || settings.target != ShapingTarget::Lattice) cage_.reset();
  settings_ = settings;
  complaint_.clear();
  return {};
}

void Shaping::follow(const world::World& world, std::span<const world::ObjectId> selection) {
  if (settings_.target != ShapingTarget::Lattice) return;
  if (cage_ && std::ranges::equal(caged_, selection) && cage_->is_current(world)) return;
  caged_.assign(selection.begin(), selection.end());
  cage_.reset();
  complaint_.clear();
  auto made = LatticeCage::create(world, selection, settings_.cells);
  if (made) {
    cage_.emplace(std::move(*made));
  } else {
    complaint_ = made.error().message;
  }
}

const PartFinder* Shaping::finder_of(const world::World& world, world::ObjectId id) {
  const world::GeometryId geometry = world.find(id)->geometry;
  const world::GeometryPointer& shape = world.find(geometry)->shape;
  const auto found = finders_.find(geometry);
  if (found != finders_.end() && found->second.follow(shape)) return &found->second;
  if (finders_.size() >= kMostFinders) finders_.clear();
  auto made = PartFinder::create(shape);
  if (!made) return nullptr;
  return &finders_.insert_or_assign(geometry, std::move(*made)).first->second;
}

std::optional<ShapingHandle> Shaping::find(const world::World& world,
                                           std::span<const world::ObjectId> objects, const PartProbe& probe) {
  if (settings_.target == ShapingTarget::Lattice) {
    const auto point = cage_ ? cage_->find(probe) : std::nullopt;
    if (!point) return std::nullopt;
    return ShapingHandle{.place = cage_->lattice().points[*point], .point = point};
  }
  const auto kind = settings_.target == ShapingTarget::Vertex ? PartKind::Vertex
                    : settings_.target == ShapingTarget::Edge ? PartKind::Edge
                                                              : PartKind::Face;
  std::optional<ShapingHandle> best;
  for (const world::ObjectId id : objects) {
    const PartFinder* finder = mesh_of_object(world, id) ? finder_of(world, id) : nullptr;
    auto part = finder ? finder->find(kind, world_from_object(world, id), probe) : std::nullopt;
    if (!part || (best && !(part->meeting < best->part.meeting))) continue;
    best = ShapingHandle{.place = part->place, .object = id, .part = std::move(*part)};
  }
  return best;
}

Result<PointDrag> Shaping::take(const world::World& world, const ShapingHandle& handle) const {
  if (!handle.point) return drag_part(world, handle.object, handle.part, settings_.soft);
  if (!cage_ || *handle.point >= cage_->lattice().points.size())
    return fail("The lattice is gone: select again what is to be deformed.");
  PointDrag drag = cage_->drag(*handle.point);
  if (drag.followers().empty())
    return fail(
        "No vertex goes along with this point of the lattice: take another one, or ask for fewer cells.");
  return drag;
}

void Shaping::moved(const world::World& world, const ShapingHandle& handle, const Vector3& offset) {
  if (!handle.point || !cage_) return;
  cage_->put(*handle.point, handle.place + offset);
  cage_->accept(world);
}

ShapingPicture Shaping::picture(const world::World& world, std::span<const world::ObjectId> objects,
                                std::span<const MarkedHandle> marked) const {
  ShapingPicture picture;
  if (settings_.target == ShapingTarget::Lattice) {
    if (!cage_) return picture;
    picture.dots = cage_->lattice().points;
    picture.lines = cage_->lines();
    for (const MarkedHandle& it : marked) {
      if (it.handle.point && *it.handle.point < picture.dots.size())
        picture.marked_dots.push_back(picture.dots[*it.handle.point]);
    }
    return picture;
  }
  std::vector<world::ObjectId> shown(objects.begin(), objects.end());
  for (const MarkedHandle& it : marked) shown.push_back(it.handle.object);
  std::ranges::sort(shown);
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  for (const world::ObjectId id : shown) show_mesh(world, id, picture);
  for (const MarkedHandle& it : marked) show_marked(world, it, picture);
  return picture;
}

/// Shows all vertices of a mesh that has few, and the edges of a control mesh, which are not seen otherwise.
void Shaping::show_mesh(const world::World& world, world::ObjectId id, ShapingPicture& picture) const {
  const TriangleMesh* mesh = mesh_of_object(world, id);
  if (!mesh || mesh->positions.size() > kMostDots) return;
  const Affine3 world_from_shape = world_from_object(world, id);
  std::vector<Vector3> places;
  for (const Vector3& position : mesh->positions) places.push_back(world_from_shape * position);
  picture.dots.insert(picture.dots.end(), places.begin(), places.end());
  if (!is_control_mesh(world, id)) return;
  for (const auto& [a, b, c] : mesh->triangles) {
    if (std::max({a, b, c}) < places.size())
      add_line(picture.lines, {places[a], places[b], places[c], places[a]});
  }
}

void Shaping::show_marked(const world::World& world, const MarkedHandle& marked,
                          ShapingPicture& picture) const {
  const ShapingHandle& handle = marked.handle;
  const TriangleMesh* mesh = handle.point ? nullptr : mesh_of_object(world, handle.object);
  if (!mesh) return;
  const Affine3 world_from_shape = world_from_object(world, handle.object);
  std::vector<Vector3> places;
  for (const std::uint32_t vertex : handle.part.vertices) {
    if (vertex < mesh->positions.size()) places.push_back(world_from_shape * mesh->positions[vertex]);
  }
  picture.marked_dots.insert(picture.marked_dots.end(), places.begin(), places.end());
  if (places.size() == 2) add_line(picture.marked_lines, {places[0], places[1]});
  if (places.size() == 3) add_line(picture.marked_lines, {places[0], places[1], places[2], places[0]});
  if (mesh->positions.size() > kMostDots) show_around(world, marked, picture);
}

/// Shows the vertices that follow, of a mesh that is too large to be shown whole.
void Shaping::show_around(const world::World& world, const MarkedHandle& marked,
                          ShapingPicture& picture) const {
  const ShapingHandle& handle = marked.handle;
  const TriangleMesh& mesh = *mesh_of_object(world, handle.object);
  const Affine3 world_from_shape = world_from_object(world, handle.object);
  const auto show = [&](std::uint32_t vertex) {
    if (vertex < mesh.positions.size()) picture.dots.push_back(world_from_shape * mesh.positions[vertex]);
  };
  if (marked.drag) {
    for (const PointDrag::Followers& it : marked.drag->followers()) {
      const std::size_t step = 1 + it.vertices.size() / kMostDots;
      for (std::size_t i = 0; i < it.vertices.size(); i += step) show(it.vertices[i]);
    }
    return;
  }
  const auto found = finders_.find(world.find(handle.object)->geometry);
  if (found == finders_.end() || draggable_mesh(*found->second.shape()) != &mesh) return;
  for (const std::uint32_t vertex :
       found->second.vertices_near(world_from_shape, handle.place, settings_.soft.radius, kMostDots))
    show(vertex);
}

std::vector<world::ObjectId> draggable_objects(const world::World& world,
                                               std::span<const world::ObjectId> objects, std::size_t most) {
  std::vector<world::ObjectId> found;
  for (const world::ObjectId root : topmost(world, objects)) {
    for (const world::ObjectId id : world::subtree(world, root)) {
      if (found.size() >= most) return found;
      if (mesh_of_object(world, id)) found.push_back(id);
    }
  }
  return found;
}

}  // namespace icome::interaction
