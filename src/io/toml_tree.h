#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::io {

/// A place in a text file, line and column both counted from 1; 0 for no place.
struct Place {
  std::size_t line = 0;
  std::size_t column = 0;
};

struct TomlMember;

/// A value of a TOML file, with its place.
struct TomlNode {
  enum class Kind : std::uint8_t { Table, Array, String, Number, Boolean, Date };
  Kind kind = Kind::Table;
  Place place;
  std::string text;
  double number = 0.0;
  bool boolean = false;
  std::vector<TomlNode> elements;
  std::vector<TomlMember> members;  // in the order of the file
};

struct TomlMember {
  std::string key;
  Place place;  // of the key
  TomlNode value;
};

/// Reads TOML 1.0. Fails with the source, line and column of the text that is not TOML.
base::Result<TomlNode> parse_toml(std::string_view text, const std::string& source);

/// A hash that is equal for files with the same contents: comments, layout, the order of keys and the
/// spelling of numbers do not count.
std::uint64_t toml_hash(const TomlNode& node);

}  // namespace icome::io
