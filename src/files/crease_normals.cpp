#include "files/crease_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace icome::files {
namespace {

using base::Vector3;

/// Normals come from single-precision positions, which are not exact: an angle that was meant to equal
/// the crease angle must not fall on either side by chance.
constexpr double kAngleSlack = 0x1p-18;

/// The vector at unit length; zero when it has no direction.
Vector3 direction_of(const Vector3& vector) {
  const double largest = vector.cwiseAbs().maxCoeff();
  if (!(largest > 0.0) || !std::isfinite(largest)) return Vector3::Zero();
  return (vector / largest).normalized();
}

/// The corners at each vertex.
struct CornersAround {
  std::vector<std::uint32_t> begins;  // of each vertex in `corners`, and the end of the last
  std::vector<std::uint32_t> corners;

  explicit CornersAround(const PolygonMesh& mesh)
      : begins(mesh.positions.size() + 1, 0), corners(mesh.corners.size()) {
    for (const std::uint32_t vertex : mesh.corners) ++begins[vertex + 1];
    for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
    std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
    for (std::uint32_t i = 0; i < mesh.corners.size(); ++i) corners[next[mesh.corners[i]]++] = i;
  }
  std::span<const std::uint32_t> at(std::size_t vertex) const {
    return {corners.data() + begins[vertex], begins[vertex + 1] - begins[vertex]};
  }
};

class CreaseNormals {
 public:
  CreaseNormals(const PolygonMesh& mesh, double angle)
      : mesh_(mesh),
        around_(mesh),
        faces_(polygon_normals(mesh)),
        polygon_of_(mesh.corners.size()),
        cosine_(std::cos(std::min(angle + kAngleSlack, std::numbers::pi))),
        half_cosine_(std::cos(0.5 * std::min(angle + kAngleSlack, std::numbers::pi))) {
    for (std::uint32_t i = 0; i < mesh.polygons(); ++i)
      std::fill(polygon_of_.begin() + mesh.begins[i], polygon_of_.begin() + mesh.begins[i + 1], i);
  }

  std::vector<Vector3> normals() {
    const auto smooth = [&](std::size_t vertex) { return all_lie_near(around_.at(vertex)); };
    std::size_t vertex = 0;
    while (vertex < mesh_.positions.size() && smooth(vertex)) ++vertex;
    if (vertex == mesh_.positions.size()) return {};
    result_.resize(mesh_.corners.size());
    for (vertex = 0; vertex < mesh_.positions.size(); ++vertex) join_at(around_.at(vertex));
    return std::move(result_);
  }

 private:
  const Vector3& face(std::uint32_t corner) const { return faces_[polygon_of_[corner]]; }
  bool meet_smoothly(std::uint32_t a, std::uint32_t b) const { return face(a).dot(face(b)) >= cosine_; }

  /// Finds the normals of the corners of a vertex.
  void join_at(std::span<const std::uint32_t> corners) {
    weighted_.clear();
    Vector3 sum = Vector3::Zero();
    for (const std::uint32_t corner : corners) {
      weighted_.push_back(face(corner) * angle_at(corner));
      sum += weighted_.back();
    }
    if (all_lie_near(corners)) {
      for (const std::uint32_t corner : corners) result_[corner] = direction_or(sum, corner);
      return;
    }
    const bool too_many = corners.size() > kMostPolygonsAround;
    for (const std::uint32_t corner : corners) {
      const bool has_area = !face(corner).isZero(0.0);
      result_[corner] = direction_or(!has_area  ? sum
                                     : too_many ? face(corner)
                                                : mean_at(corner, corners),
                                     corner);
    }
  }

  /// Does every polygon meet every other smoothly? Compares pairs only where a cone around their mean, half
  /// as wide, does not hold them all.
  bool all_lie_near(std::span<const std::uint32_t> corners) const {
    Vector3 mean = Vector3::Zero();
    for (const std::uint32_t corner : corners) mean += face(corner);
    mean = direction_of(mean);
    const auto in_cone = [&](std::uint32_t it) {
      return face(it).isZero(0.0) || face(it).dot(mean) >= half_cosine_;
    };
    if (std::all_of(corners.begin(), corners.end(), in_cone)) return true;
    if (corners.size() > kMostPolygonsAround) return false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const bool flat = face(corners[i]).isZero(0.0) || face(corners[j]).isZero(0.0);
        if (!flat && !meet_smoothly(corners[i], corners[j])) return false;
      }
    }
    return true;
  }

  Vector3 mean_at(std::uint32_t corner, std::span<const std::uint32_t> corners) const {
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (meet_smoothly(corner, corners[i])) sum += weighted_[i];
    }
    return sum;
  }

  /// The sum's direction, else the polygon's own normal, else the z axis.
  Vector3 direction_or(const Vector3& sum, std::uint32_t corner) const {
    const Vector3 direction = direction_of(sum);
    if (!direction.isZero(0.0)) return direction;
    return face(corner).isZero(0.0) ? Vector3::UnitZ() : face(corner);
  }

  /// Angle of the polygon at a corner, rad.
  double angle_at(std::uint32_t corner) const {
    const std::uint32_t polygon = polygon_of_[corner];
    const std::uint32_t first = mesh_.begins[polygon], end = mesh_.begins[polygon + 1];
    const auto position = [&](std::uint32_t it) -> const Vector3& {
      return mesh_.positions[mesh_.corners[it]];
    };
    const Vector3& here = position(corner);
    const Vector3 before = direction_of(position(corner == first ? end - 1 : corner - 1) - here);
    const Vector3 after = direction_of(position(corner + 1 == end ? first : corner + 1) - here);
    return std::atan2(before.cross(after).norm(), before.dot(after));
  }

  const PolygonMesh& mesh_;
  CornersAround around_;
  std::vector<Vector3> faces_;
  std::vector<std::uint32_t> polygon_of_;  // each corner
  double cosine_;                          // of the crease angle
  double half_cosine_;                     // of its half
  std::vector<Vector3> weighted_;          // scratch
  std::vector<Vector3> result_;
};

/// Each polygon's own normal; empty where the polygons around every vertex lie in one plane.
std::vector<Vector3> flat_normals(const PolygonMesh& mesh) {
  const std::vector<Vector3> faces = polygon_normals(mesh);
  const double cosine = std::cos(kAngleSlack);
  std::vector<Vector3> first(mesh.positions.size(), Vector3::Zero());  // at each vertex
  std::vector<Vector3> result(mesh.corners.size());
  bool smooth = true;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool has_area = !faces[i].isZero(0.0);
    const Vector3 normal = has_area ? faces[i] : Vector3(Vector3::UnitZ());
    for (std::uint32_t corner = mesh.begins[i]; corner < mesh.begins[i + 1]; ++corner) {
      result[corner] = normal;
      Vector3& known = first[mesh.corners[corner]];
      if (!has_area) continue;
      if (known.isZero(0.0)) known = normal;
      if (known.dot(normal) < cosine) smooth = false;
    }
  }
  if (smooth) result.clear();
  return result;
}

}  // namespace

std::vector<Vector3> polygon_normals(const PolygonMesh& mesh) {
  std::vector<Vector3> result(mesh.polygons());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const std::uint32_t first = mesh.begins[i], end = mesh.begins[i + 1];
    const auto position = [&](std::uint32_t it) -> const Vector3& {
      return mesh.positions[mesh.corners[it]];
    };
    Vector3 sum = Vector3::Zero();
    for (std::uint32_t k = first + 2; k < end; ++k)
      sum += (position(k - 1) - position(first)).cross(position(k) - position(first));
    result[i] = direction_of(sum);
  }
  return result;
}

std::vector<Vector3> crease_normals(const PolygonMesh& mesh, double crease_angle) {
  if (crease_angle >= std::numbers::pi) return {};
  return crease_angle > 0.0 ? CreaseNormals(mesh, crease_angle).normals() : flat_normals(mesh);
}

}  // namespace icome::files
