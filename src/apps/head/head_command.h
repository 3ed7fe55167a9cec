#pragma once
#include <filesystem>
#include <optional>

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// The options of icome head.
struct HeadOptions {
  std::filesystem::path trace;
  std::filesystem::path out;
  std::optional<std::filesystem::path> table;  // nothing: table 5.4 of the thesis
  bool print_table = false;
  bool json = false;
};

void add_head(CLI::App& app, HeadOptions& options);
/// Makes the movement of the view of a recorded motion of a head. Gives the exit code.
int run_head(const HeadOptions& options);

}  // namespace icome::apps
