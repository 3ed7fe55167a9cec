#include "session/display/part_outlines.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <variant>

#include "geometry/csg/csg_leaf.h"

namespace icome::session {
namespace {

using base::Affine3;
using base::Bounds;
using base::Vector3;
using charts::Colour;
using geometry::TextureProjection;
using interaction::PlacedPart;

constexpr std::size_t kMostOutlines = 128;
constexpr std::size_t kMostOutlinedTriangles = 4096;  // of a mesh; of more the box is seen
constexpr double kSharpCosine = 0.906;                // an edge that bends by more than 25 degrees is seen
constexpr double kHalfSpaceSeen = 0.1;                // m, to each side, of what has no end
constexpr Colour kOperandColour{0.45, 0.30, 0.75, 0.9};
constexpr Colour kProjectorColour{0.80, 0.20, 0.55};
constexpr Colour kMarkedPartColour{1.0, 0.55, 0.10};
constexpr double kMarkedLine = 2.5;  // pixels

/// Lines along z, four round it, from one radius to another.
void draw_sides(double lower, double upper, double half, SymbolPen& pen) {
  for (const Vector3& out : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(-1, 0, 0), Vector3(0, -1, 0)})
    pen.line({lower * out - half * Vector3::UnitZ(), upper * out + half * Vector3::UnitZ()});
}

struct DrawPrimitive {
  SymbolPen& pen;

  void operator()(const geometry::Plane&) const {
    const double half = kHalfSpaceSeen;
    pen.line({{half, half, 0}, {-half, half, 0}, {-half, -half, 0}, {half, -half, 0}, {half, half, 0}});
    pen.line({{0, 0, 0}, {0, 0, 0.3 * half}});
  }
  void operator()(const geometry::Box& it) const { pen.box({-it.half, it.half}); }
  void operator()(const geometry::Sphere& it) const { pen.sphere(Vector3::Zero(), it.radius); }
  void operator()(const geometry::Cylinder& it) const {
    (*this)(geometry::Cone{it.radius, it.radius, it.height});
  }
  void operator()(const geometry::Cone& it) const {
    const Vector3 up = 0.5 * it.height * Vector3::UnitZ();
    if (it.bottom_radius > 0.0) pen.circle(-up, Vector3::UnitZ(), it.bottom_radius);
    if (it.top_radius > 0.0) pen.circle(up, Vector3::UnitZ(), it.top_radius);
    draw_sides(it.bottom_radius, it.top_radius, 0.5 * it.height, pen);
  }
  void operator()(const geometry::Torus& it) const {
    const Vector3 up = it.minor_radius * Vector3::UnitZ();
    pen.circle(Vector3::Zero(), Vector3::UnitZ(), it.major_radius + it.minor_radius);
    pen.circle(Vector3::Zero(), Vector3::UnitZ(), it.major_radius - it.minor_radius);
    for (const double side : {-1.0, 1.0}) pen.circle(side * up, Vector3::UnitZ(), it.major_radius);
    for (const double side : {-1.0, 1.0}) {
      pen.circle(side * it.major_radius * Vector3::UnitX(), Vector3::UnitY(), it.minor_radius);
      pen.circle(side * it.major_radius * Vector3::UnitY(), Vector3::UnitX(), it.minor_radius);
    }
  }
  void operator()(const geometry::Capsule& it) const {
    for (const double side : {-1.0, 1.0}) pen.sphere(0.5 * side * it.height * Vector3::UnitZ(), it.radius);
    draw_sides(it.radius, it.radius, 0.5 * it.height, pen);
  }
};

Vector3 normal_of_triangle(const geometry::TriangleMesh& mesh, std::size_t t) {
  return (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).normalized();
}

/// Draws the edges at which the mesh bends; its box where there is none to be seen.
void draw_mesh(const geometry::TriangleMesh& mesh, SymbolPen& pen) {
  std::size_t seen = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vector3> normals;  // of the triangle on one side
  for (std::size_t t = 0; mesh.triangles.size() <= kMostOutlinedTriangles && t < mesh.triangles.size(); ++t) {
    const Vector3 normal = normal_of_triangle(mesh, t);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]);
      const auto [other, fresh] = normals.try_emplace({low, high}, normal);
      if (fresh || !(other->second.dot(normal) < kSharpCosine)) continue;
      pen.line({mesh.positions[low], mesh.positions[high]});
      ++seen;
    }
  }
  if (seen == 0) pen.box(geometry::bounds(mesh));
}

struct DrawShape {
  SymbolPen& pen;

  void operator()(const geometry::Primitive& it) const { std::visit(DrawPrimitive{pen}, it); }
  void operator()(const std::shared_ptr<const geometry::MeshSolid>& it) const { draw_mesh(it->mesh, pen); }
  void operator()(const std::shared_ptr<const geometry::CsgPrimitive>& it) const { pen.box(it->bounds()); }
};

/// Draws the picture's place, an arrow head at its upper side, and the way along which it is thrown.
void draw_picture_place(SymbolPen& pen) {
  pen.line({{0.5, 0.5, 0}, {-0.5, 0.5, 0}, {-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}});
  pen.line({{-0.08, 0.5, 0}, {0, 0.6, 0}, {0.08, 0.5, 0}});
  pen.line({{0, 0, -0.5}, {0, 0, 0.5}});
}

/// Draws a sphere or a cylinder, with the seam where the picture begins and ends.
void draw_round_place(bool sphere, SymbolPen& pen) {
  if (sphere) {
    pen.sphere(Vector3::Zero(), 0.5);
  } else {
    for (const double side : {-0.5, 0.5}) pen.circle({0, 0, side}, Vector3::UnitZ(), 0.5);
    draw_sides(0.5, 0.5, 0.5, pen);
  }
  pen.line({{-0.5, 0, -0.5}, {-0.6, 0, 0}, {-0.5, 0, 0.5}});
  pen.line({{0, 0, 0.5}, {0, 0, 0.65}});
}

void draw_projector(TextureProjection projection, SymbolPen& pen) {
  if (projection == TextureProjection::Planar) return draw_picture_place(pen);
  if (projection != TextureProjection::Box)
    return draw_round_place(projection == TextureProjection::Spherical, pen);
  pen.box({Vector3::Constant(-0.5), Vector3::Constant(0.5)});
  pen.line({{-0.08, 0, 0.5}, {0, 0, 0.6}, {0.08, 0, 0.5}});
}

/// Joins all lines to one, which is drawn at once; places that are not finite separate them.
void join_lines(render::SceneOverlay& strokes) {
  if (strokes.lines.empty()) return;
  render::SceneOverlay::Line joined{{}, strokes.lines.front().colour, strokes.lines.front().width};
  for (const auto& line : strokes.lines) {
    joined.points.insert(joined.points.end(), line.points.begin(), line.points.end());
    joined.points.push_back(Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
  }
  strokes.lines = {std::move(joined)};
}

void move_strokes(render::SceneOverlay& strokes, const Affine3& motion) {
  for (auto& line : strokes.lines)
    for (Vector3& point : line.points) point = motion * point;
}

}  // namespace

void PartOutlines::renew(const world::World& world, world::SceneId shown,
                         std::span<const world::ObjectId> selection) {
  outlines_.clear();
  for (const PlacedPart& part : interaction::placed_parts(world, selection, kMostOutlines)) {
    const auto place = interaction::world_from_part(world, part);
    if (!place || !is_shown_in(world, shown, part.object)) continue;
    Outline outline{part, {}};
    if (const geometry::CsgTree* const tree = interaction::solid_of_part(world, part)) {
      SymbolPen pen(*place, kOperandColour, outline.strokes);
      std::visit(DrawShape{pen}, *tree->node(*part.operand).shape);
    } else if (const auto projector = interaction::projector_of_part(world, part)) {
      SymbolPen pen(*place, kProjectorColour, outline.strokes);
      draw_projector(projector->projection, pen);
    }
    join_lines(outline.strokes);
    outlines_.push_back(std::move(outline));
  }
}

render::SceneOverlay PartOutlines::overlay(const std::optional<MarkedPart>& marked) const {
  render::SceneOverlay overlay;
  for (const Outline& outline : outlines_) {
    render::SceneOverlay strokes = outline.strokes;
    const bool is_marked = marked && marked->part == outline.part;
    if (is_marked && marked->motion) move_strokes(strokes, *marked->motion);
    for (auto& line : strokes.lines) {
      if (is_marked) line.colour = kMarkedPartColour;
      if (is_marked) line.width = kMarkedLine;
      overlay.lines.push_back(std::move(line));
    }
  }
  return overlay;
}

std::optional<PartOutlines::Picked> PartOutlines::pick(const interaction::Ray& ray, double slack) const {
  std::optional<Picked> best;
  double least = slack;
  for (const Outline& outline : outlines_) {
    const auto met = passed_strokes(outline.strokes, ray);
    if (!met || !(met->off <= slack) || (best && met->off >= least)) continue;
    least = met->off;
    best = Picked{outline.part, met->place};
  }
  return best;
}

std::optional<PlacedPart> PartOutlines::nearest(const Vector3& place, double reach) const {
  std::optional<PlacedPart> best;
  double least = reach;
  for (const Outline& outline : outlines_) {
    const double distance = distance_to_strokes(outline.strokes, place);
    if (!(distance <= reach) || (best && distance >= least)) continue;
    least = distance;
    best = outline.part;
  }
  return best;
}

}  // namespace icome::session
