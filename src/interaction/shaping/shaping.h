#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "interaction/shaping/lattice_cage.h"

namespace icome::interaction {

/// The things that people drag to change a shape by hand.
enum class ShapingTarget : std::uint8_t { Vertex, Edge, Face, Lattice };

struct ShapingSettings {
  ShapingTarget target = ShapingTarget::Vertex;
  geometry::SoftSelection soft = {};     // of vertices, edges and faces; its radius in the world's frame
  std::array<int, 3> cells = {2, 2, 2};  // of the lattice, 1 to kMostCells along each axis
  static constexpr int kMostCells = 10;
};

/// Something that can be taken hold of.
struct ShapingHandle {
  Vector3 place = Vector3::Zero();        // m, world frame, when it was found
  std::optional<std::size_t> point = {};  // of the lattice; else a part of a mesh:
  world::ObjectId object = {};
  MeshPart part = {};
};
bool same_handle(const ShapingHandle& one, const ShapingHandle& other);

/// A handle to be marked, and the drag of it that is under way.
struct MarkedHandle {
  ShapingHandle handle = {};
  std::shared_ptr<const PointDrag> drag = {};  // null: it is only hovered over
};

/// The drawing of handles; world frame, m. Lines are separated by places that are not finite.
struct ShapingPicture {
  std::vector<Vector3> dots = {}, lines = {};
  std::vector<Vector3> marked_dots = {}, marked_lines = {};
};

/// Finds and takes hold of the handles of shapes: vertices, edges and faces of meshes and control
/// meshes, or the points of a lattice round the selection. Keeps finders of a few shapes and the
/// lattice; uses the world only while it is called. One thread owns it.
class Shaping {
 public:
  /// Fails for a radius that is not finite or negative, and for numbers of cells out of range.
  base::Result<void> set(const ShapingSettings& settings);
  const ShapingSettings& settings() const { return settings_; }

  /// With the lattice as target, puts one at rest round the selection as soon as that, or a deformed
  /// shape, is another. To be called once for each update.
  void follow(const world::World& world, std::span<const world::ObjectId> selection);
  /// The reason why there is no lattice, in a sentence that says what to do; else empty.
  const std::string& complaint() const { return complaint_; }
  const std::optional<LatticeCage>& cage() const { return cage_; }

  /// The handle that the probe meets best: of these objects' meshes (others are skipped), or of the lattice.
  std::optional<ShapingHandle> find(const world::World& world, std::span<const world::ObjectId> objects,
                                    const PartProbe& probe);
  /// Fails as drag_part() does, for handles of a lattice that is gone, and for points of one that move
  /// nothing.
  base::Result<PointDrag> take(const world::World& world, const ShapingHandle& handle) const;
  /// To be called when a step of a handle's drag has been performed, or taken back (zero).
  void moved(const world::World& world, const ShapingHandle& handle, const Vector3& offset);

  /// The handles of these objects' meshes and of those with something marked, where they are small enough,
  /// and those round the marks.
  ShapingPicture picture(const world::World& world, std::span<const world::ObjectId> objects,
                         std::span<const MarkedHandle> marked) const;

 private:
  const PartFinder* finder_of(const world::World& world, world::ObjectId object);
  void show_mesh(const world::World& world, world::ObjectId object, ShapingPicture& picture) const;
  void show_marked(const world::World& world, const MarkedHandle& marked, ShapingPicture& picture) const;
  void show_around(const world::World& world, const MarkedHandle& marked, ShapingPicture& picture) const;

  ShapingSettings settings_;
  std::map<world::GeometryId, PartFinder> finders_;
  std::vector<world::ObjectId> caged_;  // the selection that the lattice is round
  std::optional<LatticeCage> cage_;
  std::string complaint_;
};

/// Objects whose vertices can be dragged, among the given ones and all below them; the first `most`.
std::vector<world::ObjectId> draggable_objects(const world::World& world,
                                               std::span<const world::ObjectId> objects, std::size_t most);

}  // namespace icome::interaction
