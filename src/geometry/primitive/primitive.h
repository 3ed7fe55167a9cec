#pragma once
#include <string>
#include <string_view>
#include <variant>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

// Each primitive stands centred in its own frame, its axis along z. Lengths in metres.

/// The half-space z <= 0; its surface is the plane z = 0, free side +z.
struct Plane {
  bool operator==(const Plane&) const = default;
};
/// A box with the given half extents, > 0.
struct Box {
  Vector3 half;

  bool operator==(const Box&) const = default;
};
struct Sphere {
  double radius;

  bool operator==(const Sphere&) const = default;
};
/// A solid cylinder, z in [-height/2, height/2].
struct Cylinder {
  double radius, height;

  bool operator==(const Cylinder&) const = default;
};
/// A cone or frustum: `bottom_radius` at z = -height/2, `top_radius` at z = +height/2; one may be 0.
struct Cone {
  double bottom_radius, top_radius, height;

  bool operator==(const Cone&) const = default;
};
/// A ring: circle of `major_radius` in the plane z = 0, swept by a disc of `minor_radius` < major.
struct Torus {
  double major_radius, minor_radius;

  bool operator==(const Torus&) const = default;
};
/// A cylinder of `height` (between the centres of its caps) with hemispheres of `radius` on it.
struct Capsule {
  double radius, height;

  bool operator==(const Capsule&) const = default;
};

using Primitive = std::variant<Plane, Box, Sphere, Cylinder, Cone, Torus, Capsule>;

/// A point of a surface and the unit normal there, pointing out of the solid.
struct SurfacePoint {
  Vector3 point;
  Vector3 normal;
};

// The three queries of thesis section 5.5 that make a shape usable in a CSG tree, in closed form.
// Precondition of all: sizes as parse_primitive accepts them, and a finite point.
// Rounding is a few units in the last place of the larger of the shape and the point's coordinates;
// there are no epsilons, so a shape in metres and the same in millimetres get the same answers.

/// Is the point inside the solid or on its surface? The same as signed_distance(...) <= 0.
/// Real-time safe.
bool inside(const Primitive& primitive, const Vector3& point);

/// The surface point nearest to `point`, which lies inside: the response of the outside surface to a
/// tip that has entered (5.3.2, figure 5.10(a)). The normal is that of the nearest face. Where
/// several are equally near, one is always chosen: +z at the centre of a sphere and on a torus's
/// core circle, +x on an axis of revolution, the first of x, y, z in a box. Real-time safe.
SurfacePoint scp_from_inside(const Primitive& primitive, const Vector3& point);

/// The surface point nearest to `point`, which lies outside: the response of the inside surface to a
/// tip that has left the solid's hollow. Space is divided into one region for each face, edge and
/// vertex (5.5.3: 27 for a box, 6 for a cylinder); on edges and vertices the normal points from the
/// surface point to `point`, and for a point on the edge or vertex itself it is the mean of the
/// adjoining faces' normals. Real-time safe.
///
/// Both functions return the nearest surface point whichever side `point` lies on, so that a caller
/// whose tip is within rounding of the surface may call either.
SurfacePoint scp_from_outside(const Primitive& primitive, const Vector3& point);

/// Distance from `point` to the surface in metres, negative inside. Exact everywhere. Real-time safe.
double signed_distance(const Primitive& primitive, const Vector3& point);

/// The box around the solid; for a plane, a box of infinite extent below z = 0.
Bounds bounds(const Primitive& primitive);

/// Reads "box:0.1x0.2x0.3" (full sizes), "sphere:R", "cylinder:RxH", "cone:RxH" or "cone:R1xR2xH"
/// (bottom, top; one may be 0), "torus:RxR" (major, minor), "capsule:RxH", "plane". Sizes are in
/// metres, from 1e-9 to 1e6. The error names what was expected.
base::Result<Primitive> parse_primitive(std::string_view text);

/// The text that parse_primitive reads back to the same bits, for reports.
std::string name(const Primitive& primitive);

/// A closed mesh of the primitive, vertices shared and triangles facing out, that deviates at most
/// `tolerance` metres (> 0) from it, for pictures and far views. It never has more than 2,000,000
/// triangles: a tolerance that asks for more gets the finest mesh within that. A plane becomes a
/// square of 0.2 m, which is open.
TriangleMesh tessellate(const Primitive& primitive, double tolerance);

}  // namespace icome::geometry
