#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/near_names.h"
#include "base/vector.h"
#include "io/toml_tree.h"

namespace icome::io {

/// A text in each language of a file, in the order of its languages.
using Translations = std::vector<std::string>;

/// The problems of a file of settings, with their places.
class Problems {
 public:
  void add(Place place, std::string sentence) { all_.push_back({place, std::move(sentence)}); }
  bool none() const { return all_.empty(); }
  /// A line "source:line:column: sentence" for each, in the order of the file; beyond 50 only their number.
  std::string text(const std::string& source) const;

 private:
  struct Problem {
    Place place;
    std::string sentence;
  };
  std::vector<Problem> all_;
};

/// Words that a key may have as value, with their meanings.
template <typename Meaning>
using Words = std::vector<std::pair<std::string_view, Meaning>>;

/// Can the text name a column of a log: is it letters, digits, - and _, at most 64?
bool is_id(std::string_view text);

/// Reads values of one table of a TOML file by key. A value that is missing, of another type or out of
/// its range is added to the problems, and something harmless returned. The tree must outlive this.
class KeyReader {
 public:
  KeyReader(const TomlNode& table, std::string what, const std::vector<std::string>& languages,
            Problems& problems)
      : table_(table), what_(std::move(what)), languages_(languages), problems_(problems) {}

  Place place() const { return table_.place; }
  Problems& problems() { return problems_; }
  bool has(std::string_view key) const;
  /// The place of the key's value, or of the table if there is no such key.
  Place place_of(std::string_view key) const;

  /// An id; "" if it is missing or invalid.
  std::string id(const std::string& key = "id");
  /// The id of something else; "" if there is no such key.
  std::string reference(const std::string& key);
  /// A text in one language.
  std::string plain(const std::string& key);
  /// A text in every language; empty if there is no such key and it is not required.
  Translations text(const std::string& key, bool required);
  double number(const std::string& key, double otherwise, double least, double most);
  int whole(const std::string& key, int otherwise, int least, int most);
  bool flag(const std::string& key, bool otherwise);
  std::vector<std::string> strings(const std::string& key);
  std::vector<double> rising_numbers(const std::string& key);
  /// Three numbers, each at most `farthest` from 0; nothing if there is no such key.
  std::optional<base::Vector3> point(const std::string& key, double farthest);
  /// The tables of an array.
  std::vector<KeyReader> tables(const std::string& key, const std::string& what);
  /// The table of a key; null if there is no such key.
  const TomlNode* table(const std::string& key);
  /// The value of a key, whatever it is; null if there is no such key.
  const TomlNode* value(const std::string& key) { return take(key); }

  template <typename Meaning>
  Meaning word(const std::string& key, const Words<Meaning>& words, Meaning otherwise);
  /// Adds a problem if the key is missing.
  void require(const std::string& key, const std::string& what_to_write);

  /// Adds a problem for every key that nothing asked for.
  void finish();

 private:
  const TomlNode* take(const std::string& key);
  const TomlNode* take(const std::string& key, TomlNode::Kind kind, const char* wanted);
  void add_problem(Place place, const std::string& key, const std::string& sentence);
  std::string checked_id(const TomlNode& node, const std::string& key);
  void read_translations(const TomlNode& node, const std::string& key, Translations& text);

  const TomlNode& table_;
  std::string what_;  // "independent variable 'menu'"
  const std::vector<std::string>& languages_;
  Problems& problems_;
  std::vector<std::string> known_;
};

template <typename Meaning>
Meaning KeyReader::word(const std::string& key, const Words<Meaning>& words, Meaning otherwise) {
  const TomlNode* const node = take(key, TomlNode::Kind::String, "a word between quotes");
  if (node == nullptr) return otherwise;
  std::vector<std::string> names;
  for (const auto& [name, meaning] : words) {
    if (name == node->text) return meaning;
    names.emplace_back(name);
  }
  add_problem(node->place, key,
              std::string("cannot be '").append(node->text) + "'" + base::suggestion(node->text, names));
  return otherwise;
}

}  // namespace icome::io
