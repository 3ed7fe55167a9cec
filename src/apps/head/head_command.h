#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// The options of icome head.
struct HeadOptions {
  std::filesystem::path trace;
  std::filesystem::path out;
  std::optional<std::filesystem::path> table;  // nothing: table 5.4 of the thesis
  std::string filter = "mean";                 // a name of interaction::head_filter_of()
  std::optional<double> predict_ms;
  bool compare = false;
  std::string calibrate;          // a head camera to be calibrated
  double distance = 0.6;          // m, from that camera to the head
  std::string record;             // a head camera to be recorded
  std::optional<double> seconds;  // of the camera; nothing: 10, or all of a recording
  bool print_table = false;
  bool json = false;

  bool is_given() const { return print_table || !trace.empty() || !calibrate.empty() || !record.empty(); }
};

void add_head(CLI::App& app, HeadOptions& options);
/// Makes the movement of the view of a recorded motion of a head. Gives the exit code.
int run_head(const HeadOptions& options);

}  // namespace icome::apps
