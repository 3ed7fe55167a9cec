#include "geometry/mesh/bent_normals.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>

#include "base/decompositions.h"
#include "geometry/mesh/weld.h"

namespace icome::geometry {
namespace {

constexpr double kNoTangent = 1e-6;  // of an edge: with a smaller part across the normal it gives no tangent

/// Corner i of triangle t is 3 t + i here.
using MeshCorner = std::uint32_t;

/// A surface round a corner: the normal, and an edge's direction across it.
struct CornerFrame {
  Vector3 normal = Vector3::Zero();   // unit, or zero
  Vector3 tangent = Vector3::Zero();  // unit, or zero

  Matrix3 axes() const {
    Matrix3 axes;
    axes << normal, tangent, normal.cross(tangent);
    return axes;
  }
};

/// Turns the normals of a mesh vertex by vertex.
class NormalBender {
 public:
  NormalBender(const TriangleMesh& before, std::span<const Vector3> after, const CornerNormals& normals)
      : before_(before), after_(after), old_(normals), result_(normals), welded_(before) {
    weld_equal(welded_);
    touched_.resize(before.triangles.size());
    std::vector<bool> affected(before.positions.size(), false);
    for (std::size_t t = 0; t < touched_.size(); ++t) {
      for (const std::uint32_t v : before.triangles[t])
        if (before.positions[v] != after[v]) touched_[t] = true;
      if (!touched_[t]) continue;
      for (const std::uint32_t v : welded_.triangles[t]) affected[v] = true;
    }
    find_corners(affected);
  }

  CornerNormals bend() {
    for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
      const std::span here = std::span(corners_).subspan(first_[v], first_[v + 1] - first_[v]);
      std::ranges::sort(here, [this](MeshCorner a, MeshCorner b) {
        const std::strong_ordering order = compare(a, b);
        return std::is_lt(order) || (std::is_eq(order) && a < b);
      });
      for (std::size_t begin = 0, end = 0; begin < here.size(); begin = end) {
        while (end < here.size() && std::is_eq(compare(here[begin], here[end]))) ++end;
        bend(here.subspan(begin, end - begin));
      }
    }
    return std::move(result_);
  }

 private:
  /// The corners at each affected place.
  void find_corners(const std::vector<bool>& affected) {
    first_.assign(affected.size() + 1, 0);
    const auto for_each = [&](auto visit) {
      for (MeshCorner c = 0; c < 3 * welded_.triangles.size(); ++c) {
        const std::uint32_t v = welded_.triangles[c / 3][c % 3];
        if (affected[v]) visit(c, v);
      }
    };
    for_each([&](MeshCorner, std::uint32_t v) { ++first_[v + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    corners_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for_each([&](MeshCorner c, std::uint32_t v) { corners_[next[v]++] = c; });
  }

  /// Orders corners of one place by their normals and new positions: equal ones form one group.
  std::strong_ordering compare(MeshCorner a, MeshCorner b) const {
    const std::strong_ordering normals = compare(normal(a), normal(b));
    return std::is_eq(normals) ? compare(after_[vertex(a)], after_[vertex(b)]) : normals;
  }
  static std::strong_ordering compare(const Vector3& a, const Vector3& b) {
    for (int axis = 0; axis < 3; ++axis) {
      if (a[axis] < b[axis]) return std::strong_ordering::less;
      if (a[axis] > b[axis]) return std::strong_ordering::greater;
    }
    return std::strong_ordering::equal;
  }

  void bend(std::span<const MeshCorner> group) {
    const auto is_touched = [&](MeshCorner c) { return bool(touched_[c / 3]); };
    if (std::ranges::none_of(group, is_touched)) return;
    const Vector3 from = normal_of(group, before_.positions), to = normal_of(group, after_);
    if (from.isZero(0.0) || to.isZero(0.0)) return;
    const Matrix3 turn = turn_of(group, from, to);
    for (const MeshCorner c : group) {
      const Vector3 turned = turn * normal(c);
      const double length = turned.norm();
      if (length > 0.0) result_[c / 3][c % 3] = turned / length;
    }
  }

  /// The rotation that takes the average normal, and a tangent if there is one, to the new ones.
  Matrix3 turn_of(std::span<const MeshCorner> group, const Vector3& from, const Vector3& to) const {
    for (const MeshCorner c : group) {
      const CornerFrame old{from, tangent_of(c, before_.positions, from)};
      const CornerFrame now{to, tangent_of(c, after_, to)};
      if (!old.tangent.isZero(0.0) && !now.tangent.isZero(0.0)) return now.axes() * old.axes().transpose();
    }
    return base::rotation_between(from, to).toRotationMatrix();
  }

  /// The average normal of the group's triangles, unit; zero where they have no area.
  Vector3 normal_of(std::span<const MeshCorner> group, std::span<const Vector3> positions) const {
    Vector3 sum = Vector3::Zero();
    for (const MeshCorner c : group) {
      const Vector3 one = edge(c, 1, positions), other = edge(c, 2, positions);
      const Vector3 across = one.cross(other);
      const double area = across.stableNorm();
      if (area > 0.0) sum += std::atan2(area, one.dot(other)) / area * across;
    }
    const double length = sum.norm();
    return length > 0.0 && std::isfinite(length) ? Vector3(sum / length) : Vector3(Vector3::Zero());
  }

  Vector3 tangent_of(MeshCorner c, std::span<const Vector3> positions, const Vector3& normal) const {
    const Vector3 along = edge(c, 1, positions);
    const Vector3 across = along - along.dot(normal) * normal;
    const double length = across.norm();
    return length > kNoTangent * along.norm() ? Vector3(across / length) : Vector3(Vector3::Zero());
  }

  std::uint32_t vertex(MeshCorner c) const { return before_.triangles[c / 3][c % 3]; }
  const Vector3& normal(MeshCorner c) const { return old_[c / 3][c % 3]; }
  /// The vector from a corner to the next one of its triangle, or to the one after that.
  Vector3 edge(MeshCorner c, std::uint32_t on, std::span<const Vector3> positions) const {
    return positions[before_.triangles[c / 3][(c % 3 + on) % 3]] - positions[vertex(c)];
  }

  const TriangleMesh& before_;
  std::span<const Vector3> after_;
  const CornerNormals& old_;
  CornerNormals result_;
  TriangleMesh welded_;               // triangles as before_, by the first vertex at each place
  std::vector<bool> touched_;         // triangles with a vertex that has moved
  std::vector<std::uint32_t> first_;  // those at place v are corners_[first_[v]..first_[v + 1])
  std::vector<MeshCorner> corners_;
};

}  // namespace

CornerNormals bent_normals(const TriangleMesh& before, std::span<const Vector3> after,
                           const CornerNormals& normals) {
  return NormalBender(before, after, normals).bend();
}

}  // namespace icome::geometry
