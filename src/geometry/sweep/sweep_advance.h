#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/sweep/sweep.h"

namespace icome::geometry {

/// A placed profile: its corners in space, and the vertices of the mesh that they became.
struct SweepSection {
  Affine3 place = Affine3::Identity();
  std::vector<Vector3> points = {};
  std::vector<std::uint32_t> vertices = {};

  /// The direction that the outline runs around counter-clockwise, as long as the area it is stretched by.
  Vector3 normal() const { return place.linear().col(0).cross(place.linear().col(1)); }
};

/// The direction in which the inside of an outline moves from one section to the next.
enum class SweepAdvance {
  Forward,   ///< towards the side from which the outline runs counter-clockwise
  Backward,  ///< to the other side
  Level,     ///< nowhere: the sections lie in one plane
  Crossing,  ///< some of it forward and some of it backward
};

/// Judges the straight way from each point of one section to the same point of the next: volume that is swept
/// is turned inside-out exactly where the Jacobian of that map changes its sign. It is linear in the profile,
/// so that the corners tell about all of the inside. Steps below `tolerance` (m) do not count.
SweepAdvance advance_between(const SweepSection& from, const SweepSection& to, double tolerance);

/// Remembers the advance of a sweep and tells when it runs back into itself. Within a plane an outline may
/// shrink, as for the bottom of a cup, and then turn back; after growing it may not.
class AdvanceRules {
 public:
  explicit AdvanceRules(bool capped, bool joined) : capped_(capped), joined_(joined) {}

  /// Takes the next step out of the plane; false when it runs back into what came before.
  bool take(SweepAdvance advance);
  /// Takes the next step within the plane.
  bool take_level(bool shrinks);
  /// May the sweep end here?
  bool may_end() const;

  bool has_volume() const { return first_ != SweepAdvance::Level; }
  bool starts_backward() const { return first_ == SweepAdvance::Backward; }

 private:
  enum class Flat { None, Shrinks, Grows };

  bool capped_;
  bool joined_;
  SweepAdvance first_ = SweepAdvance::Level;
  SweepAdvance latest_ = SweepAdvance::Level;
  Flat flat_ = Flat::None;  // since the latest step out of the plane
  Flat flat_at_start_ = Flat::None;
};

}  // namespace icome::geometry
