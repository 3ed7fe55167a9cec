#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "files/findings.h"
#include "io/time_budget.h"
#include "world/shape/mesh_geometry.h"

namespace icome::files {

/// The fields of an IndexedFaceSet (VRML 2.0, 6.23), none of them checked. -1 ends a face in lists of
/// indices.
struct VrmlFaceSet {
  std::string name = {};  // for findings
  std::vector<float> positions = {};
  std::vector<std::int32_t> polygons = {};
  std::vector<float> texture_coordinates = {};
  std::vector<std::int32_t> texture_polygons = {};
  std::vector<float> normals = {};
  std::vector<std::int32_t> normal_polygons = {};
  bool normal_per_vertex = true;
  std::vector<float> colours = {};
  std::vector<std::int32_t> colour_polygons = {};
  bool colour_per_vertex = true;
  bool ccw = true;
  double crease_angle = 0.0;  // rad
};

/// The triangles of the faces. Faces that name missing vertices, or have fewer than three corners, are
/// left out, as are normals, colours and texture coordinates that do not fit; all faults go to
/// `findings`. Where a picture is shown, missing texture coordinates are made. Null when no triangle is
/// left, or when the time budget ends.
std::shared_ptr<world::MeshGeometry> mesh_of_faces(const VrmlFaceSet& faces, bool shows_picture,
                                                   Findings& findings, io::TimeBudget& time_budget);

}  // namespace icome::files
