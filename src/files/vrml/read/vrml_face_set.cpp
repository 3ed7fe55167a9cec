#include "files/vrml/read/vrml_face_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/vrml/read/taken_faces.h"
#include "geometry/mesh/polygon_triangulation.h"
#include "io/single.h"

namespace icome::files {
namespace {

using base::Vector2;
using base::Vector3;
using world::Colour;
using world::MeshGeometry;

constexpr FindingKind kWrongNormals = {"Normals that do not fit the faces are made anew", "shapes"};
constexpr FindingKind kWrongColours = {"Colours that do not fit the faces are left out", "shapes"};
constexpr FindingKind kWrongCoordinates = {"Texture coordinates that do not fit the faces are left out",
                                           "shapes"};
constexpr FindingKind kBrightColours = {"Colours of vertices and faces are cut off to lie between 0 and 1",
                                        "shapes"};

using Triple = std::array<std::uint32_t, 3>;

/// Makes a triangle mesh of faces; their values are looked up by corner.
class FaceMesh {
 public:
  FaceMesh(const VrmlFaceSet& from, Findings& findings)
      : from_(from),
        findings_(findings),
        taken_(take_faces(from.positions, from.polygons, from.ccw, from.name, findings)) {}

  std::shared_ptr<MeshGeometry> make(bool shows_picture, io::TimeBudget& time_budget) {
    if (!cut_into_triangles(time_budget) || triangles_.empty()) return nullptr;
    geometry::TriangleMesh mesh;
    for (const Triple& corners : triangles_)
      mesh.triangles.push_back(of_corners<std::uint32_t>(corners, taken_.mesh.corners));
    auto result = std::make_shared<MeshGeometry>(std::move(mesh));
    add_normals(*result);
    add_colours(*result);
    add_texture(*result, shows_picture);
    result->mesh.positions = std::move(taken_.mesh.positions);
    return result;
  }

 private:
  template <typename Value>
  static std::array<Value, 3> of_corners(const Triple& corners, const std::vector<Value>& values) {
    return {values[corners[0]], values[corners[1]], values[corners[2]]};
  }

  /// False when the time budget ends.
  bool cut_into_triangles(io::TimeBudget& time_budget) {
    const PolygonMesh& mesh = taken_.mesh;
    std::vector<Vector3> corners;
    std::vector<Triple> cut;
    triangles_.reserve(mesh.corners.size() - 2 * mesh.polygons());
    for (std::size_t i = 0; i < mesh.polygons(); ++i) {
      const std::uint32_t first = mesh.begins[i], end = mesh.begins[i + 1];
      cut.clear();
      if (end - first == 3) {
        cut.push_back({0, 1, 2});
      } else {
        if (!time_budget.lasts()) return false;
        corners.clear();
        for (std::uint32_t k = first; k < end; ++k) corners.push_back(mesh.positions[mesh.corners[k]]);
        geometry::triangulate_polygon(corners, cut);
      }
      for (const auto& [a, b, c] : cut) add_triangle({first + a, first + b, first + c});
    }
    return true;
  }

  /// A triangle may have a vertex twice where a hole is joined to the rim; it is left out.
  void add_triangle(const Triple& corners) {
    const auto [a, b, c] = of_corners(corners, taken_.mesh.corners);
    if (a != b && b != c && c != a) triangles_.push_back(corners);
  }

  /// Index of each corner's value among `count` values; empty when an index is out of range.
  std::vector<std::uint32_t> values(const std::vector<std::int32_t>& list, bool per_vertex,
                                    std::size_t count) const {
    std::vector<std::uint32_t> result(taken_.slots.size());
    for (std::size_t polygon = 0; polygon < taken_.mesh.polygons(); ++polygon) {
      for (std::uint32_t i = taken_.mesh.begins[polygon]; i < taken_.mesh.begins[polygon + 1]; ++i) {
        std::size_t value = per_vertex ? taken_.vertices[i] : taken_.numbers[polygon];
        if (!list.empty()) {
          const std::size_t place = per_vertex ? taken_.slots[i] : taken_.numbers[polygon];
          value = place < list.size() && list[place] >= 0 ? std::size_t(list[place]) : count;
        }
        if (value >= count) return {};
        result[i] = std::uint32_t(value);
      }
    }
    return result;
  }

  void add_normals(MeshGeometry& mesh) {
    std::vector<Vector3> normals = given_normals();
    if (normals.empty()) normals = crease_normals(taken_.mesh, from_.crease_angle);
    if (normals.empty()) return;
    mesh.normals.reserve(triangles_.size());
    for (const Triple& corners : triangles_) mesh.normals.push_back(of_corners(corners, normals));
  }

  /// Normals by corner; empty when there are no fitting ones.
  std::vector<Vector3> given_normals() {
    const std::size_t count = from_.normals.size() / 3;
    if (count == 0) return {};
    std::vector<Vector3> units(count);
    for (std::size_t i = 0; i < count; ++i) {
      const float* const at = from_.normals.data() + 3 * i;
      const Vector3 normal(io::from_single(at[0]), io::from_single(at[1]), io::from_single(at[2]));
      const double length = normal.stableNorm();
      if (length > 0.0 && std::isfinite(length)) {
        units[i] = normal / length;
      } else {
        units[i] = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
      }
    }
    std::vector<Vector3> result;
    for (const std::uint32_t value : values(from_.normal_polygons, from_.normal_per_vertex, count)) {
      if (!units[value].allFinite()) {
        result.clear();
        break;
      }
      result.push_back(units[value]);
    }
    if (result.empty()) findings_.add(kWrongNormals, from_.name);
    return result;
  }

  void add_colours(MeshGeometry& mesh) {
    const std::size_t count = from_.colours.size() / 3;
    if (count == 0) return;
    const std::vector<std::uint32_t> corners = values(from_.colour_polygons, from_.colour_per_vertex, count);
    if (corners.empty()) return findings_.add(kWrongColours, from_.name);
    std::size_t cut_off = 0;
    std::vector<Colour> colours(count);
    for (std::size_t i = 0; i < 3 * count; ++i) {
      const float part = from_.colours[i];
      const bool good = part >= 0.0F && part <= 1.0F;
      if (!good) ++cut_off;
      colours[i / 3][i % 3] = good ? part : part > 1.0F ? 1.0F : 0.0F;
    }
    if (cut_off > 0) findings_.add(kBrightColours, from_.name);
    mesh.colours.reserve(triangles_.size());
    for (const auto& [a, b, c] : triangles_)
      mesh.colours.push_back({colours[corners[a]], colours[corners[b]], colours[corners[c]]});
  }

  void add_texture(MeshGeometry& mesh, bool shows_picture) {
    std::vector<Vector2> coordinates = given_coordinates();
    if (coordinates.empty() && shows_picture) coordinates = default_coordinates();
    if (coordinates.empty()) return;
    const auto finite = [](const Vector2& it) { return it.allFinite(); };
    if (!std::all_of(coordinates.begin(), coordinates.end(), finite))
      return findings_.add(kWrongCoordinates, from_.name);
    mesh.texture_coordinates.reserve(triangles_.size());
    for (const Triple& corners : triangles_)
      mesh.texture_coordinates.push_back(of_corners(corners, coordinates));
  }

  /// Texture coordinates by corner; empty when there are no fitting ones.
  std::vector<Vector2> given_coordinates() {
    const std::size_t count = from_.texture_coordinates.size() / 2;
    if (count == 0) return {};
    const std::vector<std::uint32_t> corners = values(from_.texture_polygons, true, count);
    if (corners.empty()) findings_.add(kWrongCoordinates, from_.name);
    std::vector<Vector2> result;
    result.reserve(corners.size());
    for (const std::uint32_t value : corners) {
      const float* const at = from_.texture_coordinates.data() + 2 * std::size_t(value);
      result.emplace_back(io::from_single(at[0]), io::from_single(at[1]));
    }
    return result;
  }

  /// The picture spans the longest side of the bounds once, and continues at that scale along the next
  /// longest side (VRML 2.0, 6.23); of sides of equal length, x comes before y and y before z.
  std::vector<Vector2> default_coordinates() const {
    base::Bounds box;
    for (const Vector3& position : taken_.mesh.positions) box.extend(position);
    const Vector3 size = box.sizes();
    std::array<int, 3> axes = {0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return size[a] > size[b]; });
    const double longest = size[axes[0]];
    std::vector<Vector2> result;
    result.reserve(taken_.mesh.corners.size());
    for (const std::uint32_t vertex : taken_.mesh.corners) {
      const Vector3 place = taken_.mesh.positions[vertex] - box.min();
      result.push_back(longest > 0.0 ? Vector2(Vector2(place[axes[0]], place[axes[1]]) / longest)
                                     : Vector2(Vector2::Zero()));
    }
    return result;
  }

  const VrmlFaceSet& from_;
  Findings& findings_;
  TakenFaces taken_;
  std::vector<Triple> triangles_;  // corners of taken_
};

}  // namespace

std::shared_ptr<MeshGeometry> mesh_of_faces(const VrmlFaceSet& faces, bool shows_picture, Findings& findings,
                                            io::TimeBudget& time_budget) {
  return FaceMesh(faces, findings).make(shows_picture, time_budget);
}

}  // namespace icome::files
