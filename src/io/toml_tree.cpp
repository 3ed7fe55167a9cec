#include "io/toml_tree.h"

#include <fmt/format.h>

#include <algorithm>

// toml++ 3.3 asserts that a key begins behind every '[', though "[=" and "[[[" are only bad TOML, which it
// reports itself a few lines later; without assertions it even lets the compiler rely on that.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expression) static_cast<void>(0)
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace icome::io {
namespace {

Place place_of(const toml::source_region& region) { return {region.begin.line, region.begin.column}; }

TomlNode node_of(const toml::node& source);

void add_members(const toml::table& table, TomlNode& node) {
  for (const auto& [key, value] : table)
    node.members.push_back({std::string(key.str()), place_of(key.source()), node_of(value)});
  // The library sorts by name; errors read better in the order of the file.
  std::ranges::stable_sort(node.members, [](const TomlMember& a, const TomlMember& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
}

/// The library limits how deep values may be nested, and thereby this recursion.
TomlNode node_of(const toml::node& source) {
  TomlNode node;
  node.place = place_of(source.source());
  if (const toml::table* const table = source.as_table()) {
    add_members(*table, node);
  } else if (const toml::array* const array = source.as_array()) {
    node.kind = TomlNode::Kind::Array;
    for (const toml::node& element : *array) node.elements.push_back(node_of(element));
  } else if (const auto* const text = source.as_string()) {
    node.kind = TomlNode::Kind::String;
    node.text = text->get();
  } else if (const auto* const boolean = source.as_boolean()) {
    node.kind = TomlNode::Kind::Boolean;
    node.boolean = boolean->get();
  } else if (source.is_number()) {
    node.kind = TomlNode::Kind::Number;
    node.number =
        source.is_integer() ? double(source.as_integer()->get()) : source.as_floating_point()->get();
  } else {
    node.kind = TomlNode::Kind::Date;
  }
  return node;
}

/// Writes every value with its length before it, so that no two trees give the same bytes.
void write_canonical(const TomlNode& node, std::string& out) {
  const auto write_text = [&](char mark, const std::string& text) {
    out += fmt::format("{}{}:{}", mark, text.size(), text);
  };
  switch (node.kind) {
    case TomlNode::Kind::String:
      return write_text('t', node.text);
    case TomlNode::Kind::Number:
      return write_text('n', fmt::format("{}", node.number));
    case TomlNode::Kind::Boolean:
      return write_text('b', node.boolean ? "1" : "0");
    case TomlNode::Kind::Date:
      return write_text('d', "");
    case TomlNode::Kind::Array:
      break;
    case TomlNode::Kind::Table:
      break;
  }
  out += fmt::format("{}{}:", node.kind == TomlNode::Kind::Array ? 'a' : 'o',
                     node.elements.size() + node.members.size());
  for (const TomlNode& element : node.elements) write_canonical(element, out);
  std::vector<const TomlMember*> sorted;
  for (const TomlMember& member : node.members) sorted.push_back(&member);
  std::ranges::sort(sorted, {}, &TomlMember::key);
  for (const TomlMember* const member : sorted) {
    write_text('k', member->key);
    write_canonical(member->value, out);
  }
}

/// One past the text between quotes that begins at `at`; `lines` counts its ends of lines. A text of one line
/// that is not closed ends with its line.
std::size_t end_of_quoted(std::string_view text, std::size_t at, std::size_t& lines) {
  const char quote = text[at];
  const std::size_t length = text.substr(at, 3) == std::string(3, quote) ? 3 : 1;
  const std::string mark(length, quote);
  for (at += length; at < text.size(); ++at) {
    if (text.substr(at, length) == mark) return at + length;
    if (text[at] == '\n' && length == 1) return at;
    if (text[at] == '\\' && quote == '"') ++at;
    if (at < text.size() && text[at] == '\n') ++lines;
  }
  return text.size();
}

/// The line of a key with more than kMostParts parts, on which the library's recursion would end the program;
/// 0 where there is none. Dots of text and of comments count for nothing.
std::size_t line_of_deep_key(std::string_view text) {
  constexpr int kMostParts = 100;
  constexpr std::string_view kEndsOfKeys = "=,[]{}\n";
  std::size_t line = 1;
  int dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char letter = text[at];
    if (letter == '"' || letter == '\'') {
      at = end_of_quoted(text, at, line);
      continue;
    }
    if (letter == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (letter == '.' && ++dots > kMostParts) return line;
    if (kEndsOfKeys.find(letter) != std::string_view::npos) dots = 0;
    line += letter == '\n' ? 1 : 0;
    ++at;
  }
  return 0;
}

}  // namespace

base::Result<TomlNode> parse_toml(std::string_view text, const std::string& source) {
  if (const std::size_t line = line_of_deep_key(text); line != 0)
    return base::fail(fmt::format("{}:{}: a key has more than 100 parts", source, line));
  const toml::parse_result parsed = toml::parse(text, source);
  if (parsed) return node_of(parsed.table());
  const Place place = place_of(parsed.error().source());
  return base::fail(fmt::format("{}:{}:{}: this is not TOML: {}", source, place.line, place.column,
                                parsed.error().description()));
}

std::uint64_t toml_hash(const TomlNode& node) {
  std::string bytes;
  write_canonical(node, bytes);
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  return hash;
}

}  // namespace icome::io
