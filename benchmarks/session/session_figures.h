#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace icome::benchmarks {

/// The sizes of the measurements.
struct SessionExtent {
  int edits = 60;         // of each kind
  int grid = 708;         // squares along each side of the large mesh: two triangles each
  double seconds = 10.0;  // of servo for each row
  int starts = 5;
  int most_objects = 100'000;       // beside the one that is moved
  std::filesystem::path demo = {};  // the design that start-up is measured with
};

/// A line of the table. Fields that do not apply stay empty.
struct SessionRow {
  std::string figure = {};
  std::string unit = "ms";
  double median = 0.0;
  std::optional<double> high = {};  // 99.9 %
  std::optional<double> worst = {};
  std::optional<double> times_of = {};  // a median of the same run that this one's is compared with
  std::string of = {};                  // name of that value
};

struct SessionSection {
  std::string title;
  std::vector<SessionRow> rows;
};

SessionSection scale_figures(const SessionExtent& extent);
SessionSection felt_figures(const SessionExtent& extent);
SessionSection seen_figures(const SessionExtent& extent);
SessionSection servo_figures(const SessionExtent& extent);
SessionSection start_figures(const SessionExtent& extent);

/// Row with the median and the worst of the values, which are in `unit`.
SessionRow row_of(const std::string& figure, std::vector<double> values, const std::string& unit = "ms");

void print_sections(const std::vector<SessionSection>& sections);

}  // namespace icome::benchmarks
