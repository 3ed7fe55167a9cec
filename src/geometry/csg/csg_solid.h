#pragma once
#include <memory>

#include "geometry/csg/csg_tree.h"
#include "geometry/smooth_surface.h"

namespace icome::geometry {

class CsgFaces;
class CsgProgram;

/// A CSG tree compiled for touch: its surface as the exact, trimmed faces of its primitives. Made once
/// from a tree; immutable.
class CsgSolid final : public SmoothSurface {
 public:
  explicit CsgSolid(const CsgTree& tree);
  ~CsgSolid() override;

  Bounds bounds() const override;
  void near(const Vector3& a, const Vector3& b, double reach, double time, PieceVisitor visit) const override;
  bool inside(const Vector3& point, double time = 0.0) const override;
  std::optional<SurfacePlace> way_out(const Vector3& point, double time) const override;
  std::optional<SurfaceHit> first_hit(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                      bool from_behind, double time, double slack) const override;
  SurfacePlace nearest_local(const SurfacePlace& from, const Vector3& goal, double time) const override;
  bool covers(const SurfacePlace& place, const Vector3& above, double time, double slack) const override;
  std::size_t bytes() const override;

  const CsgProgram& program() const;

  /// The first crossing of the segment from `a` to `b` with the surface, in either direction, for meshing and
  /// pictures; nothing when there is none. Real-time safe.
  std::optional<SurfacePoint> crossing(const Vector3& a, const Vector3& b) const;

 private:
  std::optional<SurfacePlace> straight_out(const Vector3& point) const;

  std::unique_ptr<const CsgFaces> faces_;
};

}  // namespace icome::geometry
