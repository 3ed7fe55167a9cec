#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "files/crease_normals.h"
#include "files/findings.h"

namespace icome::files {

/// The faces of a list of indices that can be used, and where in the list they stood.
struct TakenFaces {
  PolygonMesh mesh;                     // with the vertices that faces use, in the order of the file
  std::vector<std::uint32_t> slots;     // of each corner in the list
  std::vector<std::uint32_t> vertices;  // of each corner among the positions that were given
  std::vector<std::uint32_t> numbers;   // of each polygon among all faces of the list
};

/// Looks for polygons, which -1 ends, over `positions` (three numbers each), and turns them round if
/// their fronts are not counter-clockwise (`ccw`). Those that name vertices which are not there, have fewer
/// than three corners or too many are left out; `findings` hears of that under `name`.
TakenFaces take_faces(const std::vector<float>& positions, const std::vector<std::int32_t>& polygons,
                      bool ccw, const std::string& name, Findings& findings);

}  // namespace icome::files
