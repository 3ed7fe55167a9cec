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
  bool force = false;  // replaces a file that holds what would be lost
  bool json = false;
};

/// What a person asked `icome edit` for.
struct EditOptions {
  std::string in;                // a design's file, or kNewDesign
  std::filesystem::path apply;   // operations, one a line; "-": standard input
  std::filesystem::path replay;  // a recorded technique, in place of them
  std::filesystem::path out;
  std::string unit = "m";
  bool keep_going = false;
  bool force = false;     // replaces a file that holds what would be lost
  bool help_ops = false;  // only tell what operations there are
  std::string operation;  // then: only this one; empty: all
  bool json = false;
};

/// What begins with an empty design, in place of a file.
constexpr const char* kNewDesign = "new";

}  // namespace icome::apps
