#include "geometry/deform/texture_projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/parallel.h"
#include "geometry/mesh/mesh_check.h"

namespace icome::geometry {
namespace {

using PictureCorners = std::array<Vector2, 3>;

/// The projector's frame taken apart, so that neither tiny nor enormous sizes spoil its inverse.
struct ProjectorFrame {
  Vector3 origin;
  Vector3 sizes;    // m, of the axes
  Matrix3 axes;     // unit, in the mesh's frame
  Matrix3 inverse;  // of the axes

  Vector3 local(const Vector3& point) const { return (inverse * (point - origin)).cwiseQuotient(sizes); }
};

base::Result<ProjectorFrame> projector_frame(const Affine3& mesh_from_projector) {
  constexpr double kFlatArea = 1e-12;  // the volume that three unit axes must at least span
  if (!mesh_from_projector.affine().allFinite()) {
    return base::fail("the projector's frame is not finite: give it a position and sizes in metres");
  }
  ProjectorFrame frame;
  frame.origin = mesh_from_projector.translation();
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 column = mesh_from_projector.linear().col(axis);
    frame.sizes[axis] = column.stableNorm();
    frame.axes.col(axis) = column.stableNormalized();
  }
  const bool some_size = frame.sizes.minCoeff() > 0 && frame.sizes.allFinite();
  if (!some_size || !(std::abs(frame.axes.determinant()) > kFlatArea)) {
    return base::fail("the projector is flat: give it some size along each of its three axes");
  }
  frame.inverse = frame.axes.inverse();
  return frame;
}

/// A value between the corners (0, 0), (1, 0), (1, 1) and (0, 1). Written as differences: the corners of the
/// whole picture change nothing.
Vector2 between(const std::array<Vector2, 4>& corners, const Vector2& at) {
  const Vector2 twist = (corners[0] - corners[1]) + (corners[2] - corners[3]);
  return corners[0] + at.x() * (corners[1] - corners[0]) + at.y() * (corners[3] - corners[0]) +
         at.x() * at.y() * twist;
}

PictureCorners planar(const std::array<Vector3, 3>& local) {
  PictureCorners result;
  for (int i = 0; i < 3; ++i) result[i] = local[i].head<2>() + Vector2(0.5, 0.5);
  return result;
}

/// The axis that the triangle faces most, and from which side it is seen. Axes that are as good but for
/// rounding give way to the first: two triangles of one slanted plane choose alike.
struct FacedSide {
  int axis = 0;
  bool from_below = false;
};

FacedSide faced_side(const TriangleMesh& mesh, std::size_t triangle, const Matrix3& axes) {
  constexpr double kClearly = 1.0 + 1e-6;
  const Vector3 a = (mesh.corner(triangle, 1) - mesh.corner(triangle, 0)).stableNormalized();
  const Vector3 b = (mesh.corner(triangle, 2) - mesh.corner(triangle, 0)).stableNormalized();
  const Vector3 towards = axes.transpose() * a.cross(b);
  FacedSide side;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(towards[axis]) > kClearly * std::abs(towards[side.axis])) side.axis = axis;
  }
  side.from_below = towards[side.axis] < 0;
  return side;
}

PictureCorners box_sided(const std::array<Vector3, 3>& local, const FacedSide& side) {
  const double sign = side.from_below ? -1.0 : 1.0;
  PictureCorners result;
  for (int i = 0; i < 3; ++i) {
    const Vector3& p = local[i];
    const Vector2 on_side = side.axis == 0   ? Vector2(sign * p.y(), p.z())
                            : side.axis == 1 ? Vector2(-sign * p.x(), p.z())
                                             : Vector2(p.x(), sign * p.y());
    result[i] = on_side + Vector2(0.5, 0.5);
  }
  return result;
}

/// A point as the axis sees it: turns from the meridian in [0, 1), the picture's height, the distance.
Vector3 around_axis(const Vector3& local, TextureProjection projection) {
  const double distance = std::hypot(local.x(), local.y());
  double turns = std::atan2(local.y(), local.x()) / (2.0 * std::numbers::pi) + 0.5;
  if (turns >= 1.0) turns -= 1.0;
  const double height = projection == TextureProjection::Cylindrical
                            ? local.z()
                            : std::atan2(local.z(), distance) / std::numbers::pi;
  return {turns, height + 0.5, distance};
}

/// Joins turns that the meridian separates: the cut is moved to the widest gap between them.
void join_turns(std::span<double> turns) {
  std::array<double, 3> sorted{};
  std::copy(turns.begin(), turns.end(), sorted.begin());
  std::sort(sorted.begin(), sorted.begin() + std::ptrdiff_t(turns.size()));
  double widest = 1.0 - (sorted[turns.size() - 1] - sorted[0]);
  double start = sorted[0];
  for (std::size_t i = 1; i < turns.size(); ++i) {
    if (!(sorted[i] - sorted[i - 1] > widest)) continue;
    widest = sorted[i] - sorted[i - 1];
    start = sorted[i];
  }
  for (double& turn : turns) turn += turn < start ? 1.0 : 0.0;
}

PictureCorners unrolled(const std::array<Vector3, 3>& around) {
  constexpr double kOnAxis = 1e-4;  // nearer than this share of the furthest corner's distance
  const double furthest = std::max({around[0].z(), around[1].z(), around[2].z()});
  std::array<double, 3> turns{};
  std::size_t count = 0;
  for (const Vector3& corner : around) {
    if (corner.z() > kOnAxis * furthest) turns[count++] = corner.x();
  }
  double mean = 0.5;  // where all of the triangle lies on the axis
  if (count > 0) {
    join_turns(std::span(turns).first(count));
    mean = count == 2 ? 0.5 * (turns[0] + turns[1]) : turns[0];
  }
  PictureCorners result;
  std::size_t next = 0;
  for (int i = 0; i < 3; ++i) {
    const bool off_axis = around[i].z() > kOnAxis * furthest;
    result[i] = {off_axis ? turns[next++] : mean, around[i].y()};
  }
  return result;
}

base::Result<void> check_corners(const TextureProjector& projector) {
  for (const Vector2& corner : projector.corners) {
    if (!corner.allFinite()) {
      return base::fail("a corner coordinate of the projector is not finite: give four pairs of numbers");
    }
  }
  return {};
}

tl::unexpected<base::Error> out_of_range(std::size_t triangle) {
  return base::fail(
      fmt::format("triangle {} is too far from the projector for its size: move the projector nearer "
                  "or make it larger",
                  triangle));
}

bool is_round(TextureProjection projection) {
  return projection == TextureProjection::Cylindrical || projection == TextureProjection::Spherical;
}

/// The vertices in the coordinates of the projection: its frame or around its axis. Not finite where they are
/// out of its range.
std::vector<Vector3> seen_vertices(const TriangleMesh& mesh, const ProjectorFrame& frame,
                                   TextureProjection projection) {
  constexpr std::size_t kVerticesForOneThread = 1U << 14U;
  std::vector<Vector3> seen(mesh.positions.size());
  base::parallel_for(seen.size(), kVerticesForOneThread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      seen[v] = frame.local(mesh.positions[v]);
      if (is_round(projection) && seen[v].allFinite()) seen[v] = around_axis(seen[v], projection);
    }
  });
  return seen;
}

bool all_finite(const auto& corners) {
  return corners[0].allFinite() && corners[1].allFinite() && corners[2].allFinite();
}

}  // namespace

Affine3 fitted_projector(const Bounds& box) {
  Affine3 frame = Affine3::Identity();
  if (box.isEmpty()) return frame;
  Vector3 sizes = box.max() - box.min();
  const double longest = sizes.maxCoeff() > 0 ? sizes.maxCoeff() : 1.0;
  for (double& size : sizes) size = size > 0 ? size : longest;
  frame.linear() = sizes.asDiagonal();
  frame.translation() = 0.5 * box.min() + 0.5 * box.max();
  return frame;
}

base::Result<std::vector<std::array<Vector2, 3>>> project_texture(const TriangleMesh& mesh,
                                                                  const TextureProjector& projector) {
  if (const auto fine = check_mesh(mesh); !fine) return tl::unexpected(fine.error());
  if (const auto fine = check_corners(projector); !fine) return tl::unexpected(fine.error());
  const auto frame = projector_frame(projector.mesh_from_projector);
  if (!frame) return tl::unexpected(frame.error());
  const std::vector<Vector3> seen = seen_vertices(mesh, *frame, projector.projection);
  const bool round = is_round(projector.projection), box = projector.projection == TextureProjection::Box;

  std::vector<PictureCorners> result(mesh.triangles.size());
  for (std::size_t t = 0; t < result.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const std::array<Vector3, 3> corners = {seen[a], seen[b], seen[c]};
    if (!all_finite(corners)) return out_of_range(t);
    result[t] = round ? unrolled(corners)
                : box ? box_sided(corners, faced_side(mesh, t, frame->axes))
                      : planar(corners);
    for (Vector2& corner : result[t]) corner = between(projector.corners, corner);
    if (!all_finite(result[t])) return out_of_range(t);
  }
  return result;
}

}  // namespace icome::geometry
