#pragma once
#include <string_view>
#include <variant>

#include "base/result.h"
#include "geometry/triangle_mesh.h"

namespace icome::geometry {

// Each primitive stands centred in its own frame, its axis along z. Lengths in metres.

/// The half-space z <= 0; its surface is the plane z = 0, free side +z.
struct Plane {};
/// A box with the given half extents, > 0.
struct Box {
  Vector3 half;
};
struct Sphere {
  double radius;
};
/// A solid cylinder, z in [-height/2, height/2].
struct Cylinder {
  double radius, height;
};
/// A cone or frustum: `bottom_radius` at z = -height/2, `top_radius` at z = +height/2; one may be 0.
struct Cone {
  double bottom_radius, top_radius, height;
};
/// A ring: circle of `major_radius` in the plane z = 0, swept by a disc of `minor_radius` < major.
struct Torus {
  double major_radius, minor_radius;
};
/// A cylinder of `height` (between the centres of its caps) with hemispheres of `radius` on it.
struct Capsule {
  double radius, height;
};

using Primitive = std::variant<Plane, Box, Sphere, Cylinder, Cone, Torus, Capsule>;

/// A point of a surface and the unit normal there, pointing out of the solid.
struct SurfacePoint {
  Vector3 point;
  Vector3 normal;
};

// The three questions of thesis section 5.5 that make a shape usable in a CSG tree, in closed form.

/// Is the point inside the solid or on its surface? Real-time safe.
bool inside(const Primitive& primitive, const Vector3& point);

/// The surface point nearest to `point`, which lies inside: what the outside surface answers to a
/// tip that has entered (5.3.2, figure 5.10(a)). Real-time safe.
SurfacePoint scp_from_inside(const Primitive& primitive, const Vector3& point);

/// The surface point nearest to `point`, which lies outside: what the inside surface answers to a
/// tip that has left the solid's hollow. Space is divided into one region for each face, edge and
/// vertex (5.5.3: 27 for a box, 6 for a cylinder); on edges and vertices the normal points from the
/// surface point to `point`. Real-time safe.
SurfacePoint scp_from_outside(const Primitive& primitive, const Vector3& point);

/// Distance from `point` to the surface, negative inside. Exact everywhere. Real-time safe.
double signed_distance(const Primitive& primitive, const Vector3& point);

/// The box around the solid; for a plane, a box of infinite extent below z = 0.
Bounds bounds(const Primitive& primitive);

/// Reads "box:0.1x0.2x0.3" (full sizes), "sphere:R", "cylinder:RxH", "cone:RxH" or "cone:R1xR2xH",
/// "torus:RxR", "capsule:RxH", "plane". The error names what was expected.
base::Result<Primitive> parse_primitive(std::string_view text);

/// A closed mesh of the primitive that deviates at most `tolerance` metres from it, for pictures and
/// far views; a plane becomes a square of 0.2 m.
TriangleMesh tessellate(const Primitive& primitive, double tolerance);

}  // namespace icome::geometry
