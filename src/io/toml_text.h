#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace icome::io {

/// A text as TOML has it, between quotes.
std::string quoted_toml(std::string_view text);

/// Gathers the values of a TOML table, to be written a line each, or as an inline table.
class TomlFields {
 public:
  void add(std::string_view key, double number);
  void add(std::string_view key, int number) { add_text(key, std::to_string(number)); }
  void add(std::string_view key, bool flag) { add_text(key, flag ? "true" : "false"); }
  void add(std::string_view key, std::string_view text) { add_text(key, quoted_toml(text)); }
  void add(std::string_view key, const char* text) { add(key, std::string_view(text)); }
  void add(std::string_view key, const std::vector<std::string>& texts);
  void add(std::string_view key, const TomlFields& fields) { add_text(key, fields.inline_table()); }
  /// A value that is TOML already.
  void add_text(std::string_view key, std::string_view toml);

  /// "key = value" lines; and "{ key = value, ... }".
  std::string lines() const;
  std::string inline_table() const;

 private:
  std::vector<std::string> fields_;
};

/// "[a, b, c]"; numbers come back to the last bit.
std::string toml_numbers(const std::vector<double>& numbers);

}  // namespace icome::io
