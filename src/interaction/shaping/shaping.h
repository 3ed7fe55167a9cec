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

/// What people drag to change a shape by hand.
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

/// A handle that is to be pointed out, with the drag of it under way.
struct MarkedHandle {
  ShapingHandle handle = {};
  std::shared_ptr<const PointDrag> drag = {};  // null: it is only hovered over
};

/// What is drawn of handles; world frame, m. In lines, places that are not finite part one from the next.
struct ShapingPicture {
  std::vector<Vector3> dots = {}, lines = {};
  std::vector<Vector3> marked_dots = {}, marked_lines = {};
};

/// Finds and takes hold of what shapes are dragged by: vertices, edges and faces of meshes and control
/// meshes, or the points of a lattice round the selection. Keeps what it knows of a few shapes and the
/// lattice; knows the world only while it is called. One thread owns it.
class Shaping {
 public:
  /// Fails for a radius that is not finite or negative, and for numbers of cells out of range.
  base::Result<void> set(const ShapingSettings& settings);
  const ShapingSettings& settings() const { return settings_; }

  /// Where there is to be a lattice, puts it round the selection as soon as that, or what is deformed, is
  /// another: at rest then. Call it once for each update.
  void follow(const world::World& world, std::span<const world::ObjectId> selection);
  /// Why there is no lattice, in a sentence that says what to do; else empty.
  const std::string& complaint() const { return complaint_; }
  const std::optional<LatticeCage>& cage() const { return cage_; }

  /// What the probe meets best: of these objects' meshes (others are passed over), or of the lattice.
  std::optional<ShapingHandle> find(const world::World& world, std::span<const world::ObjectId> objects,
                                    const PartProbe& probe);
  /// Fails as drag_part() does, for handles of a lattice that is gone, and for points of one that move
  /// nothing.
  base::Result<PointDrag> take(const world::World& world, const ShapingHandle& handle) const;
  /// A step of the drag of a handle has been performed, or has been taken back (zero).
  void moved(const world::World& world, const ShapingHandle& handle, const Vector3& offset);

  /// Of these objects' meshes and those with something marked, where they are small enough, and round what is
  /// marked.
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

/// The objects below those, and they themselves, of which vertices can be dragged; the first `most`.
std::vector<world::ObjectId> draggable_objects(const world::World& world,
                                               std::span<const world::ObjectId> objects, std::size_t most);

}  // namespace icome::interaction
