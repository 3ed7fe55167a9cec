#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "interaction/snapping/snap_shape.h"
#include "world/collision/collisions.h"

namespace icome::interaction {

/// The kinds of places that a point can snap to, the strongest first.
enum class SnapKind : std::uint8_t { Vertex, Middle, Edge, Face, Grid };
/// "a corner", "the grid", for people.
std::string_view name_of(SnapKind kind);

/// The snaps that are switched on. A stronger kind wins over a nearer place.
struct SnapSettings {
  double radius = 0.01;  // m, world frame, of the snap; usually 2 mm to 5 cm
  bool vertices = true;
  bool middles = true;  // of straight edges
  bool edges = true;
  bool faces = true;
  bool grid = false;
  double spacing = 0.01;  // m, of the grid of the world's frame

  static SnapSettings none() {
    return {.vertices = false, .middles = false, .edges = false, .faces = false, .grid = false};
  }
  /// Is anything switched on?
  bool any() const { return vertices || middles || edges || faces || grid; }
};

/// The place that a point snaps to; world frame.
struct Snap {
  SnapKind kind = SnapKind::Grid;
  Vector3 point = Vector3::Zero();      // m
  Vector3 direction = Vector3::Zero();  // unit: along the edge, or out of the face; zero for other kinds
  Vector3 from = Vector3::Zero();       // of an edge: its ends, or those of its tangent, where it is round
  Vector3 to = Vector3::Zero();
  world::ObjectId object = {};  // none for the grid
  double distance = 0.0;        // m, from the point that snaps
};

/// The points of moved objects that may snap.
struct SnapHandles {
  bool origins = true;   // of the objects' own frames
  bool box = true;       // corners and middle of the box around them
  bool vertices = true;  // that SnapShape::corners knows; of those with more than 512 the outermost
};

/// A snap of objects that are moved.
struct ObjectSnap {
  Snap snap;
  Vector3 handle;                                         // m: the point of them that snaps, where it is now
  Vector3 offset() const { return snap.point - handle; }  // m: the move that snaps
};

/// Finds places to snap to. Keeps the prepared shapes: the first query takes time by the size of the
/// shapes that are near, later ones by the logarithm of it. One thread owns it. The world and the index
/// of a query must be at the same edit.
class SnapFinder {
 public:
  static constexpr double kSharpAngle = 0.17453292519943295;  // rad, 10 degrees

  /// `sharp_angle` (rad): where meshes bend by as much they have edges; less is smooth.
  explicit SnapFinder(double sharp_angle = kSharpAngle) : sharp_angle_(sharp_angle) {}

  /// Forgets shapes that changed or are gone.
  void follow(const world::Changes& changes);

  /// The best snap of a point (m, world frame); nothing where there is none or where numbers are not
  /// finite. `left_out` and all below them are not snapped to.
  std::optional<Snap> nearest(const world::World& world, world::CollisionIndex& index, const Vector3& point,
                              const SnapSettings& settings, std::span<const world::ObjectId> left_out = {});

  /// The best snap of every handle of objects that are moved by `offset` (m, world frame) off where they
  /// stand, best first; they do not snap to themselves. None where the effort (null: unlimited) is
  /// spent.
  std::vector<ObjectSnap> of_objects(const world::World& world, world::CollisionIndex& index,
                                     std::span<const world::ObjectId> objects, const Vector3& offset,
                                     const SnapSettings& settings, const SnapHandles& handles = {},
                                     world::Effort* effort = nullptr);

  /// The handles of objects, where these stand; m, world frame.
  std::vector<Vector3> handles_of(const world::World& world, world::CollisionIndex& index,
                                  std::span<const world::ObjectId> objects, const SnapHandles& handles = {});

  /// Number of shapes that are kept.
  std::size_t kept() const { return shapes_.size(); }

 private:
  using Standing = world::CollisionIndex::Standing;
  struct Kept {
    world::GeometryPointer shape;
    std::unique_ptr<const SnapShape> snaps;
  };

  const SnapShape* snaps_of(const world::World& world, world::ObjectId object);
  std::optional<Snap> best(const world::World& world, world::CollisionIndex& index, const Vector3& point,
                           const SnapSettings& settings, const std::vector<world::ObjectId>& left_out);
  std::uint64_t effort_to_make(const world::World& world, const Standing& standing) const;
  bool may_look(const world::World& world, world::CollisionIndex& index, const base::Bounds& around,
                world::Effort& effort) const;

  double sharp_angle_;
  std::unordered_map<world::GeometryId, Kept> shapes_;
};

/// The grid point next to a point; nothing where it is further than `radius`.
std::optional<Snap> snap_to_grid(const Vector3& point, double spacing, double radius);

}  // namespace icome::interaction
