#include "geometry/sweep/self_crossing.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "geometry/algebra/exact_sign.h"
#include "geometry/mesh/mesh_topology.h"
#include "geometry/tree/box_tree.h"
#include "geometry/tree/triangle_tree.h"

namespace icome::geometry {
namespace {

using Signs = std::array<int, 3>;

/// The sides of the plane of `of` on which the corners lie.
Signs sides(const Corners& of, const Corners& corners) {
  return {side_sign(of[0], of[1], of[2], corners[0]), side_sign(of[0], of[1], of[2], corners[1]),
          side_sign(of[0], of[1], of[2], corners[2])};
}

bool is_on_both_sides(const Signs& signs) {
  return std::ranges::count(signs, 1) > 0 && std::ranges::count(signs, -1) > 0;
}

bool is_in_plane(const Signs& signs) { return signs == Signs{0, 0, 0}; }

/// The corners turned round so that the first is alone on its side of a plane that they are on both sides of.
struct Alone {
  Corners corners;
  bool above;

  Alone(const Corners& its, const Signs& signs) {
    std::size_t first = 0;
    while (std::ranges::count(signs, signs[first]) > 1 || signs[first] == 0) ++first;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = its[(first + i) % 3];
    above = signs[first] > 0;
  }
};

/// Do two triangles, each on both sides of the other's plane, meet in more than a point of the line that the
/// planes share?
bool go_through(const Corners& one, const Signs& one_sides, const Corners& other, const Signs& other_sides) {
  Alone a(one, one_sides), b(other, other_sides);
  // Each sees the other counter-clockwise from its lone corner.
  if (!a.above) std::swap(b.corners[1], b.corners[2]);
  if (!b.above) std::swap(a.corners[1], a.corners[2]);
  return side_sign(a.corners[0], a.corners[1], b.corners[0], b.corners[1]) < 0 &&
         side_sign(a.corners[0], a.corners[2], b.corners[2], b.corners[0]) < 0;
}

/// A plane's own coordinates: those of space without the one along which the plane is steepest.
class Flattened {
 public:
  explicit Flattened(const Corners& corners) {
    const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    int steepest = 0;
    normal.cwiseAbs().maxCoeff(&steepest);
    first_ = (steepest + 1) % 3;
    second_ = (steepest + 2) % 3;
  }
  Vector2 operator()(const Vector3& point) const { return {point[first_], point[second_]}; }
  /// The triangle in these coordinates, counter-clockwise.
  std::array<Vector2, 3> operator()(const Corners& corners) const {
    std::array<Vector2, 3> flat = {(*this)(corners[0]), (*this)(corners[1]), (*this)(corners[2])};
    if (turn_sign(flat[0], flat[1], flat[2]) < 0) std::swap(flat[1], flat[2]);
    return flat;
  }

 private:
  int first_ = 0, second_ = 1;
};

/// Does an edge of the first triangle, both counter-clockwise, keep the second outside?
bool edge_parts(const std::array<Vector2, 3>& triangle, const std::array<Vector2, 3>& other) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto is_outside = [&](const Vector2& point) {
      return turn_sign(triangle[i], triangle[(i + 1) % 3], point) <= 0;
    };
    if (std::ranges::all_of(other, is_outside)) return true;
  }
  return false;
}

/// Do two triangles of one plane have more than a line in common?
bool overlap_in_plane(const Corners& one, const Corners& other) {
  const Flattened flattened(one);
  const std::array<Vector2, 3> a = flattened(one), b = flattened(other);
  return !edge_parts(a, b) && !edge_parts(b, a);
}

bool face_alike(const Corners& one, const Corners& other) {
  const Vector3 normal = (one[1] - one[0]).cross(one[2] - one[0]);
  return normal.dot((other[1] - other[0]).cross(other[2] - other[0])) > 0.0;
}

/// Does the stretch of a triangle's plane from `a` to `b` lead through the inside of it?
bool leads_through(const Corners& triangle, const Vector3& a, const Vector3& b) {
  const Flattened flattened(triangle);
  const std::array<Vector2, 3> corners = flattened(triangle);
  const Vector2 from = flattened(a), to = flattened(b);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2 &start = corners[i], &end = corners[(i + 1) % 3];
    if (turn_sign(start, end, from) <= 0 && turn_sign(start, end, to) <= 0) return false;
  }
  const Signs corner_signs = {turn_sign(from, to, corners[0]), turn_sign(from, to, corners[1]),
                              turn_sign(from, to, corners[2])};
  return is_on_both_sides(corner_signs);
}

bool spans_area(const Corners& corners) {
  return !(corners[1] - corners[0]).cross(corners[2] - corners[0]).isZero(0.0);
}

class SelfCrossingSearch {
 public:
  SelfCrossingSearch(const TriangleMesh& mesh, std::uint64_t most_tests)
      : mesh_(mesh), tests_left_(most_tests), topology_(analyse_topology(mesh)), origin_(mesh.corner(0, 0)) {
    std::vector<FloatBox> boxes;
    boxes.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) boxes.push_back(float_box(box_of(t)));
    tree_ = BoxTree(boxes);
  }

  SelfCrossing run() {
    SelfCrossing result;
    for (std::uint32_t t = 0; t < mesh_.triangles.size() && result.sought && !result.place; ++t) {
      const Corners corners = corners_of(t);
      if (!spans_area(corners)) continue;
      const Bounds box = box_of(t);
      SegmentQuery query(box.min(), box.max(), 0.0);
      query.slanted = false;  // visits all boxes that its box meets
      tree_.near(query, [&](std::uint32_t other) {
        if (other <= t) return true;
        if (tests_left_ == 0) {
          result.sought = false;
          return false;
        }
        --tests_left_;
        result.place = crossing(t, corners, other);
        return !result.place;
      });
    }
    return result;
  }

 private:
  Corners corners_of(std::uint32_t t) const {
    return {mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
  }
  /// The box of a triangle, relative to one vertex of the mesh, so that single precision tells boxes apart.
  Bounds box_of(std::uint32_t t) const {
    Bounds box;
    for (int i = 0; i < 3; ++i) box.extend(mesh_.corner(t, i) - origin_);
    return box;
  }

  /// A place near the crossing of the two; nothing if they do not cross.
  std::optional<Vector3> crossing(std::uint32_t t, const Corners& corners, std::uint32_t other) const {
    const Corners others = corners_of(other);
    if (!spans_area(others) || !cross(t, corners, other, others)) return std::nullopt;
    Bounds one, both;
    for (const Vector3& corner : corners) one.extend(corner);
    for (const Vector3& corner : others) both.extend(corner);
    return Vector3(one.intersection(both).center());
  }

  bool cross(std::uint32_t t, const Corners& corners, std::uint32_t other, const Corners& others) const {
    const Signs signs = sides(others, corners);
    if (signs == Signs{1, 1, 1} || signs == Signs{-1, -1, -1}) return false;
    const Signs other_signs = sides(corners, others);
    if (is_in_plane(signs))
      return overlap_in_plane(corners, others) && (!topology_.report.closed || face_alike(corners, others));
    if (is_on_both_sides(signs) && is_on_both_sides(other_signs) &&
        go_through(corners, signs, others, other_signs))
      return true;
    return goes_through_along_a_side(t, signs, corners, others) ||
           goes_through_along_a_side(other, other_signs, others, corners);
  }

  /// Does the surface cross the triangle `through` along a side of `t` that lies in its plane?
  bool goes_through_along_a_side(std::uint32_t t, const Signs& signs, const Corners& corners,
                                 const Corners& through) const {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3, last = (i + 2) % 3;
      if (signs[i] != 0 || signs[next] != 0) continue;
      const std::uint32_t beyond = topology_.neighbours[t][i];
      if (beyond == kNoTriangle) return false;
      const Signs there = sides(through, corners_of(beyond));
      // Its third corner is the only one that is not in the plane.
      const int side = there[0] + there[1] + there[2];
      return side * signs[last] < 0 && leads_through(through, corners[i], corners[next]);
    }
    return false;
  }

  const TriangleMesh& mesh_;
  std::uint64_t tests_left_;
  MeshTopology topology_;
  Vector3 origin_;
  BoxTree tree_ = {};
};

}  // namespace

SelfCrossing find_self_crossing(const TriangleMesh& mesh, std::uint64_t most_tests) {
  if (mesh.triangles.empty()) return {};
  return SelfCrossingSearch(mesh, most_tests).run();
}

}  // namespace icome::geometry
