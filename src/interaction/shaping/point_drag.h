#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "geometry/deform/soft_selection.h"
#include "interaction/shaping/mesh_part.h"
#include "world/edit/edit.h"

namespace icome::interaction {

/// Vertices that are dragged together, of one shape or of several, and their places at the start, so that the
/// last of many steps leaves them where the hand is, without the rounding of earlier steps. All objects that
/// share a shape change with it (thesis 2.4.1).
class PointDrag {
 public:
  /// The dragged vertices of one shape.
  struct Followers {
    world::GeometryId geometry = {};
    world::GeometryPointer before = {};
    std::vector<std::uint32_t> vertices = {};
    std::vector<Vector3> starts = {};                            // m, shape frame; as many
    std::vector<double> weights = {};                            // their shares of the way; as many
    base::Matrix3 shape_from_world = base::Matrix3::Identity();  // of directions
  };
  /// `name`: of the action, as in "Drag vertex of leg".
  PointDrag(std::vector<Followers> followers, std::string name)
      : followers_(std::move(followers)), name_(std::move(name)) {}

  const std::string& name() const { return name_; }
  const std::vector<Followers>& followers() const { return followers_; }
  /// Moves all of them from their places at the start by their shares of the offset (m, world frame).
  world::Edit by(const Vector3& offset) const;
  /// The last step, for meshes that are too big to bend their corner normals with the surface at every
  /// step: by() with bent normals. Nothing where by() has done all.
  std::optional<world::Edit> last(const Vector3& offset) const;

 private:
  std::vector<Followers> followers_;
  std::string name_;
};

/// Takes hold of a vertex, an edge or a face. Others within the soft selection's radius, which is measured in
/// the world's frame (m) whatever the object's size, follow; and vertices at one place stay together, so that
/// no crack opens. Takes time by the size of the mesh. Fails for missing objects and vertices, radii that are
/// not finite or negative, and objects that are squashed flat.
base::Result<PointDrag> drag_part(const world::World& world, world::ObjectId object, const MeshPart& part,
                                  const geometry::SoftSelection& soft);

}  // namespace icome::interaction
