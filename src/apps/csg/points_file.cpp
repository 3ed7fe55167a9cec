#include "apps/csg/points_file.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "io/file_bytes.h"
#include "io/number_rows.h"

namespace icome::apps {
namespace {

constexpr std::uint64_t kLargestPointsFile = 8ULL << 30U;  // bytes

}  // namespace

base::Result<std::vector<base::Vector3>> read_points(const std::filesystem::path& path) {
  const auto bytes = io::read_bytes(path, kLargestPointsFile);
  if (!bytes) return tl::unexpected(bytes.error());
  std::vector<base::Vector3> points;
  points.reserve(static_cast<std::size_t>(std::count(bytes->begin(), bytes->end(), '\n')));
  const auto add = [&](std::span<const double> row) -> base::Result<void> {
    points.emplace_back(row[0], row[1], row[2]);
    return {};
  };
  if (const auto read = io::read_number_rows(*bytes, path.string(), "xyz", add); !read)
    return tl::unexpected(read.error());
  return points;
}

}  // namespace icome::apps
