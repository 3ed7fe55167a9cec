#pragma once
#include <memory>
#include <string>

#include "base/result.h"
#include "geometry/smooth_surface.h"

namespace icome::geometry {

/// The surface f(x, y, z, t) = 0 of a formula, solid where f < 0, within a box (thesis 8.1.2). Lengths in
/// metres, t in seconds. Gradients by automatic differentiation, sweeps by interval arithmetic: nothing is
/// sampled, so nothing is missed. The box cuts the solid off with flat sides.
class ImplicitSurface final : public SmoothSurface {
 public:
  /// Fails on a formula that cannot be read, naming the column, and on an empty or infinite box.
  static base::Result<std::shared_ptr<const ImplicitSurface>> create(const std::string& formula,
                                                                     const Bounds& box);
  ~ImplicitSurface() override;

  /// f there, and its exact gradient (with respect to x, y, z). Real-time safe.
  struct Value {
    double value;
    Vector3 gradient;
    double rate;  // df/dt
  };
  Value value(const Vector3& point, double time) const;

  Bounds bounds() const override;
  void near(const Vector3& a, const Vector3& b, double reach, double time, PieceVisitor visit) const override;
  bool inside(const Vector3& point, double time = 0.0) const override;
  std::optional<SurfacePlace> way_out(const Vector3& point, double time) const override;
  std::optional<SurfaceEntry> entry(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                    bool from_behind, double time, double slack) const override;
  SurfacePlace foot(const SurfacePlace& from, const Vector3& goal, double time) const override;
  bool covers(const SurfacePlace& place, const Vector3& above, double time, double slack) const override;
  bool changes() const override;
  double normal_speed(const SurfacePlace& place, double time) const override;
  std::size_t bytes() const override;

 private:
  class Formula;
  ImplicitSurface(std::unique_ptr<const Formula> formula, const Bounds& box);
  std::unique_ptr<const Formula> formula_;
  Bounds box_;
};

}  // namespace icome::geometry
