#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// A mesh with some triangles cut into smaller ones, and the origin of each piece.
struct TriangleSubdivision {
  /// A place on the parent is (u, v): the weights of its corners are 1 - u - v, u and v. Exact, as halving
  /// gives few binary digits.
  struct Piece {
    std::uint32_t parent = 0;                     // the original triangle, before all levels
    bool selected = false;                        // does it descend from the selection?
    std::array<Eigen::Vector2f, 3> corners = {};  // places of its corners on the parent
  };

  TriangleMesh mesh;  // the original vertices keep their places; pieces of one parent follow each other
  std::vector<Piece> pieces;  // one for each triangle of `mesh`, parents in ascending order
};

/// More triangles than this are refused.
inline constexpr std::size_t kMostSubdivided = 20'000'000;

/// Cuts the selected triangles (repeats do not matter) into four at the middles of their edges, then those
/// four, `levels` times. Their neighbours are cut to fit, so that no vertex comes to lie on the edge of a
/// triangle that does not use it: in two where one side is cut, in three (along the shorter diagonal) where
/// two are, in four where all are. What was closed stays closed, and the shape stays as it was. An edge has
/// one middle however many triangles share it; edges are told apart by their vertex indices, so weld first.
/// Equal arguments give the same mesh.
///
/// Triangles back to back stay so, which makes the edges between their middles ones of four triangles.
/// Fails on meshes with non-finite vertices or wrong indices, and when the result would be too large.
base::Result<TriangleSubdivision> subdivide_triangles(const TriangleMesh& mesh,
                                                      std::span<const std::uint32_t> selection, int levels);

/// A value at a place on a triangle with these values at its corners. Exact at the corners and where the
/// corners agree, and the same from both triangles of an edge. Values have [] and size(), such as vectors.
template <typename Value>
Value blend_corners(const std::array<Value, 3>& corners, const Eigen::Vector2f& place) {
  const double u = place.x(), v = place.y();
  const double rest = 1.0 - u - v;
  Value result = corners[0];
  for (std::size_t i = 0; i < std::size_t(result.size()); ++i) {
    if (corners[0][i] == corners[1][i] && corners[0][i] == corners[2][i]) continue;
    const double sum = rest * corners[0][i] + u * corners[1][i] + v * corners[2][i];
    result[i] = static_cast<std::remove_reference_t<decltype(result[i])>>(sum);
  }
  return result;
}

/// Values at the corners of triangles, such as texture coordinates, brought to the corners of the pieces.
/// `of_parents` has one entry for each triangle that was subdivided, or none; unit normals are to be made
/// unit again.
template <typename Value>
std::vector<std::array<Value, 3>> carry_corners(const TriangleSubdivision& subdivision,
                                                const std::vector<std::array<Value, 3>>& of_parents) {
  std::vector<std::array<Value, 3>> result;
  if (of_parents.empty()) return result;
  result.reserve(subdivision.pieces.size());
  for (const TriangleSubdivision::Piece& piece : subdivision.pieces) {
    const std::array<Value, 3>& parent = of_parents[piece.parent];
    result.push_back({blend_corners(parent, piece.corners[0]), blend_corners(parent, piece.corners[1]),
                      blend_corners(parent, piece.corners[2])});
  }
  return result;
}

}  // namespace icome::geometry
