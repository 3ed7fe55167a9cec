#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "haptics/judge/contact_judge.h"

namespace icome::haptics {

class WitnessWays;

/// The block of a way: the share of it that is free, and the unit normal that blocks it, against the way.
struct Block {
  double t;
  base::Vector3 normal;
};

/// Smallest lengths that a judge tells apart.
struct Resolution {
  double noise;  // m, possible error of positions
  double wall;   // m, the thinnest wall that must not be overlooked where only samples tell
};

/// The questions of a judge to one object. Points in the object's frame, m. Each kind of surface answers in
/// its own way, which shares nothing with the code that finds contacts.
class Witness {
 public:
  virtual ~Witness() = default;

  /// From now on, answers are about this moment (s).
  virtual void set_time(double /*time*/) {}

  /// The first place at which a point going from `a` to `b` meets a side that stops it.
  virtual std::optional<Block> blocked(const base::Vector3& a, const base::Vector3& b) const = 0;

  /// Is there no such place on the way from `a` to `b`?
  virtual bool passes(const base::Vector3& a, const base::Vector3& b) const { return !blocked(a, b); }

  /// The distance from `point` to the nearest surface, `limit` when there is none within that.
  virtual double distance(const base::Vector3& point, double limit) const = 0;

  /// A distance within which surely no surface lies; at most `limit`. 0 where only samples tell.
  virtual double least_distance(const base::Vector3& point, double limit) const {
    return distance(point, limit);
  }

  /// Depth of the surface in a ball around `point`, from a side that stops it; 0 if it does not reach in.
  virtual double overlap(const base::Vector3& point, double radius) const = 0;

  /// Does it reach into a ball around `point` at all, from a side that stops it?
  virtual bool overlaps(const base::Vector3& point, double radius) const {
    return overlap(point, radius) > 0.0;
  }

  /// Calls `visit(nearest)` with the nearest place of each part of the surface that a ball of that radius
  /// around `point` would touch from a side that stops it; of surfaces that have no parts, with none.
  virtual void touched(const base::Vector3& /*point*/, double /*radius*/,
                       const std::function<void(const base::Vector3&)>& /*visit*/) const {}

  /// Has it an inside that a tip must be kept out of?
  virtual bool solid() const = 0;

  /// Is the point inside a solid touched from the front?
  virtual bool inside(const base::Vector3& point) const = 0;

  /// Is it inside, and more than `depth` from the surface?
  virtual bool deep(const base::Vector3& point, double depth) const {
    return distance(point, depth) >= depth && inside(point);
  }

  /// Number of questions so far that took too long to be answered in full.
  virtual std::uint64_t unfinished() const { return 0; }
  /// The ways along a mesh; null for any other surface. Made when first asked for.
  virtual const WitnessWays* ways() const { return nullptr; }
};

/// Box around the object's surface, in its own frame.
base::Bounds bounds(const JudgedObject& object);

std::unique_ptr<Witness> make_witness(const JudgedObject& object, const Resolution& resolution);

// The witnesses of each kind of surface.
std::unique_ptr<Witness> make_mesh_witness(const JudgedObject& object);
std::unique_ptr<Witness> make_primitive_witness(const JudgedObject& object, const Resolution& resolution);
std::unique_ptr<Witness> make_membership_witness(const MembershipSolid& solid, const Resolution& resolution);

}  // namespace icome::haptics
