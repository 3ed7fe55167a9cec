#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "files/crease_normals.h"
#include "files/findings.h"

namespace icome::files {

/// The usable faces of a list of indices, with their places in the list.
struct TakenFaces {
  PolygonMesh mesh;                     // with the vertices that faces use, in the order of the file
  std::vector<std::uint32_t> slots;     // places in the list of indices, by corner
  std::vector<std::uint32_t> vertices;  // by corner, among the positions that were given
  std::vector<std::uint32_t> numbers;   // by polygon, among all faces of the list
};

/// Gathers polygons, which -1 ends, over `positions` (three numbers each), and turns them round if their
/// fronts are not counter-clockwise (`ccw`). Those that name missing vertices, have fewer than three
/// corners or too many are left out; `findings` gets that under `name`.
TakenFaces take_faces(const std::vector<float>& positions, const std::vector<std::int32_t>& polygons,
                      bool ccw, const std::string& name, Findings& findings);

}  // namespace icome::files
