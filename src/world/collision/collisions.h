#pragma once
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

#include "world/collision/bounds_tree.h"
#include "world/collision/collision_shape.h"
#include "world/edit/changes.h"

namespace icome::world {

/// Two objects whose shapes meet.
struct Collision {
  ObjectId one, other;
  Meeting meeting;  // not Apart
  auto operator<=>(const Collision&) const = default;
};

/// Finds the objects of a world that meet (thesis 2.4.1: "collision detection [...] on the top level"): it
/// descends into subtrees only where bounds meet, and examines shapes only where the bounds of objects do.
/// It keeps the bounds of every subtree in the world's frame; follow() updates them, in time in proportion
/// to the objects that an edit gave another place or shape, and to the depth of the hierarchy above them.
/// One thread owns it; shapes are prepared when they are first asked for.
class CollisionIndex {
 public:
  explicit CollisionIndex(const World& world);

  /// Follows an edit (or several) that the world has been through since the last call.
  void follow(const World& world, const Changes& changes);

  /// The collisions of the subtree's objects (`one` of each pair) with those outside of it, in the order of
  /// ids. With a place (its frame in the world's), as if the subtree stood there; nothing is changed. Ids
  /// that the world does not hold meet nothing.
  std::vector<Collision> collisions(ObjectId root, const std::optional<Affine3>& place = std::nullopt);
  /// Does it overlap anything there? Ends with the first overlap; touching is not counted.
  bool overlaps(ObjectId root, const std::optional<Affine3>& place = std::nullopt);

  /// The collisions among the subtree's objects: `one` has the smaller id. No id: of the whole world.
  std::vector<Collision> collisions_within(ObjectId root = {});

  /// A placed object that has a shape; the pointer is valid until the next follow().
  struct Standing {
    ObjectId id;
    CollisionShape* shape;  // never null
    Affine3 world_from_object;
  };
  /// The objects of a subtree that can meet others, in the order of ids. No id: of the whole world.
  std::vector<Standing> standing(ObjectId root = {});
  /// The objects of the world whose boxes meet `box`, and all unlimited ones, in the order of ids.
  std::vector<Standing> standing_in(const Bounds& box);

  /// Bounds of the placed shapes of a subtree; unlimited shapes are left out.
  Bounds bounds(ObjectId root) const;

  /// The work that the queries have done since the beginning.
  struct Work {
    std::size_t entered = 0;  // subtrees
    std::size_t shapes = 0;   // pairs of shapes
  };
  const Work& work() const { return work_; }

 private:
  using Slot = std::uint32_t;
  static constexpr Slot kWorld = 0;  // parent of the roots
  static constexpr Slot kNone = 0xffffffff;

  struct Node {
    ObjectId id = {};
    Slot parent = kNone;
    Affine3 world_from_object = Affine3::Identity();
    GeometryId geometry = {};  // none: no shape
    std::size_t user = 0;      // place among the users of the shape
    Bounds own;                // of the object's own shape; empty without one or if it is unlimited
    Bounds all;                // of the whole subtree
    BoundsTree children;       // children whose `all` is not empty
    BoundsTree::Leaf leaf = BoundsTree::kNone;  // in the parent's tree
    bool stale = false;                         // place or shape have changed
  };
  struct Shape {
    CollisionShape shape;
    std::vector<Slot> users;
  };
  class Query;

  Slot reach(const World& world, ObjectId id);
  void drop_missing(const World& world, const std::vector<ObjectId>& ids, std::vector<Slot>& shrunk);
  void link(Slot slot, Slot parent, std::vector<Slot>& shrunk);
  void leave_row(Slot slot);
  void choose_shape(const World& world, Slot slot, GeometryId geometry);
  void let_shape_go(Slot slot);
  void change_shape(Shape& of, const GeometryPointer& shape);
  void renew_all(const World& world, const std::vector<Slot>& stale);
  void renew(const World& world, Slot slot);
  void renew_place(const World& world, Slot slot);
  bool renew_bounds(Slot slot);
  void renew_upwards(Slot slot);
  bool is_below(Slot slot, Slot above) const;
  std::vector<Standing> standing_below(Slot root, const Bounds& box);

  std::vector<Node> nodes_;
  std::vector<Slot> free_;
  std::unordered_map<ObjectId, Slot> slots_;
  std::unordered_map<GeometryId, Shape> shapes_;
  std::vector<Slot> unlimited_;  // objects whose shape has no end
  Work work_;
};

}  // namespace icome::world
