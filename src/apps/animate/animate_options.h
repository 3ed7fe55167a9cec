#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// The options of icome animate.
struct AnimateOptions {
  bool is_wanted = false;  // this command was named
  std::filesystem::path project;
  bool open = false;  // in a window
  std::string theme;  // of the window

  bool is_new = false;  // the project is an empty one
  std::filesystem::path apply;
  bool keep_going = false;
  std::filesystem::path save;
  bool help_tools = false;
  std::string tool;

  std::filesystem::path out;
  std::string frames;  // "A-B"; empty: all
  double scale = 1;
  bool clear = false;  // without the background
  bool json = false;

  std::string record;  // the source of frames of the table
  std::filesystem::path known;
  std::filesystem::path view;
  std::vector<double> table;  // width and height, mm; empty: 640 x 480
  std::string layer;          // the only one that is recorded
  int from = 0;               // frame
  double seconds = 0;         // 0: to the end of the source
  double thin = 0.25;         // px
};

void add_animate(CLI::App& app, AnimateOptions& options);

}  // namespace icome::apps
