#pragma once
#include <optional>

#include "haptics/shapes/shape.h"
#include "haptics/thesis/csg_renderer.h"
#include "haptics/thesis/loop_renderer.h"

namespace icome::haptics {

/// Memory for the renderers of the thesis, taken once; one thread uses it.
struct DirectWorkspace {
  CsgWorkspace csg;
  LoopWorkspace loop;
};

struct DirectAnswer {
  geometry::SurfacePoint place;
  bool converged = true;  // false: the renderer ran out of budget and holds the last SCP
};

/// A shape that finds its SCP itself, as in the thesis, instead of handing out elements. Only
/// ThesisSolver can touch it: it gives other solvers no elements.
class DirectShape : public Shape {
 public:
  /// The SCP when `tip` (in the shape's frame, m) is inside, else nothing. Updates `memory`, which belongs to
  /// one tip. Real-time safe.
  virtual std::optional<DirectAnswer> direct_scp(const Vector3& tip, DirectMemory& memory,
                                                 DirectWorkspace& space) const = 0;
  /// Real-time safe.
  virtual bool inside(const Vector3& point, DirectWorkspace& space) const = 0;

  void gather(const GatherRequest&, ElementSink&) const final {}
  std::optional<geometry::SurfacePoint> way_out(const Vector3&, double) const final { return std::nullopt; }
  std::optional<ShapeHit> cast(const Vector3&, const Vector3&, double) const final { return std::nullopt; }
};

}  // namespace icome::haptics
