#pragma once
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "geometry/loop/loop_levels.h"

namespace icome::geometry {

/// The sharp edges and vertices of one level of a mesh. Boundaries are not listed: the mesh shows them.
struct LoopSharpness {
  std::unordered_set<std::uint64_t> edges;  // by edge_key
  std::unordered_set<std::uint32_t> corners;

  static std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return a < b ? std::uint64_t(a) << 32 | b : std::uint64_t(b) << 32 | a;
  }
};

/// Fills `corner_normals` and `normals` of a level whose mesh and faces around vertices are known: the
/// normals of the limit surface by tangent masks, left eigenvectors of the matrix that refines a vertex and
/// its neighbours. Interior vertices: thesis 5.4.3. Vertices of boundaries, creases and darts have their own.
void find_limit_normals(LoopLevel& level, const LoopSharpness& sharp);

}  // namespace icome::geometry
