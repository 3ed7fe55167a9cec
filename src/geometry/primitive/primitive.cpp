#include "geometry/primitive/primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "base/parse_number.h"

namespace icome::geometry {
namespace {

// ---- Nearest surface point -------------------------------------------------------------------

/// The nearest surface point and the signed distance to it, negative inside.
struct Nearest {
  SurfacePoint surface;
  double distance;
};

template <typename Vector>
struct Polar {
  Vector direction;
  double length;
};

/// Length and unit direction of a vector, `fallback` for zero. Scaled first, so that a vector of the
/// smallest or largest numbers does not under- or overflow when squared.
template <typename Vector>
Polar<Vector> polar(const Vector& vector, const Vector& fallback) {
  const double scale = vector.cwiseAbs().maxCoeff();
  if (scale == 0.0) return {fallback, 0.0};
  const Vector scaled = vector / scale;
  const double norm = scaled.norm();
  return {scaled / norm, scale * norm};
}

/// A point of space as seen by a solid of revolution: (rho, z) in the half-plane through the axis and
/// the point, and the direction of that half-plane, +x for a point on the axis. The nearest point of
/// such a solid lies in the same half-plane, which leaves a problem in two dimensions.
struct Meridian {
  Vector2 position;
  Vector2 direction;
};

Meridian meridian(const Vector3& point) {
  const auto radial = polar<Vector2>(point.head<2>(), Vector2::UnitX());
  return {{radial.length, point.z()}, radial.direction};
}

/// The counterpart of Nearest in the half-plane.
struct ProfileNearest {
  Vector2 point;
  Vector2 normal;
  double distance;
};

Vector3 lift(const Vector2& profile, const Vector2& direction) {
  return {profile.x() * direction.x(), profile.x() * direction.y(), profile.y()};
}

Nearest lift(const ProfileNearest& nearest, const Vector2& direction) {
  return {{lift(nearest.point, direction), lift(nearest.normal, direction)}, nearest.distance};
}

Nearest nearest_on(const Plane&, const Vector3& point) {
  return {{{point.x(), point.y(), 0.0}, Vector3::UnitZ()}, point.z()};
}

/// The face pyramids of figure 5.10(a). A point on the surface gets the mean of the faces it is on.
Nearest nearest_from_inside(const Box& box, const Vector3& point) {
  const Vector3 depth = box.half - point.cwiseAbs();
  Eigen::Index axis = 0;
  const double least = depth.minCoeff(&axis);
  Vector3 on_face = point;
  on_face[axis] = std::copysign(box.half[axis], point[axis] + 0.0);
  Vector3 normal = Vector3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (i == axis || (least == 0.0 && depth[i] == 0.0)) normal[i] = std::copysign(1.0, point[i] + 0.0);
  }
  return {{on_face, normal.normalized()}, -least};
}

/// The regions of faces, edges and vertices (5.5.3): clamping moves 1, 2 or 3 coordinates.
Nearest nearest_on(const Box& box, const Vector3& point) {
  const Vector3 clamped = point.cwiseMax(-box.half).cwiseMin(box.half);
  if (clamped == point) return nearest_from_inside(box, point);
  const auto away = polar<Vector3>(point - clamped, Vector3::UnitX());
  return {{clamped, away.direction}, away.length};
}

Nearest nearest_on(const Sphere& sphere, const Vector3& point) {
  const auto away = polar<Vector3>(point, Vector3::UnitZ());
  return {{sphere.radius * away.direction, away.direction}, away.length - sphere.radius};
}

Nearest nearest_on(const Capsule& capsule, const Vector3& point) {
  const Vector3 core(0.0, 0.0, std::clamp(point.z(), -capsule.height / 2, capsule.height / 2));
  const auto away = polar<Vector3>(point - core, Vector3::UnitX());
  return {{core + capsule.radius * away.direction, away.direction}, away.length - capsule.radius};
}

Nearest nearest_on(const Torus& torus, const Vector3& point) {
  const Meridian at = meridian(point);
  const Vector2 core(torus.major_radius, 0.0);
  const auto away = polar<Vector2>(at.position - core, Vector2::UnitY());
  const ProfileNearest nearest{core + torus.minor_radius * away.direction, away.direction,
                               away.length - torus.minor_radius};
  return lift(nearest, at.direction);
}

/// A point of the half-plane measured against the three lines that bound a frustum's profile:
/// distances above them (positive outside), and the position along the slanted side, 0 at the bottom
/// corner and `side_length` at the top one.
struct FrustumSides {
  Vector2 bottom_corner, top_corner;
  Vector2 side_direction, side_normal;
  double side_length;
  double below, above, beside, along;
};

FrustumSides measure(const Cone& cone, const Vector2& at) {
  FrustumSides sides;
  sides.bottom_corner = {cone.bottom_radius, -cone.height / 2};
  sides.top_corner = {cone.top_radius, cone.height / 2};
  const auto side = polar<Vector2>(sides.top_corner - sides.bottom_corner, Vector2::UnitY());
  sides.side_direction = side.direction;
  sides.side_normal = {side.direction.y(), -side.direction.x()};
  sides.side_length = side.length;
  sides.below = sides.bottom_corner.y() - at.y();
  sides.above = at.y() - sides.top_corner.y();
  // The products cancel to exactly zero at both corners; with the unit normal they would not.
  const Vector2 offset = at - sides.bottom_corner;
  const double taper = cone.bottom_radius - cone.top_radius;
  sides.beside = (cone.height * offset.x() + taper * offset.y()) / side.length;
  sides.along = side.direction.dot(offset);
  return sides;
}

/// The normal for a point on a corner itself: the mean of side and cap, on an apex the axis.
Vector2 corner_normal(const Vector2& corner, const Vector2& side_normal, const Vector2& cap_normal) {
  if (corner.x() == 0.0) return cap_normal;
  return (side_normal + cap_normal).normalized();
}

ProfileNearest nearest_from_inside(const FrustumSides& sides, const Vector2& at) {
  const Vector2 up = Vector2::UnitY();
  if (sides.beside == 0.0 && sides.below == 0.0) {
    return {at, corner_normal(sides.bottom_corner, sides.side_normal, -up), 0.0};
  }
  if (sides.beside == 0.0 && sides.above == 0.0) {
    return {at, corner_normal(sides.top_corner, sides.side_normal, up), 0.0};
  }
  if (sides.beside >= sides.below && sides.beside >= sides.above) {
    const double along = std::clamp(sides.along, 0.0, sides.side_length);
    return {sides.bottom_corner + along * sides.side_direction, sides.side_normal, sides.beside};
  }
  if (sides.above >= sides.below) {
    return {{std::min(at.x(), sides.top_corner.x()), sides.top_corner.y()}, up, sides.above};
  }
  return {{std::min(at.x(), sides.bottom_corner.x()), sides.bottom_corner.y()}, -up, sides.below};
}

/// The five outside regions of 5.5.3: two caps, the side, and the two circles between them.
ProfileNearest nearest_from_outside(const FrustumSides& sides, const Vector2& at) {
  const Vector2 up = Vector2::UnitY();
  if (sides.above > 0.0 && at.x() <= sides.top_corner.x()) {
    return {{at.x(), sides.top_corner.y()}, up, sides.above};
  }
  if (sides.below > 0.0 && at.x() <= sides.bottom_corner.x()) {
    return {{at.x(), sides.bottom_corner.y()}, -up, sides.below};
  }
  if (sides.along >= 0.0 && sides.along <= sides.side_length) {
    return {sides.bottom_corner + sides.along * sides.side_direction, sides.side_normal, sides.beside};
  }
  const Vector2& corner = sides.along < 0.0 ? sides.bottom_corner : sides.top_corner;
  const auto away = polar<Vector2>(at - corner, up);
  return {corner, away.direction, away.length};
}

Nearest nearest_on(const Cone& cone, const Vector3& point) {
  const Meridian at = meridian(point);
  const FrustumSides sides = measure(cone, at.position);
  const bool within = sides.below <= 0.0 && sides.above <= 0.0 && sides.beside <= 0.0;
  return lift(within ? nearest_from_inside(sides, at.position) : nearest_from_outside(sides, at.position),
              at.direction);
}

Nearest nearest_on(const Cylinder& cylinder, const Vector3& point) {
  return nearest_on(Cone{cylinder.radius, cylinder.radius, cylinder.height}, point);
}

Nearest nearest_on(const Primitive& primitive, const Vector3& point) {
  return std::visit([&](const auto& shape) { return nearest_on(shape, point); }, primitive);
}

// ---- Bounds ----------------------------------------------------------------------------------

Vector3 half_extent(const Box& box) { return box.half; }
Vector3 half_extent(const Sphere& sphere) { return Vector3::Constant(sphere.radius); }
Vector3 half_extent(const Cylinder& cylinder) {
  return {cylinder.radius, cylinder.radius, cylinder.height / 2};
}
Vector3 half_extent(const Cone& cone) {
  const double radius = std::max(cone.bottom_radius, cone.top_radius);
  return {radius, radius, cone.height / 2};
}
Vector3 half_extent(const Torus& torus) {
  const double radius = torus.major_radius + torus.minor_radius;
  return {radius, radius, torus.minor_radius};
}
Vector3 half_extent(const Capsule& capsule) {
  return {capsule.radius, capsule.radius, capsule.height / 2 + capsule.radius};
}

template <typename Shape>
Bounds bounds_of(const Shape& shape) {
  const Vector3 half = half_extent(shape);
  return {-half, half};
}

Bounds bounds_of(const Plane&) {
  const double infinity = std::numeric_limits<double>::infinity();
  return {Vector3::Constant(-infinity), Vector3(infinity, infinity, 0.0)};
}

// ---- Text ------------------------------------------------------------------------------------

constexpr double kSmallestSize = 1e-9;  // metres
constexpr double kLargestSize = 1e6;    // metres

/// The written form of a primitive, and the numbers of sizes that it may have.
struct Form {
  std::string_view kind;
  std::string_view usage;
  std::size_t fewest, most;
};

constexpr std::array<Form, 7> kForms{{
    {"plane", "plane", 0, 0},
    {"box", "box:XxYxZ", 3, 3},
    {"sphere", "sphere:RADIUS", 1, 1},
    {"cylinder", "cylinder:RADIUSxHEIGHT", 2, 2},
    {"cone", "cone:RADIUSxHEIGHT or cone:BOTTOM_RADIUSxTOP_RADIUSxHEIGHT", 2, 3},
    {"torus", "torus:MAJOR_RADIUSxMINOR_RADIUS", 2, 2},
    {"capsule", "capsule:RADIUSxHEIGHT", 2, 2},
}};

const Form* find_form(std::string_view kind) {
  const auto form = std::find_if(kForms.begin(), kForms.end(), [&](const Form& f) { return f.kind == kind; });
  return form == kForms.end() ? nullptr : &*form;
}

std::string all_usages() {
  std::string usages;
  for (const Form& form : kForms) {
    if (!usages.empty()) usages += ", ";
    usages += form.usage;
  }
  return usages;
}

/// The number that the whole of `text` spells, or nothing.
std::optional<double> parse_size(std::string_view text) {
  const auto read = base::number_at_front<double>(text);
  if (!read.is_all()) return std::nullopt;
  // A number beyond the range of a double is still a number: the check of sizes reports it.
  return read.good() ? read.value : std::numeric_limits<double>::infinity();
}

/// Reads numbers between 'x's. The error is the middle of a sentence: the faulty part and its fault.
base::Result<std::vector<double>> parse_sizes(std::string_view text) {
  std::vector<double> sizes;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('x', begin), text.size());
    const std::string_view part = text.substr(begin, end - begin);
    const std::optional<double> size = parse_size(part);
    if (!size) return base::fail(fmt::format("\"{}\" is not a number", part));
    sizes.push_back(*size);
    begin = end + 1;
  }
  return sizes;
}

/// The complaint about sizes that do not make the shape, empty if there is none.
std::string wrong_sizes(const Form& form, const std::vector<double>& sizes) {
  if (sizes.size() < form.fewest || sizes.size() > form.most) {
    return fmt::format("{} size{} found", sizes.size(), sizes.size() == 1 ? "" : "s");
  }
  const bool frustum = form.kind == "cone" && sizes.size() == 3;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const bool pointed = frustum && i < 2 && sizes[i] == 0.0 && sizes[1 - i] != 0.0;
    // Written so that NaN, for which every comparison is false, is refused.
    if (!pointed && !(sizes[i] >= kSmallestSize && sizes[i] <= kLargestSize)) {
      return fmt::format("a size must lie between {} and {} metres, not {}", kSmallestSize, kLargestSize,
                         sizes[i]);
    }
  }
  if (form.kind == "torus" && sizes[1] >= sizes[0]) {
    return "the minor radius must be less than the major radius";
  }
  return {};
}

/// Precondition: wrong_sizes found nothing.
Primitive make_primitive(const Form& form, const std::vector<double>& sizes) {
  if (form.kind == "box") return Box{Vector3(sizes[0], sizes[1], sizes[2]) / 2};
  if (form.kind == "sphere") return Sphere{sizes[0]};
  if (form.kind == "cylinder") return Cylinder{sizes[0], sizes[1]};
  if (form.kind == "cone" && sizes.size() == 2) return Cone{sizes[0], 0.0, sizes[1]};
  if (form.kind == "cone") return Cone{sizes[0], sizes[1], sizes[2]};
  if (form.kind == "torus") return Torus{sizes[0], sizes[1]};
  if (form.kind == "capsule") return Capsule{sizes[0], sizes[1]};
  return Plane{};
}

std::string name_of(const Plane&) { return "plane"; }
std::string name_of(const Box& box) {
  return fmt::format("box:{}x{}x{}", 2 * box.half.x(), 2 * box.half.y(), 2 * box.half.z());
}
std::string name_of(const Sphere& sphere) { return fmt::format("sphere:{}", sphere.radius); }
std::string name_of(const Cylinder& cylinder) {
  return fmt::format("cylinder:{}x{}", cylinder.radius, cylinder.height);
}
std::string name_of(const Cone& cone) {
  if (cone.top_radius == 0.0) return fmt::format("cone:{}x{}", cone.bottom_radius, cone.height);
  return fmt::format("cone:{}x{}x{}", cone.bottom_radius, cone.top_radius, cone.height);
}
std::string name_of(const Torus& torus) {
  return fmt::format("torus:{}x{}", torus.major_radius, torus.minor_radius);
}
std::string name_of(const Capsule& capsule) {
  return fmt::format("capsule:{}x{}", capsule.radius, capsule.height);
}

// ---- Tessellation ----------------------------------------------------------------------------

constexpr double kMostTriangles = 2e6;
constexpr double kFewestAround = 8;
constexpr double kFewestAlong = 4;

/// Chords around a circle that stay within `tolerance` of it: the sagitta r(1 - cos(b/2)) of a chord
/// over the angle b is 2r sin^2(b/4).
double chords(double radius, double tolerance) {
  const double angle = 4 * std::asin(std::sqrt(std::min(1.0, tolerance / (2 * radius))));
  // Bounded before it is used in products; the most triangles could not be reached with more.
  return std::clamp(std::ceil(2 * std::numbers::pi / angle), kFewestAround, kMostTriangles);
}

/// Quads of a grid, around the axis and along the profile; each is two triangles.
struct Grid {
  int around, along;
};

/// Coarsens a grid that has too many triangles, both ways alike. `along` is a multiple of `step`, and
/// stays one.
Grid limited(double around, double along, int step) {
  const double excess = std::max(1.0, 2 * around * along / kMostTriangles);
  const double bands = std::max(kFewestAlong, step * std::floor(along / std::sqrt(excess) / step));
  return {static_cast<int>(std::min(around, std::floor(kMostTriangles / 2 / bands))),
          static_cast<int>(bands)};
}

/// One circle of vertices, or a single vertex where the profile meets the axis.
struct Ring {
  std::uint32_t first;
  bool single;

  std::uint32_t vertex(std::uint32_t j) const { return single ? first : first + j; }
};

std::vector<Ring> add_rings(const std::vector<Vector2>& profile, int around, TriangleMesh& mesh) {
  std::vector<Vector2> directions(around);
  for (int j = 0; j < around; ++j) {
    const double angle = 2 * std::numbers::pi * j / around;
    directions[j] = {std::cos(angle), std::sin(angle)};
  }
  std::vector<Ring> rings;
  for (const Vector2& at : profile) {
    rings.push_back({static_cast<std::uint32_t>(mesh.positions.size()), at.x() == 0.0});
    const int count = rings.back().single ? 1 : around;
    for (int j = 0; j < count; ++j) mesh.positions.push_back(lift(at, directions[j]));
  }
  return rings;
}

void add_band(const Ring& lower, const Ring& upper, std::uint32_t around, TriangleMesh& mesh) {
  for (std::uint32_t j = 0; j < around; ++j) {
    const std::uint32_t next = j + 1 == around ? 0 : j + 1;
    if (!lower.single) mesh.triangles.push_back({lower.vertex(j), lower.vertex(next), upper.vertex(next)});
    if (!upper.single) mesh.triangles.push_back({lower.vertex(j), upper.vertex(next), upper.vertex(j)});
  }
}

/// Turns a profile of (rho, z) about the z axis. It runs with the solid on its left hand side, so
/// upwards along the outside; it begins and ends on the axis, or is joined end to beginning.
TriangleMesh revolve(const std::vector<Vector2>& profile, int around, bool joined) {
  TriangleMesh mesh;
  mesh.positions.reserve(profile.size() * around);
  mesh.triangles.reserve(2 * profile.size() * around);
  const std::vector<Ring> rings = add_rings(profile, around, mesh);
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) add_band(rings[i], rings[i + 1], around, mesh);
  if (joined) add_band(rings.back(), rings.front(), around, mesh);
  return mesh;
}

/// Appends a quarter circle from angle `quarter` * pi/2, both ends included, ends exact on the axis.
void add_quarter(const Vector2& centre, double radius, int quarter, int steps,
                 std::vector<Vector2>& profile) {
  for (int i = 0; i <= steps; ++i) {
    const bool pole = quarter < 0 ? i == 0 : i == steps;
    const double angle = std::numbers::pi / 2 * (quarter + static_cast<double>(i) / steps);
    const Vector2 unit =
        pole ? Vector2(0.0, quarter < 0 ? -1.0 : 1.0) : Vector2(std::cos(angle), std::sin(angle));
    profile.push_back(centre + radius * unit);
  }
}

TriangleMesh mesh_of(const Plane&, double) {
  return {{{-0.1, -0.1, 0.0}, {0.1, -0.1, 0.0}, {0.1, 0.1, 0.0}, {-0.1, 0.1, 0.0}}, {{0, 1, 2}, {0, 2, 3}}};
}

TriangleMesh mesh_of(const Box& box, double) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vector3 sign(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
    mesh.positions.push_back(sign.cwiseProduct(box.half));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// A surface curved both ways may deviate around the axis and along the profile at once, and the two
// add up at most: each gets half of the tolerance.

TriangleMesh mesh_of(const Capsule& capsule, double tolerance) {
  const double around = chords(capsule.radius, tolerance / 2);
  const Grid grid = limited(around, 2 * std::ceil(around / 4), 2);
  const bool is_sphere = capsule.height == 0.0;
  std::vector<Vector2> profile;
  add_quarter({0.0, -capsule.height / 2}, capsule.radius, -1, grid.along / 2, profile);
  if (is_sphere) profile.pop_back();  // the equator, once
  add_quarter({0.0, capsule.height / 2}, capsule.radius, 0, grid.along / 2, profile);
  return revolve(profile, grid.around, false);
}

TriangleMesh mesh_of(const Sphere& sphere, double tolerance) {
  return mesh_of(Capsule{sphere.radius, 0.0}, tolerance);
}

TriangleMesh mesh_of(const Torus& torus, double tolerance) {
  const Grid grid = limited(chords(torus.major_radius + torus.minor_radius, tolerance / 2),
                            chords(torus.minor_radius, tolerance / 2), 1);
  std::vector<Vector2> profile;
  for (int i = 0; i < grid.along; ++i) {
    const double angle = 2 * std::numbers::pi * i / grid.along;
    profile.push_back(
        {torus.major_radius + torus.minor_radius * std::cos(angle), torus.minor_radius * std::sin(angle)});
  }
  return revolve(profile, grid.around, true);
}

TriangleMesh mesh_of(const Cone& cone, double tolerance) {
  const double around = chords(std::max(cone.bottom_radius, cone.top_radius), tolerance);
  std::vector<Vector2> profile{{0.0, -cone.height / 2}};
  if (cone.bottom_radius > 0.0) profile.push_back({cone.bottom_radius, -cone.height / 2});
  if (cone.top_radius > 0.0) profile.push_back({cone.top_radius, cone.height / 2});
  profile.push_back({0.0, cone.height / 2});
  return revolve(profile, static_cast<int>(std::min(around, kMostTriangles / 4)), false);
}

TriangleMesh mesh_of(const Cylinder& cylinder, double tolerance) {
  return mesh_of(Cone{cylinder.radius, cylinder.radius, cylinder.height}, tolerance);
}

}  // namespace

bool inside(const Primitive& primitive, const Vector3& point) {
  return signed_distance(primitive, point) <= 0.0;
}

// For these shapes the nearest surface point is the answer of both sections: the face pyramids inside,
// the regions of faces, edges and vertices outside.

SurfacePoint scp_from_inside(const Primitive& primitive, const Vector3& point) {
  return nearest_on(primitive, point).surface;
}

SurfacePoint scp_from_outside(const Primitive& primitive, const Vector3& point) {
  return nearest_on(primitive, point).surface;
}

double signed_distance(const Primitive& primitive, const Vector3& point) {
  return nearest_on(primitive, point).distance;
}

Bounds bounds(const Primitive& primitive) {
  return std::visit([](const auto& shape) { return bounds_of(shape); }, primitive);
}

base::Result<Primitive> parse_primitive(std::string_view text) {
  const std::size_t colon = text.find(':');
  const Form* form = find_form(text.substr(0, colon));
  if (form == nullptr) {
    return base::fail(
        fmt::format("\"{}\" is not a primitive: expected one of {}, sizes in metres", text, all_usages()));
  }
  const auto refuse = [&](const std::string& complaint) {
    return base::fail(fmt::format("\"{}\": {}; expected {}{}", text, complaint, form->usage,
                                  form->most == 0 ? " without sizes" : ", sizes in metres"));
  };
  std::vector<double> sizes;
  if (colon != std::string_view::npos) {
    auto parsed = parse_sizes(text.substr(colon + 1));
    if (!parsed) return refuse(parsed.error().message);
    sizes = std::move(*parsed);
  }
  if (const std::string complaint = wrong_sizes(*form, sizes); !complaint.empty()) return refuse(complaint);
  return make_primitive(*form, sizes);
}

std::string name(const Primitive& primitive) {
  return std::visit([](const auto& shape) { return name_of(shape); }, primitive);
}

TriangleMesh tessellate(const Primitive& primitive, double tolerance) {
  assert(tolerance > 0.0);
  return std::visit([&](const auto& shape) { return mesh_of(shape, tolerance); }, primitive);
}

}  // namespace icome::geometry
