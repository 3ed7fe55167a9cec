#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/vector.h"

namespace icome::apps {

/// Reads points from a CSV file with the header x,y,z. The error names file and line: another header, a row
/// without three numbers, a number that is not finite.
base::Result<std::vector<base::Vector3>> read_points(const std::filesystem::path& path);

}  // namespace icome::apps
