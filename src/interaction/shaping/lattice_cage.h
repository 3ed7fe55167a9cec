#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/deform/free_form_deformation.h"
#include "interaction/shaping/point_drag.h"

namespace icome::interaction {

/// A lattice of control points round objects, which deform when its points are dragged (free-form
/// deformation, Sederberg and Parry; thesis 2.4.3): meshes by their vertices, Loop surfaces by those of their
/// control meshes. Round one object it is aligned with that object, round several with the world's axes. A
/// shape that several objects share deforms as the first of them is placed. Owns its numbers: some 100 bytes
/// a vertex.
class LatticeCage {
 public:
  /// A lattice at rest round the objects and all below them, with `cells` along its axes. Fails, saying what
  /// to do, where there is nothing to deform or something of another kind, and as make_ffd_lattice does.
  static base::Result<LatticeCage> create(const world::World& world, std::span<const world::ObjectId> objects,
                                          const std::array<int, 3>& cells);

  /// The lattice with its points where they are now; world frame.
  const geometry::FfdLattice& lattice() const { return lattice_; }
  /// The control point that the probe meets best.
  std::optional<std::size_t> find(const PartProbe& probe) const;
  /// Takes hold of a control point, which must be one of the lattice's.
  PointDrag drag(std::size_t point) const;
  /// Puts a point at `place` (m, world frame), as it is dragged.
  void put(std::size_t point, const Vector3& place) { lattice_.points[point] = place; }
  /// Takes the world as it is for the lattice as it is: to be called after each step of a drag.
  void accept(const world::World& world);
  /// Is the world what accept() saw last, as far as it concerns the deformed objects?
  bool is_current(const world::World& world) const;
  /// The lattice's lines, one after the other, separated by points that are not finite. World frame, m.
  std::vector<Vector3> lines() const;

 private:
  struct Part {
    world::ObjectId object;
    world::GeometryId geometry;
    world::GeometryPointer shape;  // as accepted
    base::Affine3 world_from_shape;
    base::Matrix3 shape_from_world;  // of directions
    geometry::FfdBinding binding;
  };
  LatticeCage(geometry::FfdLattice lattice, std::vector<Part> parts, std::string name)
      : lattice_(std::move(lattice)), parts_(std::move(parts)), name_(std::move(name)) {}

  geometry::FfdLattice lattice_;
  std::vector<Part> parts_;
  std::string name_;  // of the action
};

}  // namespace icome::interaction
