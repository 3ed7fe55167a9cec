#pragma once
#include <limits>

#include "geometry/loop/loop_patches.h"
#include "geometry/loop/loop_walk.h"

namespace icome::geometry {

/// A straight way through the surface, with the frame in which the surface is seen. Real-time safe.
struct LoopRay {
  /// `about_normal` need not be exact: where it is the surface's normal, grazing rays take least work.
  LoopRay(const Vector3& from, const Vector3& step, double slack, const Vector3& about_normal);

  Vector3 start, along;    // along: unit
  Vector3 across, beside;  // unit; across is the direction nearest to `about_normal`; right-handed
  double length;           // m
  double slack;            // m
};

/// A crossing of a ray with a piece.
struct LoopCrossing {
  double at;  // m along the ray
  LoopSpot spot;
  double slope;  // the sine of the angle between ray and surface: negative from front to back
  bool sure;     // a plain crossing, well away from grazing
};

/// Finds crossings of a ray with pieces: subdivides with bounds that never lose one until Newton's method is
/// sure to find the only one left, or until the ray is within rounding of the surface (reported as a
/// crossing, as it may be one). A crossing near the border of two cells may be reported twice. Real-time
/// safe, the work for one piece is bounded.
class LoopCrossings {
 public:
  /// Returns the distance along the ray (m) up to which crossings are of interest from now on.
  using Visitor = base::FunctionRef<double(const LoopCrossing&)>;

  LoopCrossings(const LoopPatches& patches, const LoopRay& ray, Visitor visit);
  void find(std::uint32_t piece);

 private:
  struct Node;
  enum class Verdict { Nothing, Done, Unsure };
  struct View {
    bool misses;
    double extent;           // m, the longest along the ray and across it
    double thickness = 0.0;  // m, across the ray, where it is least
  };

  Vector4 seen(const Vector4& point, const Vector3& origin) const;
  bool out_of_sight(const Vector4& low, const Vector4& high) const;
  void search(std::uint32_t piece, const BoxSplineControl& control, const LoopCell& cell);
  View view_of(const QuarticTriangle& shape) const;
  Verdict newton(std::uint32_t piece, const LoopCell& cell, const Node& node, double extent);
  void graze(std::uint32_t piece, const LoopCell& cell, const Node& node);
  void report(std::uint32_t piece, const LoopCell& cell, double s, double t, const QuarticJet& jet,
              bool sure);
  bool misses_rest(const LoopFanPoints& fan, int level) const;

  const LoopPatches& patches_;
  const LoopRay& ray_;
  Visitor visit_;
  double limit_;     // m along the ray
  double margin_;    // m, around bounds
  double rounding_;  // m, the distance below which surfaces are not distinguished
  int work_ = 0;
};

}  // namespace icome::geometry
