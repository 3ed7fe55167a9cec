#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/vector.h"
#include "io/new_file.h"

namespace icome::files {

/// Lays out VRML 2.0, indented, into a file that it does not own. Numbers are written as the shortest text
/// of their single-precision value, as all readers keep them: 0.9, never -0.
class VrmlText {
 public:
  explicit VrmlText(io::NewFile& file) : file_(file) {}

  /// Adds finished VRML, of one line or several.
  void add(std::string_view vrml);

  /// `head` is the text before the brace: "geometry DEF wheel Cylinder".
  void open(std::string_view head);
  void close();
  /// A field of many values, such as children and rows.
  void open_list(std::string_view name);
  void close_list();

  void field(std::string_view name, bool value);
  void field(std::string_view name, double value);
  void field(std::string_view name, std::span<const float> values);
  void field(std::string_view name, const base::Vector3& value);
  /// A string, in quotes.
  void text_field(std::string_view name, std::string_view value);
  void text_row(std::string_view value);

  void row(std::span<const float> values);
  void row(const base::Vector3& value);
  /// The corners of a polygon, and the -1 after them.
  void polygon(std::span<const std::uint32_t> indices);
  void indices(std::span<const std::uint32_t> values);

  /// Writes the rest of the buffer to the file.
  void finish();
  /// Was a number too large for single precision? The largest finite one is written for it.
  bool clipped() const { return clipped_; }

 private:
  void begin_line();
  void begin_field(std::string_view name);
  void append(float value);
  void append(std::span<const std::uint32_t> values);
  void append_quoted(std::string_view value);
  float single(double value);

  io::NewFile& file_;
  std::string buffer_;
  int depth_ = 0;
  bool empty_ = false;  // nothing is written yet in the innermost node or list
  bool clipped_ = false;
};

}  // namespace icome::files
