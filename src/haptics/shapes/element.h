#pragma once
#include <cstdint>
#include <limits>
#include <optional>

#include "base/vector.h"
#include "geometry/smooth_surface.h"

namespace icome::haptics {

using base::Bounds;
using base::Pose;
using base::Vector3;

/// Lengths below which the contact arithmetic does not distinguish. They follow from the size of the
/// touched object, never from a unit or from objects far off: a mesh in metres and the same mesh in
/// millimetres feel alike, and a thing feels the same alone and beside a mountain.
struct Tolerance {
  /// m; the tip rests this far above a surface, so that its side is never in doubt.
  double gap = 0.0;

  /// For an object of this size (m): five orders above the rounding of double precision there and far below
  /// what any device resolves.
  static Tolerance for_size(double size) { return {1e-10 * size}; }
  /// The least tolerance for coordinates up to `largest` (m): some steps of their rounding.
  static Tolerance for_coordinates(double largest) { return {64.0 * 2.2e-16 * largest}; }

  /// The tolerance with a rim as wide as `distance` (m); below zero it lies inwards from the edges.
  static Tolerance reaching(double distance) { return {4.0 * distance}; }

  double touching() const { return 4.0 * gap; }  // heights up to this count as contact
  double behind() const { return 8.0 * gap; }    // further below than this is the other side
  double rim() const { return 0.25 * gap; }      // edges reach this far out: no cracks between neighbours
};

/// Depth, m, to which the straight way of a tip (radius in m) along a rounded edge may dip below a
/// thickened piece before the neighbouring face is asked: twice the height of a chord of 0.1 rad, the
/// longest that slide() takes. Boxes around pieces are tested with this margin.
constexpr double edge_dip(double tip) { return 0.0025 * tip; }

/// The foot on a smooth surface of a position of the tip, both in the surface's frame.
struct SmoothProjection {
  Vector3 of = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  geometry::SurfacePlace place = {Vector3::Zero(), Vector3::Zero()};
  double time = 0.0;  // s, the surface's
};

/// One smooth piece of a surface, thickened by the radius of the tip: it can hold the surface
/// contact point (SCP) at one side. A point tip has radius 0. A triangle with a sphere tip is a
/// triangular face, three rods (its edges) and three balls (its corners). Heights are distances of
/// the tip's centre to the thickened piece, positive on the free side (m). A plain value: shapes
/// make it, regions and contacts keep copies.
struct Element {
  enum class Kind : std::uint8_t {
    Plane,          // unlimited
    Triangle,       // u, v, w: inward edge normals in its plane; a, b, c: their offsets
    Parallelogram,  // u, v: unit axes in its plane; a, b: half lengths (a rectangle)
    Disc,           // a: its radius
    Rod,            // a cylinder of `radius` around axis, a: its length from origin
    Ball,           // of `radius` around origin
    Capsule,        // a rod with round ends
    Ring,           // a torus: tube of `radius` around the circle of radius a
    ConeSide,       // a: radius at origin, b: slant length, c: axial part of the outward normal
    Smooth,         // piece `feature` of `surface`, for a point tip; origin, u, v, axis: the surface's frame
  };

  Kind kind = Kind::Plane;
  bool two_sided = false;     // a sheet: whichever side the tip comes from holds it
  bool inverted = false;      // curved kinds felt from within; the normal points inwards
  bool guarded = false;       // a rod or ball of a mesh: holds only where away . u, v <= 0 and away . w >= 0
  std::uint32_t object = 0;   // index in the haptic scene
  std::uint32_t feature = 0;  // the shape's own number for the piece
  Vector3 origin = Vector3::Zero();
  Vector3 axis = Vector3::UnitZ();  // unit: normal of a flat piece, axis of a round one
  Vector3 u = Vector3::Zero();
  Vector3 v = Vector3::Zero();
  Vector3 w = Vector3::Zero();
  double a = 0.0, b = 0.0, c = 0.0;
  double radius = 0.0;  // m, of the thickened piece; for flat kinds the tip's radius
  double tip = 0.0;     // m, the tip's radius
  const geometry::SmoothSurface* surface = nullptr;  // of Smooth; its shape keeps it alive
  double time = 0.0;                                 // s, of Smooth: the surface's own time
  SmoothProjection here, ahead;                      // of Smooth: found last, starts of the next searches

  bool flat() const { return kind <= Kind::Disc; }
  /// Is every tangent plane free of the piece?
  bool convex() const { return !inverted && kind != Kind::Ring && kind != Kind::Smooth; }
  bool smooth() const { return kind == Kind::Smooth; }
};

// All of the following: positions of the tip's centre in the element's frame, m. Real-time safe.

/// Signed distance to the (extended) thickened piece; positive on the free side.
double height(const Element& element, const Vector3& position);

/// Height and normal together: for a smooth surface, half the work of asking twice.
struct Footing {
  double height;
  Vector3 normal;
  bool sure = true;  // `position` was near enough to follow a smooth surface there
};
Footing footing(const Element& element, const Vector3& position);

/// Unit normal at `position`, towards the free side.
Vector3 normal(const Element& element, const Vector3& position);

/// Does the piece itself, not only its extension, lie under `position`?
bool covers(const Element& element, const Vector3& position, const Tolerance& tolerance);

/// An edge of a flat piece: the distance (m) of a position inwards from it, and the unit direction that
/// leads out over it, in the piece's plane.
struct Rim {
  double inside = std::numeric_limits<double>::infinity();
  Vector3 outward = Vector3::Zero();
};

/// The edge nearest to `position`; infinitely far off for a piece that has no edges or is not flat.
Rim nearest_rim(const Element& element, const Vector3& position);

/// The point `gap` above the extended piece that is nearest to `position`.
Vector3 settle(const Element& element, const Vector3& position, const Tolerance& tolerance);

/// The next place of a tip that rests at `from` on the piece when `goal` pulls it: the nearest
/// point if that is close by along the surface, else a step towards it that is free of the piece.
Vector3 slide(const Element& element, const Vector3& from, const Vector3& goal, const Tolerance& tolerance);

/// The piece as felt from `position`: a two-sided one turned so that its free side is there.
Element facing(const Element& element, const Vector3& position);

/// The first t in [0, 1] at which a tip's centre that moves from `start` by t * `step` comes to rest
/// on the piece, felt from `start`; nothing if it does not. Not for smooth ones (smooth_sweep).
std::optional<double> sweep(const Element& element, const Vector3& start, const Vector3& step,
                            const Tolerance& tolerance);

/// Do both describe the same thickened surface (a shared edge or corner counts once)?
bool same_surface(const Element& one, const Element& other);

Element transformed(const Pose& to_from, const Element& element);

}  // namespace icome::haptics
