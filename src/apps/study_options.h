#pragma once
#include <filesystem>
#include <string>

namespace icome::apps {

/// What a person asked `icome study` for.
struct StudyOptions {
  std::string task;  // the subcommand: "new", "check"
  std::filesystem::path file;
  std::string from = "blank";  // of new: the template
  bool json = false;
};

}  // namespace icome::apps
