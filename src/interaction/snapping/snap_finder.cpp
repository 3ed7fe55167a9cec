#include "interaction/snapping/snap_finder.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "interaction/object_move.h"
#include "interaction/snapping/touches.h"

namespace icome::interaction {
namespace {

using world::CollisionIndex;
using world::ObjectId;
using world::World;

constexpr std::size_t kMostVertexHandles = 512;

bool usable(const SnapSettings& settings) { return std::isfinite(settings.radius) && settings.radius > 0.0; }

/// The objects and all below them that can be snapped to, in the order of ids.
std::vector<ObjectId> all_of(CollisionIndex& index, std::span<const ObjectId> roots) {
  std::vector<ObjectId> result;
  for (const ObjectId root : roots) {
    if (!root) continue;
    for (const auto& it : index.standing(root)) result.push_back(it.id);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The points that lie furthest in 26 directions.
std::vector<Vector3> outermost(const std::vector<Vector3>& points) {
  std::vector<std::size_t> found;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vector3 direction(x, y, z);
        if (direction.isZero(0.0)) continue;
        std::size_t furthest = 0;
        for (std::size_t i = 1; i < points.size(); ++i) {
          if (direction.dot(points[i]) > direction.dot(points[furthest])) furthest = i;
        }
        found.push_back(furthest);
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<Vector3> result;
  for (const std::size_t i : found) result.push_back(points[i]);
  return result;
}

void add_box_handles(const base::Bounds& box, std::vector<Vector3>& points) {
  if (box.isEmpty()) return;
  for (unsigned corner = 0; corner < 8; ++corner)
    points.push_back(box.corner(static_cast<base::Bounds::CornerType>(corner)));
  points.emplace_back(box.center());
}

}  // namespace

std::string_view name_of(SnapKind kind) {
  switch (kind) {
    case SnapKind::Vertex:
      return "a corner";
    case SnapKind::Middle:
      return "the middle of an edge";
    case SnapKind::Edge:
      return "an edge";
    case SnapKind::Face:
      return "a face";
    case SnapKind::Grid:
      break;
  }
  return "the grid";
}

std::optional<Snap> snap_to_grid(const Vector3& point, double spacing, double radius) {
  if (!(spacing > 0.0) || !std::isfinite(spacing)) return std::nullopt;
  Snap snap;
  snap.kind = SnapKind::Grid;
  snap.point = Vector3((point / spacing).array().round()) * spacing;
  snap.distance = (snap.point - point).norm();
  if (!(snap.distance <= radius)) return std::nullopt;
  return snap;
}

void SnapFinder::follow(const world::Changes& changes) {
  for (const world::GeometryId id : changes.geometries) shapes_.erase(id);
}

const SnapShape* SnapFinder::snaps_of(const World& world, ObjectId object) {
  const world::PhysicalObject* found = world.find(object);
  const world::GeometryObject* geometry = found ? world.find(found->geometry) : nullptr;
  if (!geometry) return nullptr;
  Kept& kept = shapes_[found->geometry];
  if (kept.shape != geometry->shape)
    kept = {geometry->shape, std::make_unique<const SnapShape>(geometry->shape, sharp_angle_)};
  return kept.snaps.get();
}

std::optional<Snap> SnapFinder::nearest(const World& world, CollisionIndex& index, const Vector3& point,
                                        const SnapSettings& settings, std::span<const ObjectId> left_out) {
  return best(world, index, point, settings, all_of(index, left_out));
}

std::optional<Snap> SnapFinder::best(const World& world, CollisionIndex& index, const Vector3& point,
                                     const SnapSettings& settings, const std::vector<ObjectId>& left_out) {
  if (!point.allFinite() || !usable(settings)) return std::nullopt;
  const Vector3 reach = Vector3::Constant(settings.radius);
  const std::vector<Standing> near = index.standing_in({Vector3(point - reach), Vector3(point + reach)});
  using Search = std::optional<SnapShape::Place> (SnapShape::*)(const Affine3&, const Vector3&, double) const;
  struct Kind {
    SnapKind kind;
    bool wanted;
    Search search;  // null: faces
  };
  const std::array<Kind, 4> kinds = {{{SnapKind::Vertex, settings.vertices, &SnapShape::corner},
                                      {SnapKind::Middle, settings.middles, &SnapShape::middle},
                                      {SnapKind::Edge, settings.edges, &SnapShape::edge},
                                      {SnapKind::Face, settings.faces, nullptr}}};
  for (const auto& [kind, wanted, search] : kinds) {
    if (!wanted) continue;
    std::optional<Snap> found;
    for (const Standing& it : near) {
      if (std::binary_search(left_out.begin(), left_out.end(), it.id)) continue;
      const SnapShape* shape = snaps_of(world, it.id);
      if (!shape) continue;
      const double left = found ? found->distance : settings.radius;
      const auto place = search ? (shape->*search)(it.world_from_object, point, left)
                                : shape->face(it.world_from_object, point, left, *it.shape);
      if (!place) continue;
      const double distance = (place->point - point).norm();
      if (found && distance >= found->distance) continue;
      found = Snap{kind, place->point, place->direction, place->from, place->to, it.id, distance};
    }
    if (found) return found;
  }
  if (!settings.grid) return std::nullopt;
  return snap_to_grid(point, settings.spacing, settings.radius);
}

std::vector<Vector3> SnapFinder::handles_of(const World& world, CollisionIndex& index,
                                            std::span<const ObjectId> objects, const SnapHandles& handles) {
  std::vector<Vector3> points;
  const std::vector<ObjectId> moved = topmost(world, objects);
  base::Bounds box;
  for (const ObjectId id : moved) {
    if (handles.origins) points.push_back(world_from_object(world, id).translation());
    box.extend(index.bounds(id));
  }
  if (handles.box) add_box_handles(box, points);
  if (!handles.vertices) return points;
  for (const ObjectId id : moved) {
    for (const Standing& it : index.standing(id)) {
      const SnapShape* shape = snaps_of(world, it.id);
      if (!shape) continue;
      const bool many = shape->corners().size() > kMostVertexHandles;
      for (const Vector3& corner : many ? outermost(shape->corners()) : shape->corners())
        points.push_back(it.world_from_object * corner);
    }
  }
  return points;
}

std::uint64_t SnapFinder::effort_to_make(const World& world, const Standing& standing) const {
  const world::GeometryId id = world.find(standing.id)->geometry;
  const world::GeometryPointer& shape = world.find(id)->shape;
  const auto found = shapes_.find(id);
  const bool is_made = found != shapes_.end() && found->second.shape == shape;
  return standing.shape->effort_to_make() + (is_made ? 0 : world::effort_to_look_into(*shape));
}

/// Is there effort enough to prepare all shapes in the box?
bool SnapFinder::may_look(const World& world, CollisionIndex& index, const base::Bounds& around,
                          world::Effort& effort) const {
  std::uint64_t units = 0;
  for (const Standing& it : index.standing_in(around)) units += effort_to_make(world, it);
  return effort.spend(units);
}

std::vector<ObjectSnap> SnapFinder::of_objects(const World& world, CollisionIndex& index,
                                               std::span<const ObjectId> objects, const Vector3& offset,
                                               const SnapSettings& settings, const SnapHandles& handles,
                                               world::Effort* effort) {
  constexpr std::uint64_t kAHandle = 50;
  std::vector<ObjectSnap> result;
  if (!settings.any() || !usable(settings)) return result;
  const std::vector<ObjectId> moved = all_of(index, objects);
  base::Bounds around;
  for (const ObjectId id : objects) around.extend(index.bounds(id).translated(offset));
  if (effort && !may_look(world, index, grown(around, settings.radius), *effort)) return result;
  for (const Vector3& it : handles_of(world, index, objects, handles)) {
    if (effort && !effort->spend(kAHandle)) return {};
    const Vector3 handle = it + offset;
    if (const auto snap = best(world, index, handle, settings, moved)) result.push_back({*snap, handle});
  }
  std::stable_sort(result.begin(), result.end(), [](const ObjectSnap& a, const ObjectSnap& b) {
    return std::pair(a.snap.kind, a.snap.distance) < std::pair(b.snap.kind, b.snap.distance);
  });
  return result;
}

}  // namespace icome::interaction
