#include "interaction/shaping/lattice_cage.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <unordered_set>

#include "geometry/mesh/mesh_check.h"
#include "interaction/object_move.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::Bounds;
using base::fail;
using base::Result;
using geometry::FfdLattice;
using geometry::TriangleMesh;

/// A shape to be deformed, and its place.
struct CagedShape {
  world::ObjectId object;
  world::GeometryId geometry;
  world::GeometryPointer shape;
  Affine3 world_from_shape;

  const TriangleMesh& mesh() const { return *draggable_mesh(*shape); }
};

Result<CagedShape> caged_shape(const world::World& world, world::ObjectId id) {
  auto shape = draggable_shape(world, id);
  if (!shape) return tl::unexpected(shape.error());
  const world::PhysicalObject& object = *world.find(id);
  const CagedShape it{id, object.geometry, std::move(*shape), world_from_object(world, id)};
  if (const auto good = geometry::check_mesh(it.mesh()); !good) return tl::unexpected(good.error());
  if (!it.world_from_shape.linear().inverse().allFinite())
    return fail(fmt::format("'{}' is squashed flat: give it a size along all axes first.", object.name));
  return it;
}

/// The shapes of the objects and of all below them, each once.
Result<std::vector<CagedShape>> all_caged(const world::World& world,
                                          std::span<const world::ObjectId> objects) {
  std::vector<CagedShape> all;
  std::unordered_set<world::GeometryId> taken;
  for (const world::ObjectId root : topmost(world, objects)) {
    for (const world::ObjectId id : world::subtree(world, root)) {
      const world::GeometryId geometry = world.find(id)->geometry;
      if (!geometry || !taken.insert(geometry).second) continue;
      auto it = caged_shape(world, id);
      if (!it) return tl::unexpected(it.error());
      all.push_back(std::move(*it));
    }
  }
  if (all.empty()) return fail("A lattice goes round what is selected: select a mesh or a Loop surface.");
  return all;
}

/// The box round them, in the frame of the only one or in the world's.
Result<Affine3> cage_box(const std::vector<CagedShape>& all) {
  const bool alone = all.size() == 1;
  Bounds around;
  for (const CagedShape& it : all) {
    for (const Vector3& position : it.mesh().positions)
      around.extend(alone ? position : it.world_from_shape * position);
  }
  const auto box = geometry::ffd_box(around);
  if (!box) return fail("What is to be deformed has no size: select something bigger.");
  Affine3 world_from_box = alone ? all.front().world_from_shape : Affine3::Identity();
  world_from_box.translate(box->min());
  world_from_box.scale(box->sizes());
  return world_from_box;
}

geometry::FfdBinding cage_binding(const CagedShape& it, const FfdLattice& lattice) {
  std::vector<Vector3> places;
  places.reserve(it.mesh().positions.size());
  for (const Vector3& position : it.mesh().positions) places.push_back(it.world_from_shape * position);
  return geometry::FfdBinding(places, lattice);
}

std::string deform_name(const world::World& world, std::span<const world::ObjectId> objects) {
  const std::vector<world::ObjectId> all = topmost(world, objects);
  if (all.size() != 1) return fmt::format("Deform {} objects", all.size());
  const std::string& name = world.find(all.front())->name;
  return name.empty() ? "Deform object" : fmt::format("Deform {}", name);
}

std::array<int, 3> lattice_place(const FfdLattice& lattice, std::size_t point) {
  const auto counts = lattice.counts();
  const int at = int(point);
  return {at / (counts[1] * counts[2]), at / counts[2] % counts[1], at % counts[2]};
}

}  // namespace

Result<LatticeCage> LatticeCage::create(const world::World& world, std::span<const world::ObjectId> objects,
                                        const std::array<int, 3>& cells) {
  const auto all = all_caged(world, objects);
  if (!all) return tl::unexpected(all.error());
  const auto box = cage_box(*all);
  if (!box) return tl::unexpected(box.error());
  auto lattice = geometry::make_ffd_lattice(*box, cells);
  if (!lattice) return tl::unexpected(lattice.error());
  std::vector<Part> parts;
  for (const CagedShape& it : *all) {
    parts.push_back({it.object, it.geometry, it.shape, it.world_from_shape,
                     it.world_from_shape.linear().inverse(), cage_binding(it, *lattice)});
  }
  return LatticeCage(std::move(*lattice), std::move(parts), deform_name(world, objects));
}

std::optional<std::size_t> LatticeCage::find(const PartProbe& probe) const {
  if (!probe.is_usable()) return std::nullopt;
  std::optional<std::size_t> found;
  PartMeeting best;
  for (std::size_t i = 0; i < lattice_.points.size(); ++i) {
    const auto met = meet(probe, lattice_.points[i]);
    if (!met || (found && !(*met < best))) continue;
    found = i;
    best = *met;
  }
  return found;
}

PointDrag LatticeCage::drag(std::size_t point) const {
  std::vector<PointDrag::Followers> followers;
  for (const Part& part : parts_) {
    PointDrag::Followers it{.geometry = part.geometry, .before = part.shape};
    it.shape_from_world = part.shape_from_world;
    const TriangleMesh& mesh = *draggable_mesh(*part.shape);
    const std::vector<double> shares = part.binding.shares(lattice_place(lattice_, point));
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (!(shares[i] > 0.0)) continue;
      const std::uint32_t vertex = part.binding.vertices()[i];
      it.vertices.push_back(vertex);
      it.starts.push_back(mesh.positions[vertex]);
      it.weights.push_back(shares[i]);
    }
    if (!it.vertices.empty()) followers.push_back(std::move(it));
  }
  return PointDrag(std::move(followers), name_);
}

void LatticeCage::accept(const world::World& world) {
  for (Part& part : parts_) {
    if (const world::GeometryObject* geometry = world.find(part.geometry)) part.shape = geometry->shape;
  }
}

bool LatticeCage::is_current(const world::World& world) const {
  return std::ranges::all_of(parts_, [&](const Part& part) {
    const world::PhysicalObject* object = world.find(part.object);
    if (!object || object->geometry != part.geometry) return false;
    return world.find(part.geometry)->shape == part.shape &&
           world_from_object(world, part.object).matrix() == part.world_from_shape.matrix();
  });
}

std::vector<Vector3> LatticeCage::lines() const {
  const Vector3 parting = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  const auto counts = lattice_.counts();
  std::vector<Vector3> points;
  for (int axis = 0; axis < 3; ++axis) {
    const int one = (axis + 1) % 3, other = (axis + 2) % 3;
    for (int i = 0; i < counts[one]; ++i) {
      for (int j = 0; j < counts[other]; ++j) {
        for (int along = 0; along < counts[axis]; ++along) {
          std::array<int, 3> place{};
          place[std::size_t(axis)] = along;
          place[std::size_t(one)] = i;
          place[std::size_t(other)] = j;
          points.push_back(lattice_.points[lattice_.index(place)]);
        }
        points.push_back(parting);
      }
    }
  }
  return points;
}

}  // namespace icome::interaction
