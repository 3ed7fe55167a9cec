#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// The options of icome menu.
struct MenuOptions {
  std::filesystem::path file;
  std::string language;                       // empty: the first of the file
  std::optional<std::filesystem::path> path;  // tip path to try it with
  std::string choose = "click";               // or push
  std::string device = "touch";               // profile whose limits are kept while trying
  std::optional<std::filesystem::path> picture;
  std::optional<std::filesystem::path> design;  // drawn behind it
  std::string theme = "light";
  std::string show = {};  // an item that is brought into sight first; empty: none
  bool json = false;
};

void add_menu(CLI::App& app, MenuOptions& options);
/// Shows where the items of a haptic element lie, tries it with a path, draws it. Gives the exit code.
int run_menu(const MenuOptions& options);

}  // namespace icome::apps
