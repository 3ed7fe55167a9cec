#pragma once
#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/object_id.h"
#include "base/shared_blocks.h"
#include "geometry/tree/box_tree.h"
#include "haptics/contact/motion.h"
#include "haptics/effects/surface_force.h"
#include "haptics/shapes/shape.h"

namespace icome::haptics {

using base::ObjectId;

/// One thing that can be touched.
struct HapticObject {
  ObjectId id;
  std::shared_ptr<const Shape> shape;  // never null
  Pose world_from_object = Pose::Identity();
  Motion motion;
  Surface surface;
  double time = 0.0;  // s, the own time of a shape that changes, at the moment 0
};

/// The scene that the servo touches: objects and a broad phase over them, immutable once compiled. Shares the
/// shapes, and shares all unchanged parts with the scenes that are made from it by moving objects. The servo
/// may read it while any other thread does too.
class HapticScene {
 public:
  /// Compiles a scene for the moment `moment` (s) of the shapes' own times. Ids must differ.
  static std::shared_ptr<const HapticScene> compile(std::vector<HapticObject> objects, double moment = 0.0);

  /// The scene at a moment (s), with other poses for some objects; the last of several for one object holds.
  /// Ids that the scene does not hold are passed over. The cost grows with the moved objects: few are tested
  /// beside the tree of all, which is refitted when they have become many.
  struct Move {
    ObjectId id;
    Pose world_from_object;
    Motion motion;
  };
  std::shared_ptr<const HapticScene> moved(std::span<const Move> moves, double moment = 0.0) const;

  /// Fills a region that was started for this scene. Real-time safe.
  void gather(ContactRegion& region) const;
  /// Gathers the elements of one object. Real-time safe.
  void gather_object(ContactRegion& region, std::uint32_t object) const;
  /// The elements of a deferred piece of an object, in the frame of a region. Real-time safe.
  void expand(std::uint32_t object, std::uint32_t piece, const ContactRegion::Frame& frame,
              PieceElements& elements) const;

  /// Hands out the pieces of an object that a tip can meet, as Shape::sweep does, on a way in the frame of a
  /// region. Real-time safe.
  std::size_t sweep(std::uint32_t object, const Vector3& start, const Vector3& step, double distance,
                    const ContactRegion::Frame& frame, PieceVisitor& visitor) const;

  /// Calls `visit(object)` for objects near the ball or segment until it returns false. Real-time safe
  /// when `visit` is.
  template <typename Visit>
  void near(const Vector3& a, const Vector3& b, double reach, Visit&& visit) const {
    const geometry::SegmentQuery query(a, b, reach);
    bool goes_on = true;
    tree_->near(query, [&](std::uint32_t slot) {
      const std::uint32_t object = (*order_)[slot];
      return is_stray(object) || (goes_on = visit(object));
    });
    for (std::size_t four = 0; goes_on && four < stray_boxes_.size(); ++four) {
      for (unsigned mask = stray_boxes_[four].near_mask(query); goes_on && mask != 0; mask &= mask - 1)
        goes_on = visit(strays_[four * geometry::FourBoxes::kCount + unsigned(__builtin_ctz(mask))]);
    }
  }

  /// The own time, s, of an object's shape `elapsed` seconds after the moment of the poses. Real-time safe.
  double time(std::uint32_t object, double elapsed) const {
    return objects_[object].time + moment_ + elapsed;
  }

  /// Does the object move from `elapsed` (s) on, or its shape change? Real-time safe.
  bool is_dynamic(std::uint32_t object, double elapsed = 0.0) const {
    return objects_[object].motion.moves(elapsed) || objects_[object].shape->changes();
  }

  /// The object's pose `elapsed` seconds after the moment of the poses. Real-time safe.
  Pose pose(std::uint32_t object, double elapsed) const;

  /// Velocity, m/s, of the object as a whole at a place, `elapsed` seconds after the moment. Real-time safe.
  Vector3 velocity(std::uint32_t object, double elapsed, const Vector3& place) const {
    return velocity_at(pose(object, elapsed), objects_[object].motion, elapsed, place);
  }

  /// The tolerance of contact arithmetic at a place on the object (in its frame). Real-time safe.
  Tolerance tolerance_near(std::uint32_t object, const Vector3& place) const;

  /// Box around everything the object can reach from its pose within the horizon, world frame.
  Bounds object_bounds(std::uint32_t object) const;

  /// The object's pose in a frame that lies at `origin`, with the world's axes. Real-time safe.
  Pose pose_in(const Vector3& origin, std::uint32_t object, double elapsed) const;

  /// The object's index in this scene. Real-time safe.
  std::optional<std::uint32_t> find(ObjectId id) const;

  const base::SharedBlocks<HapticObject>& objects() const { return objects_; }
  /// Was one of the two made from the other, or both from a third, by moving objects? Then they hold the
  /// same objects, at the same indices and with the same surfaces.
  bool holds_the_same(const HapticScene& other) const { return by_id_ == other.by_id_; }
  /// May an object of this block of objects() be dynamic?
  bool is_dynamic_block(std::size_t block) const { return extents_[block].moves; }
  /// The largest coordinate of the limited objects, m; 1 where there are none.
  double extent() const { return extent_; }
  /// The tolerance of arithmetic with any coordinate of the scene.
  Tolerance tolerance() const { return Tolerance::for_size(extent_); }
  /// The moment of the poses, s, on the clock of shapes that change.
  double moment() const { return moment_; }
  /// Is any object dynamic?
  bool moves() const { return moves_; }
  /// The box around all limited objects; empty when there are none.
  const Bounds& bounds() const { return bounds_; }
  std::size_t bytes() const;

 private:
  /// The extent of the objects of a block.
  struct Extent {
    Bounds bounds;  // of those that are limited; empty: there are none
    bool moves = false;
  };

  HapticScene() = default;

  bool is_stray(std::uint32_t object) const {
    return !strays_.empty() && std::binary_search(strays_.begin(), strays_.end(), object);
  }
  std::vector<geometry::FloatBox> slot_boxes() const;
  double size_near(std::uint32_t object, const Vector3& place) const;
  void measure_sizes();
  void measure_block(std::size_t block);
  void measure_all();
  void let_stray(std::span<const std::uint32_t> moved);

  base::SharedBlocks<HapticObject> objects_;
  std::vector<Extent> extents_;  // by block of objects_
  std::shared_ptr<const geometry::BoxTree> tree_;
  // Objects that have left their boxes in the tree, ascending, and their boxes, four at a time.
  std::vector<std::uint32_t> strays_;
  std::vector<geometry::FourBoxes> stray_boxes_;
  // Data that moving objects does not change.
  std::shared_ptr<const std::vector<std::uint32_t>> order_;  // slot in the tree to object
  std::shared_ptr<const std::vector<std::uint32_t>> by_id_;  // objects in the order of their ids
  std::shared_ptr<const std::vector<double>> sizes_;         // size of each object from its middle, m
  double moment_ = 0.0;                                      // s
  double extent_ = 1.0;                                      // m
  Bounds bounds_;
  bool moves_ = false;
};

}  // namespace icome::haptics
