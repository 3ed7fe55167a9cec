#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::files {

enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

/// Bytes of one number in a binary file.
std::size_t size_of(PlyType type);

/// One column of an element's rows: a number, or a list that begins with its length.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;     ///< of the number, or of the list's members
  std::optional<PlyType> length_type;  ///< set for lists
};

/// A table of the file, such as "vertex" or "face".
struct PlyElement {
  std::string name;
  std::uint64_t rows = 0;  ///< as declared: not to be trusted
  std::vector<PlyProperty> properties;

  /// Least bytes of a row in a binary file (with empty lists).
  std::size_t smallest_row() const;
  /// The column of that name, or nothing.
  std::optional<std::size_t> column(std::string_view property) const;
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes up to the first row
};

/// Reads the header at the beginning of `bytes`. Errors name the line.
base::Result<PlyHeader> parse_ply_header(std::string_view bytes, const std::string& name);

}  // namespace icome::files
