#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace icome::apps {

/// The options for reading designs, as the command line gives them.
struct ReadingOptions {
  std::string unit = "m";  // of numbers in formats that name none: files::parse_unit
  std::string up;          // the axis that points up in the file: "y", "z"; empty: as its format has it
  std::optional<double> memory_mb;  // that reading may take; none: as the file allows
  std::optional<double> seconds;    // that reading may take
  bool urls_above = false;          // follow urls to files above the design's folder
};

/// The options of `icome info`, as the command line gives them.
struct InfoOptions {
  std::filesystem::path file;
  ReadingOptions reading;
  std::size_t most_objects = 30;  // lines of the tree; 0: all
  bool json = false;
};

/// The options of `icome convert`.
struct ConvertOptions {
  std::filesystem::path in;
  std::filesystem::path out;
  ReadingOptions reading;
  std::string into;  // the object that the design goes under, where `out` is on a server; empty: as new roots
  bool force = false;  // replaces a file even if some of it would be lost
  bool json = false;
};

/// The options of `icome edit`.
struct EditOptions {
  std::string in;                // a design's file, or kNewDesign
  std::filesystem::path apply;   // operations, one a line; "-": standard input
  std::filesystem::path replay;  // a recorded technique, in place of them
  std::filesystem::path out;
  ReadingOptions reading;
  bool keep_going = false;
  bool force = false;     // replaces a file even if some of it would be lost
  bool help_ops = false;  // only list the operations
  std::string operation;  // then: only this one; empty: all
  bool watch = false;     // of a design on a server: tell what happens, until interrupted
  bool json = false;
};

/// The name that stands for an empty design, in place of a file.
constexpr const char* kNewDesign = "new";

}  // namespace icome::apps
