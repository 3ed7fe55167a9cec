#pragma once
#include <memory>
#include <string>

#include "base/result.h"
#include "geometry/contour/dual_contouring.h"
#include "geometry/smooth_surface.h"

namespace icome::geometry {

/// The surface f(x, y, z, t) = 0 of a formula (see formula.h), solid where f < 0, within a box (thesis
/// 8.1.2). Lengths in metres, t in seconds. Gradients by automatic differentiation, sweeps by interval
/// arithmetic: nothing is sampled, so nothing is missed. The box cuts the solid off with flat sides. Where
/// the formula has no value, there is nothing; where it begins to have negative ones, or jumps to them (at a
/// pole), the solid ends in a wall.
///
/// By the choices of abs, min, max and if, the surface consists of pieces, each smooth, that meet in edges
/// and grooves, as faces of a CSG solid do. Piece 0 is the first of them, or all of a smooth formula's
/// surface; it goes on beyond its edges and the box (covers() knows), as the others do, which are pieces 7,
/// 8, ..., with walls the last. Pieces 1 to 6 are the sides of the box towards -x, +x, -y, +y, -z, +z where
/// they bound the solid.
class ImplicitSurface final : public SmoothSurface {
 public:
  /// Fails on a formula that cannot be read, naming the column, on an empty or infinite box, and if there
  /// is surely no surface in the box.
  static base::Result<std::shared_ptr<const ImplicitSurface>> create(const std::string& formula,
                                                                     const Bounds& box);
  ~ImplicitSurface() override;

  /// The value of f, and its exact gradient (with respect to x, y, z; where abs, min and max change, of one
  /// side). Real-time safe.
  struct Value {
    double value;
    Vector3 gradient;
    double rate;  // df/dt
  };
  Value value(const Vector3& point, double time) const;
  /// The value alone, which is quicker. Real-time safe.
  double value_at(const Vector3& point, double time) const;

  /// The box that cuts the solid off; bounds() may be tighter.
  const Bounds& box() const { return box_; }

  Bounds bounds() const override;
  void near(const Vector3& a, const Vector3& b, double reach, double time, PieceVisitor visit) const override;
  bool inside(const Vector3& point, double time = 0.0) const override;
  bool knows_inside_quickly() const override { return true; }
  std::optional<SurfacePlace> way_out(const Vector3& point, double time) const override;
  std::optional<SurfaceHit> first_hit(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                      bool from_behind, double time, double slack) const override;
  SurfacePlace nearest_local(const SurfacePlace& from, const Vector3& goal, double time) const override;
  bool covers(const SurfacePlace& place, const Vector3& above, double time, double slack) const override;
  bool changes() const override;
  double normal_speed(const SurfacePlace& place, double time) const override;
  std::size_t bytes() const override;

 private:
  struct Parts;
  ImplicitSurface(std::unique_ptr<const Parts> parts, const Bounds& box);
  std::optional<SurfaceHit> hit_of_formula(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                           bool from_behind, double time, double slack) const;
  std::optional<SurfaceHit> hit_of_side(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                        bool from_behind, double time, double slack) const;

  std::unique_ptr<const Parts> parts_;
  Bounds box_;
};

/// Is some of it solid at that time? Tests some thousand places, between which a small solid may be missed.
bool shows_solid(const ImplicitSurface& surface, double time);

/// The solid at one time, for meshing; `surface` outlives it.
SampledSolid sampled(const ImplicitSurface& surface, double time);

}  // namespace icome::geometry
