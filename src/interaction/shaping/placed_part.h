#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "geometry/csg/csg_tree.h"
#include "geometry/deform/texture_projection.h"
#include "world/edit/edit.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::interaction {

/// A part of an object that has a place of its own, though it is no object: an operand of its solid, or the
/// projector that threw the picture on its mesh.
struct PlacedPart {
  world::ObjectId object = {};
  std::optional<geometry::CsgTree::Index> operand = {};  // a leaf of the solid; none: the projector
  bool operator==(const PlacedPart&) const = default;
};

/// The placed parts of these objects and of all below them; the first `most`, and none of solids with more
/// than 10,000 nodes.
std::vector<PlacedPart> placed_parts(const world::World& world, std::span<const world::ObjectId> objects,
                                     std::size_t most);

/// The solid that an operand belongs to, and the projector that a part is; nothing where it is gone.
const geometry::CsgTree* solid_of_part(const world::World& world, const PlacedPart& part);
std::optional<geometry::TextureProjector> projector_of_part(const world::World& world,
                                                            const PlacedPart& part);

/// The part's own frame, that of the operand's shape or of the projector, in the world's; nothing where it
/// is gone or not finite.
std::optional<base::Affine3> world_from_part(const world::World& world, const PlacedPart& part);

/// "operand 1 of plate", as `move-operand` counts them, or "projector of plate".
std::string name_of(const world::World& world, const PlacedPart& part);

/// A part that is dragged, and its place at the start, so that the last of many steps leaves it where the
/// hand is, without the rounding of earlier steps. All objects that share the shape change with it (thesis
/// 2.4.1).
class PartDrag {
 public:
  /// Fails for parts that are gone.
  static base::Result<PartDrag> take(const world::World& world, const PlacedPart& part);

  const PlacedPart& part() const { return part_; }
  /// The action's name: "Move operand 1 of plate".
  const std::string& name() const { return name_; }
  /// The centre of its turns, m, world frame: the middle of the operand's shape, or the projector's.
  const base::Vector3& centre() const { return centre_; }
  /// Is by() quick enough for every step? Pictures on large meshes are thrown once, at the end.
  bool is_live() const;
  /// The edit that carries it from its place at the start along with a motion of the world. Fails where there
  /// is nowhere to go.
  base::Result<world::Edit> by(const base::Affine3& motion) const;

 private:
  PartDrag(PlacedPart part, world::GeometryId geometry, world::GeometryPointer before)
      : part_(part), geometry_(geometry), before_(std::move(before)) {}

  PlacedPart part_;
  world::GeometryId geometry_;
  world::GeometryPointer before_;  // never null
  base::Affine3 world_from_object_ = base::Affine3::Identity();
  base::Vector3 centre_ = base::Vector3::Zero();
  std::string name_;
};

}  // namespace icome::interaction
