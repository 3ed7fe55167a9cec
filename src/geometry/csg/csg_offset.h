#pragma once
#include <memory>
#include <vector>

#include "base/result.h"
#include "geometry/csg/csg_faces.h"
#include "geometry/csg/curve_arc.h"
#include "geometry/smooth_surface.h"

namespace icome::geometry {

/// The places of a ball's centre while it touches a CSG solid: the solid's surface at the ball's radius. Such
/// a ball lies on a face, an edge or a corner, so the pieces are the faces at that distance (CsgFaces), and
/// tubes around the edges (csg_edges), whose round ends are the balls around the corners. All places within a
/// tube are too near to the solid, so that tubes need no trimming, and one that nothing can reach, as along a
/// concave edge, does no harm. Points are inside() where the ball's centre cannot be.
/// Immutable; its points are places of the centre.
class CsgOffset final : public SmoothSurface {
 public:
  /// For a ball of this radius (m, > 0). Fails, with the reason as a clause, where the surface is not known
  /// in closed form: curved primitives that are stretched, primitives of one's own, solids without bounds,
  /// tori in whose hole the ball sticks, and edges that take too much work to find.
  static base::Result<std::shared_ptr<const CsgOffset>> create(const CsgTree& tree, double radius);

  double radius() const { return faces_.tip(); }
  std::size_t edge_count() const { return edges_.size(); }

  Bounds bounds() const override;
  void near(const Vector3& a, const Vector3& b, double reach, double time, PieceVisitor visit) const override;
  bool inside(const Vector3& point, double time = 0.0) const override;
  std::optional<SurfacePlace> way_out(const Vector3& point, double time) const override;
  std::optional<SurfaceHit> first_hit(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                      bool from_behind, double time, double slack) const override;
  SurfacePlace nearest_local(const SurfacePlace& from, const Vector3& goal, double time) const override;
  bool covers(const SurfacePlace& place, const Vector3& above, double time, double slack) const override;
  std::size_t bytes() const override;

 private:
  CsgOffset(CsgFaces walls, CsgFaces faces, std::vector<CurveArc> edges);

  bool is_face(std::uint32_t piece) const { return piece < faces_.count(); }
  const CurveArc& edge(std::uint32_t piece) const { return edges_[piece - faces_.count()]; }
  SurfacePlace on_tube(std::uint32_t piece, double s, const Vector3& normal) const;
  template <typename Visit>
  void overlapped(const Vector3& point, Visit&& visit) const;
  bool overlaps(const Vector3& point) const;

  CsgFaces walls_;                    // the solid's own faces, which give its distance
  CsgFaces faces_;                    // those at the ball's radius
  std::vector<CurveArc> edges_;       // in the tree's order
  std::vector<FloatBox> edge_boxes_;  // around their tubes
  BoxTree edge_tree_;
};

}  // namespace icome::geometry
