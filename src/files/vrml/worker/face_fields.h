#pragma once
#include <span>
#include <string>
#include <vector>

namespace icome::files {

/// The fields of an IndexedFaceSet, or of a node that is turned into one; the data are elsewhere.
struct FaceFields {
  std::span<const float> positions = {};  // three of each
  std::span<const int> polygons = {};
  std::span<const float> texture_coordinates = {};  // two of each
  std::span<const int> texture_polygons = {};
  std::span<const float> normals = {};  // three of each
  std::span<const int> normal_polygons = {};
  bool normal_per_vertex = true;
  std::span<const float> colours = {};  // three of each
  std::span<const int> colour_polygons = {};
  bool colour_per_vertex = true;
};

/// Fields in which every index leads to a finite number and every list fits the faces.
struct CheckedFaces {
  FaceFields fields = {};
  std::vector<std::string> remarks = {};  // half sentences on what was left out
  // Data that had to be rewritten.
  std::vector<float> new_positions = {};
  std::vector<int> new_polygons = {};
  std::vector<int> new_texture_polygons = {};
  std::vector<int> new_normal_polygons = {};
  std::vector<int> new_colour_polygons = {};
};

/// Leaves out faces with fewer than three corners or with missing corners, and each of the other
/// lists that does not fit. `checked` must be empty before.
void check_faces(const FaceFields& fields, CheckedFaces& checked);

}  // namespace icome::files
