#pragma once
#include <string>

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// The options of icome keep.
struct KeepOptions {
  std::string address;
  bool forget = false;
  bool list = false;
  bool json = false;
};

void add_keep(CLI::App& app, KeepOptions& options);
/// Keeps a design of a server on this machine, forgets one, or lists them. Gives the exit code.
int run_keep(const KeepOptions& options);

}  // namespace icome::apps
