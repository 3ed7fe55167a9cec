#pragma once
#include <optional>
#include <vector>

#include "apps/touch/touch_models.h"
#include "base/vector.h"
#include "geometry/tree/box_tree.h"

namespace icome::apps {

/// A place on the surface of the models, with the normal on the side that was looked from.
struct ProbedPoint {
  base::Vector3 point;   // m, world frame
  base::Vector3 normal;  // unit
};

/// The knowledge that a hand can have of the models before touching them: their places and the ends of lines
/// of sight. Refers to the models.
class SurfaceProbe {
 public:
  explicit SurfaceProbe(const std::vector<TouchModel>& models);

  /// The place where the line of sight from `from` to `to` ends, if it does; an open surface turns its normal
  /// towards `from`.
  std::optional<ProbedPoint> look(const base::Vector3& from, const base::Vector3& to) const;

  const base::Bounds& bounds() const { return bounds_; }
  /// The direction from which all of the surface can be seen when it is a sheet or a half-space; zero
  /// when it must be looked at from everywhere.
  const base::Vector3& front() const { return front_; }

 private:
  void find_front();

  std::vector<const TouchBody*> bodies_;  // in spatial order
  geometry::BoxTree boxes_;               // around them
  base::Bounds bounds_;
  base::Vector3 front_ = base::Vector3::Zero();
};

}  // namespace icome::apps
