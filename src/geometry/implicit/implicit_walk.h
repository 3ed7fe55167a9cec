#pragma once
#include <optional>

#include "geometry/implicit/formula.h"

namespace icome::geometry {

/// Walks on the surface f = 0 of a formula at one time. `size` (m) is that of the whole object: results are
/// exact to some 1e-13 of it. All functions are real-time safe.
class ImplicitWalk {
 public:
  ImplicitWalk(const Formula& formula, double time, double size)
      : formula_(formula), time_(time), size_(size) {}

  struct Place {
    base::Vector3 point;
    base::Vector3 normal;  // unit, towards larger f
    bool reached = true;  // of descend(): the distance has its minimum there; false: the walk stopped earlier
  };

  /// Moves a point near the surface onto it, along the gradient; nothing if it is not within `reach`.
  std::optional<Place> settle(const base::Vector3& point, double reach) const;

  /// Walks from near the surface, along it, to a local minimum of the distance to `goal`, or as far as is
  /// certain: each leg is proved to stay on one sheet of the surface.
  Place descend(const base::Vector3& from, const base::Vector3& goal) const;

  /// The unit gradient there; nothing where f has none.
  std::optional<base::Vector3> normal(const base::Vector3& point) const;

 private:
  struct Leg {
    Place end;
    bool arrived;  // at the minimum
  };
  /// Newton's method for the minimum, no further than `reach` from `from`. Nothing where it fails.
  std::optional<Leg> leg(const base::Vector3& from, const base::Vector3& goal, double reach) const;
  /// A leg along a crease of the surface, where the gradient jumps (of abs, min and max). `up`, unit, is
  /// the mean of the normals on both sides.
  std::optional<Leg> crease_leg(const Place& from, const base::Vector3& goal, double reach,
                                base::Vector3& up) const;
  double gain(const base::Vector3& from, const base::Vector3& to, const base::Vector3& goal) const;
  bool is_straight_on(const Place& from, const Place& to, const base::Vector3& up) const;
  bool on_one_sheet(const Place& from, const Place& to, const base::Vector3& up, int halvings) const;

  const Formula& formula_;
  double time_;
  double size_;
};

}  // namespace icome::geometry
