#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "base/result.h"
#include "interaction/navigation.h"
#include "interaction/techniques/selection_cone.h"

namespace icome::interaction {

/// Names a target for techniques; 0 names none.
using TargetId = std::uint64_t;

/// The shape of a target, in a frame of its own (m). Answers in the world's frame are exact.
class TargetShape {
 public:
  virtual ~TargetShape() = default;
  /// Distance from the point to the surface, m; 0 or less inside a solid. May be anything >= `limit` where
  /// it is not less.
  virtual double distance(const base::Affine3& world_from_target, const Vector3& point,
                          double limit) const = 0;
  /// Distance along the ray to the first hit of the surface, m.
  virtual std::optional<double> first_hit(const base::Affine3& world_from_target, const Ray& ray) const = 0;
  virtual bool meets(const base::Affine3& world_from_target, const SelectionCone& cone) const = 0;
};

/// A thing that can be pointed at. Without a shape it is the ball itself; the ball of one with a shape holds
/// all of it.
struct SceneTarget {
  TargetId id = 0;
  base::Affine3 world_from_target = base::Affine3::Identity();
  Vector3 centre = Vector3::Zero();  // of the ball, own frame, m
  double radius = 0.05;              // of the ball, own frame, m; > 0
  std::shared_ptr<const TargetShape> shape = nullptr;
};

/// The ball around a target in the world's frame; the target itself, if it is a ball and not stretched.
struct TargetBall {
  Vector3 centre;  // m
  double radius;   // m
};
TargetBall ball_of(const SceneTarget& target);

/// The world as techniques see it: the targets and their places. A plain value that owns its targets and
/// shares their shapes; the same targets, added in the same order, give the same answers to the last bit.
/// Queries look at every ball, and at the shapes of those that are met.
class TechniqueScene {
 public:
  /// Fails for an id that is 0 or there already, and for impossible sizes and places.
  base::Result<void> add(const SceneTarget& target);
  /// False, and nothing changes, where there is no such target or the place is impossible.
  bool move(TargetId id, const base::Affine3& world_from_target);

  /// The target of that id; null where there is none. Valid until the next change.
  const SceneTarget* find(TargetId id) const;
  const std::vector<SceneTarget>& targets() const { return targets_; }
  /// The ball of the target at a place in targets().
  const TargetBall& ball(std::size_t place) const { return balls_[place]; }
  /// The bounds of all balls; empty when there is none.
  base::Bounds bounds() const;

  /// A target and its distance, m.
  struct Found {
    TargetId id;
    double distance;
  };
  /// The target whose surface is nearest, or which the point is deepest within; the first added of several.
  std::optional<Found> nearest(const Vector3& point,
                               double limit = std::numeric_limits<double>::infinity()) const;
  std::optional<Found> first_hit(const Ray& ray) const;

  /// A target in the light of a spotlight.
  struct Lit {
    TargetId id;
    double off_axis;  // rad, of its ball's centre
    double depth;     // m, of the ball's centre along the axis
  };
  std::vector<Lit> lit_by(const SelectionCone& cone) const;

 private:
  std::vector<SceneTarget> targets_;
  std::vector<TargetBall> balls_;
  std::unordered_map<TargetId, std::size_t> places_;
};

}  // namespace icome::interaction
