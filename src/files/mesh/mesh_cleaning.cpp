#include "files/mesh/mesh_cleaning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <vector>

#include "files/mesh/mesh_formats.h"

namespace icome::files {
namespace {

bool finite_colour(const world::Colour& colour) {
  return std::all_of(colour.begin(), colour.end(), [](float part) { return std::isfinite(part); });
}

bool finite_triangle(const world::MeshGeometry& shape, std::size_t t) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!shape.mesh.corner(t, int(i)).allFinite()) return false;
    if (!shape.texture_coordinates.empty() && !shape.texture_coordinates[t][i].allFinite()) return false;
    if (!shape.normals.empty() && !shape.normals[t][i].allFinite()) return false;
    if (!shape.colours.empty() && !finite_colour(shape.colours[t][i])) return false;
  }
  return true;
}

template <typename Rows>
void keep_rows(Rows& rows, const std::vector<bool>& kept) {
  if (rows.empty()) return;
  std::size_t next = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) rows[next++] = rows[i];
  }
  rows.resize(next);
}

}  // namespace

base::Result<void> scale(std::vector<geometry::Vector3>& positions, double unit, const std::string& name) {
  if (!(std::isfinite(unit) && unit > 0.0))
    return base::fail("The unit must be a positive number of metres.");
  double farthest = 0.0;
  for (geometry::Vector3& position : positions) {
    position *= unit;
    if (position.allFinite()) farthest = std::max(farthest, position.cwiseAbs().maxCoeff());
  }
  if (farthest <= kFarthest) return {};
  return base::fail(
      fmt::format("{}: has coordinates of {:.2g} m, beyond {:.0g} m: check the file and its unit", name,
                  farthest, kFarthest));
}

std::string drop_not_finite(world::MeshGeometry& shape) {
  std::vector<bool> kept(shape.mesh.triangles.size());
  std::size_t dropped = 0;
  for (std::size_t t = 0; t < kept.size(); ++t) {
    kept[t] = finite_triangle(shape, t);
    dropped += kept[t] ? 0 : 1;
  }
  if (dropped > 0) {
    keep_rows(shape.mesh.triangles, kept);
    keep_rows(shape.texture_coordinates, kept);
    keep_rows(shape.normals, kept);
    keep_rows(shape.colours, kept);
  }
  const auto& positions = shape.mesh.positions;
  if (!std::all_of(positions.begin(), positions.end(), [](const auto& it) { return it.allFinite(); }))
    drop_unused(shape.mesh);
  if (dropped == 0) return {};
  return fmt::format("{} with coordinates that are no numbers left out.",
                     dropped == 1 ? "1 triangle" : fmt::format("{} triangles", dropped));
}

void drop_unused(geometry::TriangleMesh& mesh) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) place[corner] = 0;
  }
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == kUnused) continue;
    mesh.positions[next] = mesh.positions[v];
    place[v] = next++;
  }
  mesh.positions.resize(next);
  mesh.positions.shrink_to_fit();
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) corner = place[corner];
  }
}

std::string as_sentence(std::string note) {
  if (note.empty()) return note;
  note[0] = char(std::toupper(static_cast<unsigned char>(note[0])));
  if (note.back() != '.') note += '.';
  return note;
}

}  // namespace icome::files
