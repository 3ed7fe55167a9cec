#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace icome::benchmarks {

/// The sizes of the measurements.
struct DesktopExtent {
  int width = 1280, height = 800;  // pixels
  int frames = 24;
  std::size_t objects = 1000;
  int rows = 515;  // of the large mesh, each with four times as many triangles
};

/// A line of the table. Fields that do not apply stay empty.
struct DesktopRow {
  std::string figure = {};
  std::string unit = "ms";
  double value = 0.0;                             // the median, or the only value there is
  std::optional<double> times_of = std::nullopt;  // a value of the same run that this is compared with
  std::string of = {};                            // name of that value
};

struct DesktopSection {
  std::string title;
  std::vector<DesktopRow> rows;
};

std::vector<DesktopSection> frame_figures(const DesktopExtent& extent);

}  // namespace icome::benchmarks
