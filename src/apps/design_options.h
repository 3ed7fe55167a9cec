#pragma once
#include <filesystem>
#include <string>

namespace icome::apps {

/// What a person asked `icome info` for, as the command line says it.
struct InfoOptions {
  std::filesystem::path file;
  std::string unit = "m";         // of numbers in formats that name none
  std::size_t most_objects = 30;  // lines of the tree; 0: all
  bool json = false;
};

/// What a person asked `icome convert` for.
struct ConvertOptions {
  std::filesystem::path in;
  std::filesystem::path out;
  std::string unit = "m";
  bool json = false;
};

}  // namespace icome::apps
