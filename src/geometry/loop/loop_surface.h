#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"
#include "geometry/smooth_surface.h"

namespace icome::geometry {

class LoopPatches;

/// A control mesh with the edges and vertices that stay sharp. Sharpness is all or nothing.
struct ControlMesh {
  TriangleMesh mesh;                                  // any topology; edges with three triangles are refused
  std::vector<std::array<std::uint32_t, 2>> creases;  // edges, by their vertices
  std::vector<std::uint32_t> corners;                 // vertices that the surface keeps in place
};

/// The limit of Loop's subdivision (1987) of a control mesh, evaluated exactly: quartic box splines on
/// regular faces, powers of the local subdivision matrix (after Stam 1999) around extraordinary vertices
/// of any valence; boundaries are subdivision curves; creases and corners are sharp (Hoppe et al. 1994).
class LoopSurface final : public SmoothSurface {
 public:
  /// Fails with a sentence on meshes that are not a surface.
  static base::Result<std::shared_ptr<const LoopSurface>> create(const ControlMesh& control);
  ~LoopSurface() override;

  /// The limit on a triangle of the control mesh at barycentric (1 - u - v, u, v) of its corners.
  struct Sample {
    Vector3 point;
    Vector3 du, dv;  // tangents with respect to u and v (zero only where the surface is degenerate)
    Vector3 normal;  // unit, by du x dv or, at extraordinary vertices, by the limit tangent masks
  };
  Sample sample(std::uint32_t control_triangle, double u, double v) const;

  /// The surface as triangles, `level` subdivisions fine (each control triangle gives 4^level), vertices
  /// on the limit surface: for pictures (level of detail) and export. Fails when that is too many.
  base::Result<TriangleMesh> tessellate(int level) const;

  bool closed() const;
  const LoopPatches& patches() const { return *patches_; }

  Bounds bounds() const override;
  void near(const Vector3& a, const Vector3& b, double reach, double time, PieceVisitor visit) const override;
  bool inside(const Vector3& point, double time = 0.0) const override;
  std::optional<SurfacePlace> way_out(const Vector3& point, double time) const override;
  std::optional<SurfaceHit> first_hit(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                      bool from_behind, double time, double slack) const override;
  SurfacePlace nearest_local(const SurfacePlace& from, const Vector3& goal, double time) const override;
  bool covers(const SurfacePlace& place, const Vector3& above, double time, double slack) const override;
  bool same(std::uint32_t one, std::uint32_t other) const override;
  std::size_t bytes() const override;

 private:
  explicit LoopSurface(std::unique_ptr<const LoopPatches> patches);
  std::unique_ptr<const LoopPatches> patches_;
};

}  // namespace icome::geometry
