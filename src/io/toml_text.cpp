#include "io/toml_text.h"

#include <fmt/format.h>

#include "io/number_text.h"

namespace icome::io {

std::string quoted_toml(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') quoted += '\\';
    code < 0x20U || code == 0x7fU ? quoted += fmt::format("\\u{:04X}", unsigned(code)) : quoted += letter;
  }
  return quoted + "\"";
}

void TomlFields::add(std::string_view key, double number) {
  std::string text;
  append_number(text, number);
  add_text(key, text);
}

void TomlFields::add(std::string_view key, const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list.append(list.empty() ? "" : ", ").append(quoted_toml(text));
  add_text(key, fmt::format("[{}]", list));
}

void TomlFields::add_text(std::string_view key, std::string_view toml) {
  fields_.push_back(fmt::format("{} = {}", key, toml));
}

std::string TomlFields::lines() const {
  std::string text;
  for (const std::string& field : fields_) text.append(field).append("\n");
  return text;
}

std::string TomlFields::inline_table() const {
  std::string text;
  for (const std::string& field : fields_) text.append(text.empty() ? "" : ", ").append(field);
  return fmt::format("{{ {} }}", text);
}

std::string toml_numbers(const std::vector<double>& numbers) {
  std::string list;
  for (const double number : numbers) {
    list.append(list.empty() ? "" : ", ");
    append_number(list, number);
  }
  return fmt::format("[{}]", list);
}

}  // namespace icome::io
