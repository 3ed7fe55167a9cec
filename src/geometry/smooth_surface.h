#pragma once
#include <cstdint>
#include <optional>

#include "base/function_ref.h"
#include "geometry/primitive/primitive.h"

namespace icome::geometry {

/// A place of a smooth surface, in the surface's own frame.
struct SurfacePlace {
  Vector3 point;            // m
  Vector3 normal;           // unit, out of the solid (or towards the front of a sheet)
  std::uint32_t piece = 0;  // the number of the surface's piece that it lies on
  double u = 0.0, v = 0.0;  // the piece's own parameters there, where it has any
  bool reached = true;      // of a foot: true at the foot itself, false where the walk towards it stopped
};

/// A hit: the place at which a moving point goes through a surface.
struct SurfaceHit {
  double t;  // along the step, in [0, 1]
  SurfacePlace place;
};

/// A surface made of smooth pieces that can be touched directly, without a mesh: the faces of a CSG
/// solid, a subdivision surface's limit, an implicit surface. These few questions are all that finding
/// the surface contact point (SCP) needs. Immutable; all functions may be called from several threads.
///
/// `time` (s) matters only to surfaces that change with time. `slack` (m, >= 0) is the tolerance of
/// contact arithmetic, some 1e-11 of the surface's size: pieces reach this far beyond their edges, so
/// that neighbours leave no crack. Results must be exact to within a tenth of it; they need not be more
/// exact.
class SmoothSurface {
 public:
  virtual ~SmoothSurface() = default;

  /// Bounds of the surface at all times; infinite for an unlimited one.
  virtual Bounds bounds() const = 0;

  /// Calls `visit(piece, box)` for every piece that comes within `reach` of the segment from `a` to `b`,
  /// and perhaps for others, until it returns false; `box` encloses the piece (a large piece may be given
  /// as several visits with the same number and boxes of its parts). Real-time safe.
  using PieceVisitor = base::FunctionRef<bool(std::uint32_t piece, const Bounds& box)>;
  virtual void near(const Vector3& a, const Vector3& b, double reach, double time,
                    PieceVisitor visit) const = 0;

  /// Is the point inside the solid? Surfaces that enclose nothing have no inside. Real-time safe.
  virtual bool inside(const Vector3& point, double time) const = 0;

  /// Can inside() be asked in every tick, for a point tip? Then its SCP is kept out whatever else went wrong.
  virtual bool knows_inside_quickly() const { return false; }

  /// A place of the surface near `point`, which is inside: the nearest one, as nearly as can be told in
  /// some 100 us. Nothing when `point` is not inside. Real-time safe.
  virtual std::optional<SurfacePlace> way_out(const Vector3& point, double time) const = 0;

  /// The first place at which a point that moves from `start` by t * `step` goes through the piece from
  /// its front (outside) to behind it, t in [0, 1], and at which the piece belongs to the surface
  /// (covers). Must not miss one, however grazing: the tip would fall through. `from_behind` asks for
  /// passages from behind to the front instead (sheets that are touched from both sides).
  /// A start within `slack` of the surface counts as being on the side that it comes from: moving in is
  /// a hit at t = 0; moving out is no hit. Real-time safe.
  virtual std::optional<SurfaceHit> first_hit(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                              bool from_behind, double time, double slack) const = 0;

  /// Slides from `from` along the smooth surface that it lies on, downhill in the distance to `goal`, to
  /// where that distance has a local minimum, or as far as is sure: the walk never jumps to another sheet
  /// of the surface; `reached` says which. It goes beyond the edges of faces that have a natural extension (a
  /// sphere cut by a CSG tree), and stops at those that have none. `from.normal` need not be set, and `from`
  /// may lie a little off the surface (which may have changed with time). Real-time safe.
  virtual SurfacePlace nearest_local(const SurfacePlace& from, const Vector3& goal, double time) const = 0;

  /// Does the surface really run through `place`, which lies on the (extended) piece, or within `slack`
  /// of it? `above` is the tip's place, by which to tell whether it is still over the piece (a sheet ends
  /// at its rim). Real-time safe.
  virtual bool covers(const SurfacePlace& place, const Vector3& above, double time, double slack) const = 0;

  /// May a tip that rests on `one` be taken to have met `other` too (the same piece, or its smooth
  /// continuation next door)? Then sweeps need not look at it. Real-time safe.
  virtual bool same(std::uint32_t one, std::uint32_t other) const { return one == other; }

  /// Does the surface move or bend with time?
  virtual bool changes() const { return false; }

  /// The speed (m/s) at which the surface moves along its normal there. Real-time safe.
  virtual double normal_speed(const SurfacePlace& /*place*/, double /*time*/) const { return 0.0; }

  /// Memory held, in bytes.
  virtual std::size_t bytes() const = 0;
};

}  // namespace icome::geometry
