#pragma once
#include <vector>

namespace icome::files {

/// Faces that are made here from what a node says, in the form of an IndexedFaceSet. Equal corners are one.
struct MadeFaces {
  std::vector<float> positions = {};
  std::vector<int> polygons = {};
  std::vector<float> texture_coordinates = {};  // one of each corner in `texture_polygons`
  std::vector<int> texture_polygons = {};
};

}  // namespace icome::files
