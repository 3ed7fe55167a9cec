#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"
#include "geometry/sweep/profile.h"

namespace icome::geometry {

using base::Affine3;

/// One motion of a sweep, done `repeat` times over. All values are in the frame that stands still, not in
/// that of the moved object. The order is: scale, rotate, translate.
struct SweepStep {
  Vector3 scaling = Vector3::Ones();      ///< along x, y and z away from the centre; 0 or more
  double angle = 0.0;                     ///< radians about the axis, right-handed
  Vector3 axis = Vector3::UnitZ();        ///< of any length; needed where there is an angle
  Vector3 centre = Vector3::Zero();       ///< m; the axis goes through it, and scaling leaves it in place
  Vector3 translation = Vector3::Zero();  ///< m
  int repeat = 1;                         ///< at least once
};

/// The most placements repeated_copies() gives.
inline constexpr std::size_t kMaximumCopies = 1'000'000;

/// The motion of doing the step once. Precondition: check_steps() finds no fault.
Affine3 motion(const SweepStep& step);

/// Fails, naming the step, for numbers that are not finite, negative scaling, an angle without an axis, or a
/// repeat below 1; also where there is no step.
base::Result<void> check_steps(std::span<const SweepStep> steps);

/// Walks through the placements that the steps lead to, the start left out. Where a step turns and moves
/// along its axis only, its repeats are computed from the first and not from one another, so that however
/// many there are, points on the axis stay there. Precondition: check_steps() finds no fault.
class SweepWalk {
 public:
  explicit SweepWalk(std::span<const SweepStep> steps) : steps_(steps) {}

  /// Goes to the next placement; false when there is none.
  bool next();
  /// Is this the last placement?
  bool at_end() const { return step_ + 1 == steps_.size() && repeat_ == steps_[step_].repeat; }

  const Affine3& place() const { return place_; }
  std::size_t step() const { return step_; }  ///< from 0
  int repeat() const { return repeat_; }      ///< from 1

 private:
  std::span<const SweepStep> steps_;
  std::size_t step_ = 0;
  int repeat_ = 0;
  Affine3 place_ = Affine3::Identity();
  Affine3 place_before_ = Affine3::Identity();  // the placement at the beginning of the present step
};

/// Extrude 3D: the placements of further copies of an object, when `step` puts the first one in its place as
/// seen from `pivot`: a point x goes to pivot + step * (x - pivot). Each next copy is one such step from the
/// one before. Placement 0 is that of the first copy. Fails for numbers that are not finite, a step that
/// flattens or does nothing, for more than kMaximumCopies, and where copies leave the range of double.
base::Result<std::vector<Affine3>> repeated_copies(const Affine3& step, const Vector3& pivot,
                                                   std::size_t count);

}  // namespace icome::geometry
