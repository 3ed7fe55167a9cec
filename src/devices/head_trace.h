#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/vector.h"

namespace icome::devices {

/// The pose of a head at a time.
struct HeadSample {
  double time = 0.0;  // s
  /// m; origin between the eyes, looking along -z, y up.
  base::Pose tracker_from_head = base::Pose::Identity();
};

/// Reads a recorded motion of a head: rows `t x y z qx qy qz qw` (s, m, a quaternion of any length but 0)
/// with blanks or commas between the numbers. Empty lines, lines that begin with # and a first line of the
/// names t,x,y,z,qx,qy,qz,qw are passed over. Time may stand still, but not go back. Fails, naming `source`
/// and line, on anything else, and where there is no row.
base::Result<std::vector<HeadSample>> read_head_trace(std::string_view text, const std::string& source);

}  // namespace icome::devices
