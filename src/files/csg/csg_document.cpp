#include "files/csg/csg_document.h"

#include <fmt/format.h>

#include <algorithm>

namespace icome::files {

CsgDocument::Index CsgDocument::value_end(Index index) const {
  const Value& found = values_[index];
  return found.kind == Kind::Vector ? static_cast<Index>(found.number) : index + 1;
}

CsgDocument::Index CsgDocument::arguments_end(Index statement) const {
  return statement + 1 < statements_.size() ? statements_[statement + 1].first_argument
                                            : static_cast<Index>(arguments_.size());
}

std::string_view CsgDocument::name(const Statement& statement) const {
  return text_.substr(statement.offset, statement.name_length);
}

std::string_view CsgDocument::name(const Argument& argument) const {
  return text_.substr(argument.name, argument.name_length);
}

std::string CsgDocument::string(const Value& value) const {
  std::string characters;
  for (std::size_t at = value.offset + 1; text_[at] != '"'; ++at) {
    if (text_[at] == '\\') ++at;
    characters += text_[at];
  }
  return characters;
}

std::size_t CsgDocument::line_breaks(Offset from, Offset to) const {
  const std::string_view between = text_.substr(from, to - from);
  return static_cast<std::size_t>(std::count(between.begin(), between.end(), '\n'));
}

base::Error CsgDocument::error_at(Offset offset, const std::string& message) const {
  const std::string_view before = text_.substr(0, offset);
  const std::size_t line_begin = before.rfind('\n') + 1;  // 0 in the first line: npos + 1
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; };  // UTF-8
  const std::string_view in_line = before.substr(line_begin);
  const std::size_t column =
      1 + in_line.size() - static_cast<std::size_t>(std::count_if(in_line.begin(), in_line.end(), continues));
  return {fmt::format("{}:{}:{}: {}", name_, line(offset), column, message)};
}

const char* kind_name(CsgDocument::Kind kind) {
  switch (kind) {
    case CsgDocument::Kind::Undefined:
      return "undef";
    case CsgDocument::Kind::Boolean:
      return "true or false";
    case CsgDocument::Kind::Number:
      return "a number";
    case CsgDocument::Kind::String:
      return "a string";
    case CsgDocument::Kind::Vector:
      return "a vector";
  }
  return "nothing";
}

}  // namespace icome::files
