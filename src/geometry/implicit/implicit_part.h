#pragma once
#include <array>
#include <optional>

#include "geometry/implicit/implicit_parts.h"

namespace icome::geometry {

/// Conditions of a part that hold with equality, as bits: its own, then the sides of the box towards -x, +x,
/// -y, +y, -z, +z.
using ActiveSet = std::uint32_t;
constexpr unsigned kActiveBits = ImplicitParts::kMostConditions + 6;

/// One part of an implicit solid at one time. All functions are real-time safe.
class ImplicitPart {
 public:
  ImplicitPart(const ImplicitParts& parts, std::uint32_t number, double time)
      : parts_(parts), part_(parts.part(number)), conditions_(parts.conditions(number)), time_(time) {}

  /// The place of the part that is nearest to a point.
  struct Nearest {
    Vector3 place;
    double distance;   // m; 0 within the part
    ActiveSet active;  // the conditions that bound the solid there; none where only the cell ends
    /// No place x of the part is nearer than the root of distance^2 + (1 - spread) * |x - place|^2, nor than
    /// that of distance^2 + (x - place)' bowl (x - place).
    double spread;
    base::Matrix3 bowl;
    double width;  // m, of the cell searched around the place
    bool cut;      // the part ends there only because its cell does: the next part is as near

    double least() const;  // m, a lower bound of the distance to the part
  };
  /// Nothing where the part is empty, or surely not nearer than `limit` (m). Where another place might be
  /// nearer than the one found, and than `close` (m), it is searched for in parts of the cell.
  std::optional<Nearest> nearest(const Vector3& point, double close, double limit) const;

  /// Is surely no place nearer than `reach` (m) to the segment between two points?
  bool keeps_off(const Vector3& a, const Vector3& b, double reach) const;

  /// The place near `from` where the active conditions hold with equality that is nearest to `goal`, at most
  /// `reach` (m) away; for no active condition or three it does not depend on the goal.
  Vector3 along(ActiveSet active, const Vector3& from, const Vector3& goal, double reach) const;

  /// The subset of the active conditions that holds a ball pushed along `out` (unit) from a place where they
  /// are active: `out` is a sum of their normals. Of three or fewer.
  ActiveSet holding(ActiveSet active, const Vector3& place, const Vector3& out) const;

  /// One of the active conditions there: its value, and its gradient out of the solid.
  struct Slope {
    double value;
    Vector3 gradient;
    double rate;  // of the value, 1/s
  };
  Slope slope(unsigned condition, const Vector3& place) const;

 private:
  std::optional<Nearest> nearest_in(const Bounds& cell, const Vector3& point, double close, int splits) const;
  std::optional<Nearest> solve_in(const Bounds& cell, const Vector3& point) const;

  const ImplicitParts& parts_;
  const ImplicitParts::Part& part_;
  const std::span<const ImplicitParts::Condition> conditions_;
  const double time_;
};

}  // namespace icome::geometry
