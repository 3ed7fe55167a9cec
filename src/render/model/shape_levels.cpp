#include "render/model/shape_levels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace icome::render {
namespace {

using Eigen::Vector3f;

constexpr std::size_t kFewestTriangles = 300;  // nothing is gained with fewer
constexpr double kWorthwhile = 0.6;            // of the triangles of the level before
constexpr double kCoarsestCell = 1.0 / 4.0;
constexpr float kSameSide = 0.7F;  // cosine: normals that differ more are those of an edge
constexpr std::uint32_t kNone = 0xffffffff;
constexpr std::size_t kSides = 6;

/// Numbers of cells in the order in which they are first met.
class CellNumbers {
 public:
  explicit CellNumbers(std::size_t most)
      : mask_(std::bit_ceil(2 * most + 2) - 1), keys_(mask_ + 1), numbers_(mask_ + 1, kNone) {}

  std::uint32_t number(std::uint32_t key) {
    std::size_t slot = (std::size_t(key) * 0x9e3779b97f4a7c15U >> 20U) & mask_;
    while (numbers_[slot] != kNone && keys_[slot] != key) slot = (slot + 1) & mask_;
    if (numbers_[slot] == kNone) {
      keys_[slot] = key;
      numbers_[slot] = count_++;
    }
    return numbers_[slot];
  }
  std::uint32_t count() const { return count_; }

 private:
  std::size_t mask_;
  std::vector<std::uint32_t> keys_, numbers_;
  std::uint32_t count_ = 0;
};

/// Buffers span about -1 ... 1; a little more is let in for rounding.
std::uint32_t cell_key(const Vector3f& p, float cells_a_unit) {
  std::uint32_t key = 0;
  for (int k = 0; k < 3; ++k) {
    const float at = std::clamp((p[k] + 1.0F) * cells_a_unit + 1.0F, 0.0F, 1023.0F);
    key = key << 10U | std::uint32_t(at);
  }
  return key;
}

/// The side of a box, one of six, to which the normal points most.
std::size_t side_of(const Vector3f& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * std::size_t(axis) + (normal[axis] < 0.0F ? 1 : 0);
}

/// The vertices in one cell, merged.
struct Cell {
  Vector3f position = Vector3f::Zero();
  float members = 0.0F;
  std::array<std::uint32_t, kSides> vertices = {kNone, kNone, kNone, kNone, kNone, kNone};  // of the new mesh
};

class Clustering {
 public:
  Clustering(const ShadingMesh& mesh, std::span<const Vector3f> colours, double cell)
      : mesh_(mesh), colours_(colours), vertex_(mesh.vertices.size()) {
    made_.cell = cell;
    made_.mesh.centre = mesh.centre;
    made_.mesh.radius = mesh.radius;
  }

  ShapeLevel run() {
    gather();
    merge_normals();
    for (Cell& cell : cells_) {
      for (const std::uint32_t v : cell.vertices) {
        if (v != kNone) made_.mesh.vertices[v].position = cell.position / cell.members;
      }
    }
    for (std::size_t v = 0; v < made_.colours.size(); ++v) made_.colours[v] /= members_[v];
    keep_triangles();
    return std::move(made_);
  }

 private:
  void gather() {
    CellNumbers numbers(mesh_.vertices.size());
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      const ShadingMesh::Vertex& own = mesh_.vertices[v];
      const std::uint32_t number = numbers.number(cell_key(own.position, float(1.0 / made_.cell)));
      if (number == cells_.size()) cells_.emplace_back();
      Cell& cell = cells_[number];
      cell.position += own.position;
      cell.members += 1.0F;
      vertex_[v] = vertex_of(cell, number, side_of(own.normal));
      made_.mesh.vertices[vertex_[v]].normal += own.normal;
      members_[vertex_[v]] += 1.0F;
      if (!colours_.empty()) made_.colours[vertex_[v]] += colours_[v];
    }
  }

  std::uint32_t vertex_of(Cell& cell, std::uint32_t number, std::size_t side) {
    if (cell.vertices[side] != kNone) return cell.vertices[side];
    cell.vertices[side] = std::uint32_t(made_.mesh.vertices.size());
    made_.mesh.vertices.push_back({Vector3f::Zero(), Vector3f::Zero()});
    members_.push_back(0.0F);
    cell_of_.push_back(number);
    if (!colours_.empty()) made_.colours.push_back(Vector3f::Zero());
    return cell.vertices[side];
  }

  /// Gives all sides of a cell the same normal where the surface is smooth: no seams where one side's part
  /// meets another's.
  void merge_normals() {
    for (const Cell& cell : cells_) {
      std::array<Vector3f, kSides> sums, units;
      for (std::size_t s = 0; s < kSides; ++s) {
        sums[s] = cell.vertices[s] == kNone ? Vector3f::Zero() : made_.mesh.vertices[cell.vertices[s]].normal;
        units[s] = sums[s].normalized();
      }
      for (std::size_t s = 0; s < kSides; ++s) {
        if (cell.vertices[s] == kNone) continue;
        Vector3f normal = Vector3f::Zero();
        for (std::size_t other = 0; other < kSides; ++other) {
          if (units[s].dot(units[other]) > kSameSide || other == s) normal += sums[other];
        }
        made_.mesh.vertices[cell.vertices[s]].normal = normal.normalized();
      }
    }
  }

  void keep_triangles() {
    for (std::size_t i = 0; i + 2 < mesh_.indices.size(); i += 3) {
      const std::uint32_t a = vertex_[mesh_.indices[i]];
      const std::uint32_t b = vertex_[mesh_.indices[i + 1]];
      const std::uint32_t c = vertex_[mesh_.indices[i + 2]];
      if (cell_of_[a] == cell_of_[b] || cell_of_[b] == cell_of_[c] || cell_of_[c] == cell_of_[a]) continue;
      made_.mesh.indices.insert(made_.mesh.indices.end(), {a, b, c});
    }
  }

  const ShadingMesh& mesh_;
  std::span<const Vector3f> colours_;
  std::vector<std::uint32_t> vertex_;  // of the new mesh, by that of the old
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> cell_of_;  // by vertex of the new mesh
  std::vector<float> members_;          // by vertex of the new mesh
  ShapeLevel made_;
};

}  // namespace

std::vector<ShapeLevel> make_shape_levels(const ShadingMesh& mesh, std::span<const Vector3f> colours) {
  std::vector<ShapeLevel> levels;
  const ShadingMesh* finer = &mesh;
  std::span<const Vector3f> finer_colours = colours;
  levels.reserve(7);  // levels stay where they are
  for (double cell = kFinestCell; cell <= kCoarsestCell; cell *= 2.0) {
    if (finer->indices.size() < 3 * kFewestTriangles) break;
    ShapeLevel level = Clustering(*finer, finer_colours, cell).run();
    if (double(level.mesh.indices.size()) > kWorthwhile * double(finer->indices.size())) continue;
    if (level.mesh.indices.empty()) break;
    levels.push_back(std::move(level));
    finer = &levels.back().mesh;
    finer_colours = levels.back().colours;
  }
  return levels;
}

}  // namespace icome::render
