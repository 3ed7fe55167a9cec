#include "io/key_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace icome::io {
namespace {

constexpr std::size_t kMostTold = 50;
constexpr std::size_t kLongestId = 64;

/// The kind in the words of a message: "a number".
const char* kind_name(TomlNode::Kind kind) {
  switch (kind) {
    case TomlNode::Kind::Table:
      return "a table";
    case TomlNode::Kind::Array:
      return "an array";
    case TomlNode::Kind::String:
      return "text";
    case TomlNode::Kind::Number:
      return "a number";
    case TomlNode::Kind::Boolean:
      return "true or false";
    case TomlNode::Kind::Date:
      break;
  }
  return "a date or a time";
}

bool is_blank(const std::string& text) { return text.find_first_not_of(" \t\r\n") == std::string::npos; }

}  // namespace

std::string Problems::text(const std::string& source) const {
  std::vector<Problem> sorted = all_;
  std::ranges::stable_sort(sorted, [](const Problem& a, const Problem& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(sorted.size(), kMostTold); ++i)
    text += fmt::format("{}{}:{}:{}: {}", i == 0 ? "" : "\n", source, sorted[i].place.line,
                        sorted[i].place.column, sorted[i].sentence);
  if (sorted.size() > kMostTold) text += fmt::format("\nand {} more.", sorted.size() - kMostTold);
  return text;
}

bool is_id(std::string_view text) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !text.empty() && text.size() <= kLongestId && std::ranges::all_of(text, fits);
}

bool KeyReader::has(std::string_view key) const {
  return std::ranges::find(table_.members, key, &TomlMember::key) != table_.members.end();
}

Place KeyReader::place_of(std::string_view key) const {
  const auto found = std::ranges::find(table_.members, key, &TomlMember::key);
  return found == table_.members.end() ? table_.place : found->value.place;
}

const TomlNode* KeyReader::take(const std::string& key) {
  known_.push_back(key);
  const auto found = std::ranges::find(table_.members, key, &TomlMember::key);
  return found == table_.members.end() ? nullptr : &found->value;
}

const TomlNode* KeyReader::take(const std::string& key, TomlNode::Kind kind, const char* wanted) {
  const TomlNode* const node = take(key);
  if (node == nullptr || node->kind == kind) return node;
  add_problem(node->place, key, fmt::format("is {}; write {}", kind_name(node->kind), wanted));
  return nullptr;
}

void KeyReader::add_problem(Place place, const std::string& key, const std::string& sentence) {
  const bool ended = sentence.ends_with('?');
  problems_.add(place, fmt::format("{}: {} {}{}", what_, key, sentence, ended ? "" : "."));
}

void KeyReader::require(const std::string& key, const std::string& what_to_write) {
  if (!has(key)) add_problem(place(), key, fmt::format("is missing; write {}", what_to_write));
}

std::string KeyReader::checked_id(const TomlNode& node, const std::string& key) {
  if (is_id(node.text)) return node.text;
  add_problem(node.place, key,
              fmt::format("is '{}'; write letters, digits, - and _, at most {}",
                          node.text.substr(0, kLongestId), kLongestId));
  return {};
}

std::string KeyReader::id(const std::string& key) {
  require(key, fmt::format("{} = \"a-short-name\"", key));
  return reference(key);
}

std::string KeyReader::reference(const std::string& key) {
  const TomlNode* const node = take(key, TomlNode::Kind::String, "a name between quotes");
  return node == nullptr ? std::string() : checked_id(*node, key);
}

std::string KeyReader::plain(const std::string& key) {
  const TomlNode* const node = take(key, TomlNode::Kind::String, "text between quotes");
  return node == nullptr ? std::string() : node->text;
}

void KeyReader::read_translations(const TomlNode& node, const std::string& key, Translations& text) {
  for (const TomlMember& member : node.members) {
    const auto found = std::ranges::find(languages_, member.key);
    if (found == languages_.end()) {
      add_problem(member.place, key,
                  fmt::format("has a text in '{}', which is none of the languages of the file", member.key));
    } else if (member.value.kind != TomlNode::Kind::String) {
      add_problem(
          member.value.place, key,
          fmt::format("in '{}' is {}; write text between quotes", member.key, kind_name(member.value.kind)));
    } else {
      text[std::size_t(found - languages_.begin())] = member.value.text;
    }
  }
  for (std::size_t i = 0; i < languages_.size(); ++i)
    if (is_blank(text[i])) add_problem(node.place, key, fmt::format("has no text in '{}'", languages_[i]));
}

Translations KeyReader::text(const std::string& key, bool required) {
  Translations text(languages_.size());
  const TomlNode* const node = take(key);
  if (node == nullptr) {
    if (required) require(key, fmt::format("{} = {{ {} = \"...\" }}", key, languages_.front()));
    return required ? text : Translations();
  }
  if (node->kind == TomlNode::Kind::Table) {
    read_translations(*node, key, text);
  } else if (node->kind != TomlNode::Kind::String) {
    add_problem(node->place, key, fmt::format("is {}; write text", kind_name(node->kind)));
  } else if (languages_.size() > 1) {
    add_problem(node->place, key,
                fmt::format("must say what it is in every language: {} = {{ {} = \"...\", {} = \"...\" }}",
                            key, languages_[0], languages_[1]));
  } else if (is_blank(node->text)) {
    add_problem(node->place, key, "is empty; write text");
  } else {
    text.front() = node->text;
  }
  return text;
}

double KeyReader::number(const std::string& key, double otherwise, double least, double most) {
  const TomlNode* const node = take(key, TomlNode::Kind::Number, "a number");
  if (node == nullptr) return otherwise;
  if (node->number >= least && node->number <= most) return node->number;  // both false for NaN
  add_problem(node->place, key,
              fmt::format("is {}; choose a number from {} to {}", node->number, least, most));
  return otherwise;
}

int KeyReader::whole(const std::string& key, int otherwise, int least, int most) {
  const TomlNode* const node = take(key, TomlNode::Kind::Number, "a whole number");
  if (node == nullptr) return otherwise;
  if (node->number >= least && node->number <= most && node->number == std::floor(node->number))
    return int(node->number);
  add_problem(node->place, key,
              fmt::format("is {}; choose a whole number from {} to {}", node->number, least, most));
  return otherwise;
}

bool KeyReader::flag(const std::string& key, bool otherwise) {
  const TomlNode* const node = take(key, TomlNode::Kind::Boolean, "true or false");
  return node == nullptr ? otherwise : node->boolean;
}

std::vector<std::string> KeyReader::strings(const std::string& key) {
  std::vector<std::string> texts;
  const TomlNode* const node = take(key, TomlNode::Kind::Array, "an array: [\"...\", \"...\"]");
  if (node == nullptr) return texts;
  for (const TomlNode& element : node->elements) {
    if (element.kind == TomlNode::Kind::String) {
      texts.push_back(element.text);
    } else {
      add_problem(element.place, key,
                  fmt::format("holds {}; write text between quotes", kind_name(element.kind)));
    }
  }
  return texts;
}

std::vector<double> KeyReader::rising_numbers(const std::string& key) {
  std::vector<double> numbers;
  const TomlNode* const node = take(key, TomlNode::Kind::Array, "an array: [20, 40]");
  if (node == nullptr) return numbers;
  for (const TomlNode& element : node->elements) {
    const bool fits = element.kind == TomlNode::Kind::Number && std::isfinite(element.number) &&
                      (numbers.empty() || element.number > numbers.back());
    if (fits) {
      numbers.push_back(element.number);
    } else {
      add_problem(element.place, key, "holds what is no number above the one before it; write [20, 40]");
    }
  }
  return numbers;
}

std::optional<base::Vector3> KeyReader::point(const std::string& key, double farthest) {
  const TomlNode* const node = take(key, TomlNode::Kind::Array, "three numbers: [0.0, 0.05, 0.1]");
  if (node == nullptr) return {};
  const bool fits = node->elements.size() == 3 && std::ranges::all_of(node->elements, [&](const auto& it) {
                      return it.kind == TomlNode::Kind::Number && std::abs(it.number) <= farthest;
                    });
  if (fits)
    return base::Vector3(node->elements[0].number, node->elements[1].number, node->elements[2].number);
  add_problem(node->place, key,
              fmt::format("must be three numbers of at most {:g} m, such as [0.0, 0.05, 0.1]", farthest));
  return {};
}

std::vector<KeyReader> KeyReader::tables(const std::string& key, const std::string& what) {
  std::vector<KeyReader> readers;
  const TomlNode* const node = take(key, TomlNode::Kind::Array, "an array of tables: [{ ... }, { ... }]");
  if (node == nullptr) return readers;
  for (const TomlNode& element : node->elements) {
    if (element.kind != TomlNode::Kind::Table) {
      add_problem(element.place, key,
                  fmt::format("holds {}; write tables: {{ ... }}", kind_name(element.kind)));
      continue;
    }
    const auto named = std::ranges::find(element.members, "id", &TomlMember::key);
    const bool has_id = named != element.members.end() && is_id(named->value.text);
    readers.emplace_back(element, has_id ? fmt::format("{} '{}'", what, named->value.text) : what, languages_,
                         problems_);
  }
  return readers;
}

const TomlNode* KeyReader::table(const std::string& key) {
  return take(key, TomlNode::Kind::Table, "a table: { ... }");
}

void KeyReader::finish() {
  for (const TomlMember& member : table_.members) {
    if (std::ranges::find(known_, member.key) != known_.end()) continue;
    const std::string near = base::suggestion(member.key, known_);
    problems_.add(member.place, fmt::format("{}: there is no key '{}'{}{}", what_, member.key, near,
                                            near.ends_with('?') ? "" : "."));
  }
}

}  // namespace icome::io
