#include "geometry/csg/meshing/csg_settle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/decompositions.h"
#include "geometry/csg/csg_part.h"
#include "geometry/csg/meshing/csg_tets.h"

namespace icome::geometry {
namespace {

using Surface = CsgSurfaces::Index;

constexpr int kMostSettling = 8;     // steps
constexpr double kSettled = 1e-16;   // of the coordinates: a step so small is none
constexpr double kAlike = 1e-6;      // of the largest eigenvalue: below, normals do not tell a direction
constexpr double kWayOfEdge = 0.5;   // of the shortest edge around: the longest move of a vertex
constexpr double kFacing = 0.8;      // cosine between a triangle and its surface
constexpr double kOnItself = 1e-12;  // of the coordinates: places so near a surface are on it
constexpr double kBesideTip = 1e-9;  // of the coordinates: the distance from a tip at which it is probed
/// A wall or a gap must go on this many times deeper than the chord's distance from the surface.
constexpr std::array<double, 5> kDepths{1.0, 2.0, 5.0, 10.0, 20.0};

class VertexSettler {
 public:
  VertexSettler(TriangleMesh& mesh, const std::vector<Surface>& faces, const CsgSurfaces& surfaces)
      : mesh_(mesh), faces_(faces), surfaces_(surfaces), around_(mesh.positions.size()) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t corner : mesh.triangles[t]) around_[corner].push_back(t);
    }
  }

  void settle_all() {
    for (std::uint32_t vertex = 0; vertex < around_.size(); ++vertex) settle(vertex);
  }

  /// Moves the nearest vertex within `reach` that lies on the surface alone to the place, and returns it.
  std::optional<std::uint32_t> settle_nearest(Surface surface, const Vector3& place, double reach) {
    std::optional<std::uint32_t> nearest;
    for (std::uint32_t vertex = 0; vertex < around_.size(); ++vertex) {
      const double distance = (mesh_.positions[vertex] - place).norm();
      if (distance >= reach || !lies_on(vertex, surface)) continue;
      if (distance > 0.0 && turns_over(vertex, place)) continue;
      reach = distance;
      nearest = vertex;
    }
    if (nearest) mesh_.positions[*nearest] = place;
    return nearest;
  }

 private:
  void settle(std::uint32_t vertex) {
    std::vector<Surface> passing;
    for (const std::uint32_t t : around_[vertex]) passing.push_back(faces_[t]);
    passing = surfaces_of(std::move(passing));
    if (passing.empty()) return;
    const Vector3 before = mesh_.positions[vertex];
    const auto place = common_place(before, passing);
    if (!place || !fits(vertex, *place)) return;
    mesh_.positions[vertex] = *place;
  }

  bool lies_on(std::uint32_t vertex, Surface surface) const {
    const std::vector<std::uint32_t>& around = around_[vertex];
    return !around.empty() &&
           std::all_of(around.begin(), around.end(), [&](auto t) { return faces_[t] == surface; });
  }

  static std::vector<Surface> surfaces_of(std::vector<Surface> faces) {
    make_set(faces);
    if (!faces.empty() && faces.back() == CsgSurfaces::kNone) faces.clear();
    return faces;
  }

  double farthest(const Vector3& place, const std::vector<Surface>& passing) const {
    double most = 0.0;
    for (const Surface surface : passing)
      most = std::max(most, std::abs(surfaces_.height(surface, place).height));
    return most;
  }

  /// The place common to all surfaces; nothing where Newton's method gets no nearer to them than `start`.
  std::optional<Vector3> common_place(const Vector3& start, const std::vector<Surface>& passing) const {
    Vector3 place = start;
    for (int i = 0; i < kMostSettling; ++i) {
      const Vector3 step = step_to(place, passing);
      place += step;
      if (step.norm() <= kSettled * place.norm()) break;
    }
    if (!place.allFinite() || farthest(place, passing) >= farthest(start, passing)) return std::nullopt;
    return place;
  }

  /// The shortest step to a common point of the tangent planes, or else to the point nearest to all of them.
  Vector3 step_to(const Vector3& place, const std::vector<Surface>& passing) const {
    Matrix3 normals = Matrix3::Zero();
    Vector3 pull = Vector3::Zero();
    for (const Surface surface : passing) {
      const AtomHeight there = surfaces_.height(surface, place);
      normals += there.normal * there.normal.transpose();
      pull -= there.height * there.normal;
    }
    const base::SymmetricEigen eigen = base::symmetric_eigen(normals);
    Vector3 step = Vector3::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vector3 along = eigen.vectors.col(k);
      if (eigen.values[k] > kAlike * eigen.values[2]) step += along * (along.dot(pull) / eigen.values[k]);
    }
    return step;
  }

  /// May the vertex move there: is that near, and is no triangle turned over?
  bool fits(std::uint32_t vertex, const Vector3& place) const {
    const Vector3& here = mesh_.positions[vertex];
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t t : around_[vertex]) {
      for (const std::uint32_t corner : mesh_.triangles[t]) {
        if (corner != vertex) shortest = std::min(shortest, (mesh_.positions[corner] - here).norm());
      }
    }
    return (place - here).norm() <= kWayOfEdge * shortest && !turns_over(vertex, place);
  }

  /// Is a triangle turned over when the vertex moves there?
  bool turns_over(std::uint32_t vertex, const Vector3& place) const {
    return std::any_of(around_[vertex].begin(), around_[vertex].end(), [&](std::uint32_t t) {
      std::array<Vector3, 3> before, after;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t corner = mesh_.triangles[t][i];
        before[i] = mesh_.positions[corner];
        after[i] = corner == vertex ? place : mesh_.positions[corner];
      }
      const Vector3 was = (before[1] - before[0]).cross(before[2] - before[0]);
      const Vector3 is = (after[1] - after[0]).cross(after[2] - after[0]);
      return is.dot(was) <= 0.0;
    });
  }

  TriangleMesh& mesh_;
  const std::vector<Surface>& faces_;
  const CsgSurfaces& surfaces_;
  std::vector<std::vector<std::uint32_t>> around_;  // by vertex: its triangles
};

}  // namespace

void settle_vertices(TriangleMesh& mesh, const std::vector<Surface>& faces, const CsgSurfaces& surfaces) {
  VertexSettler(mesh, faces, surfaces).settle_all();
}

std::vector<bool> settle_tips(TriangleMesh& mesh, const std::vector<Surface>& faces,
                              const CsgProgram& program, const CsgSurfaces& surfaces, double cell) {
  std::vector<bool> tips(mesh.positions.size(), false);
  VertexSettler settler(mesh, faces, surfaces);
  const double beside = kBesideTip * largest_coordinate(program);
  for (Surface surface = 0; surface < surfaces.size(); ++surface) {
    const auto apex = surfaces.apex(surface);
    if (!apex || surfaces.like(surface) != surface) continue;
    const Vector3 way = beside * apex->normal;
    if (program.inside(apex->point - way) == program.inside(apex->point + way)) continue;
    if (const auto tip = settler.settle_nearest(surface, apex->point, cell)) tips[*tip] = true;
  }
  return tips;
}

bool ChordJudge::stands_for(Surface surface, const std::array<Vector3, 3>& corners) const {
  if (surfaces_.is_plane(surface)) return true;
  const Vector3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  const double allowed = chord_height(cell_, surfaces_.bend(surface, middle, cell_));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 between = 0.5 * (corners[i] + corners[(i + 1) % 3]);
    if (std::abs(surfaces_.height(surface, between).height) > allowed) return false;
  }
  const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
  const AtomHeight there = surfaces_.height(surface, middle);
  const double facing = normal.dot(there.normal);
  return std::abs(there.height) <= allowed && std::abs(facing) >= kFacing &&
         near_against_thickness(middle, there, facing > 0.0);
}

/// Is it solid behind the surface and free in front of it, to several times the place's distance from it?
/// Then a chord takes away or adds only a small part of a wall.
bool ChordJudge::near_against_thickness(const Vector3& place, const AtomHeight& there, bool faces_out) const {
  if (std::abs(there.height) <= kOnItself * place.norm()) return true;
  const Vector3 foot = place - there.height * there.normal;
  const bool solid = (there.height < 0.0) == faces_out;  // at the place
  return std::all_of(kDepths.begin(), kDepths.end(), [&](double depth) {
    const Vector3 way = depth * there.height * there.normal;
    return program_.inside(foot + way) == solid && program_.inside(foot - way) != solid;
  });
}

}  // namespace icome::geometry
