#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace icome::benchmarks {

/// How much is measured.
struct DesktopExtent {
  int width = 1280, height = 800;  // pixels
  int frames = 24;
  std::size_t objects = 1000;
  int rows = 515;  // of the large mesh, each of four times as many triangles
};

/// One line of the table. What does not apply stays empty.
struct DesktopRow {
  std::string figure = {};
  std::string unit = "ms";
  double value = 0.0;                             // the median, or the only value there is
  std::optional<double> times_of = std::nullopt;  // a value of the same run that this is held against
  std::string of = {};                            // what that is
};

struct DesktopSection {
  std::string title;
  std::vector<DesktopRow> rows;
};

std::vector<DesktopSection> frame_figures(const DesktopExtent& extent);

}  // namespace icome::benchmarks
