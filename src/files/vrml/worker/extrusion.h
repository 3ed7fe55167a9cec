#pragma once
#include <array>
#include <vector>

#include "base/vector.h"
#include "files/vrml/worker/made_faces.h"

namespace icome::files {

/// The fields of an Extrusion, in double.
struct ExtrusionFields {
  std::vector<base::Vector2> cross_section = {};  // x and z
  std::vector<base::Vector3> spine = {};
  std::vector<base::Vector2> scales = {};        // at least one; the last is repeated
  std::vector<base::Matrix3> orientations = {};  // likewise
  bool begin_cap = true;
  bool end_cap = true;
};

/// Sweeps the cross section along the spine (ISO/IEC 14772-1, 6.18). Caps are single polygons, concave if the
/// cross section is. A closed spine has none, since nobody could see them.
MadeFaces make_extrusion(const ExtrusionFields& fields);

}  // namespace icome::files
