#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/near_names.h"
#include "base/vector.h"
#include "study/definition/toml_tree.h"

namespace icome::study {

/// What is wrong with a study file, and where.
class Problems {
 public:
  void add(Place place, std::string sentence) { all_.push_back({place, std::move(sentence)}); }
  bool none() const { return all_.empty(); }
  /// "source:line:column: sentence" of each, a line each, in the order of the file; beyond 50 only how many.
  std::string text(const std::string& source) const;

 private:
  struct Problem {
    Place place;
    std::string sentence;
  };
  std::vector<Problem> all_;
};

/// Words that a key may have as value, and what they mean.
template <typename Meaning>
using Words = std::vector<std::pair<std::string_view, Meaning>>;

/// Whether this can name a column of a log: letters, digits, - and _, at most 64.
bool is_id(std::string_view text);

/// Takes values out of one table of a study file by key. What is missing, of another type or out of its
/// range is added to the problems, and something harmless returned. The tree outlives this.
class KeyReader {
 public:
  KeyReader(const TomlNode& table, std::string what, const std::vector<std::string>& languages,
            Problems& problems)
      : table_(table), what_(std::move(what)), languages_(languages), problems_(problems) {}

  Place place() const { return table_.place; }
  Problems& problems() { return problems_; }
  bool has(std::string_view key) const;
  /// Of the value of the key, else of the table.
  Place place_of(std::string_view key) const;

  /// An id; "" where it is missing or none.
  std::string id(const std::string& key = "id");
  /// The id of something else, or "" where the key is not there.
  std::string reference(const std::string& key);
  /// In one language.
  std::string plain(const std::string& key);
  Text text(const std::string& key, bool required);
  double number(const std::string& key, double otherwise, double least, double most);
  int whole(const std::string& key, int otherwise, int least, int most);
  bool flag(const std::string& key, bool otherwise);
  std::vector<std::string> strings(const std::string& key);
  std::vector<double> rising_numbers(const std::string& key);
  /// Three numbers, each at most `farthest` from 0; nothing where the key is not there.
  std::optional<base::Vector3> point(const std::string& key, double farthest);
  /// The tables of an array.
  std::vector<KeyReader> tables(const std::string& key, const std::string& what);
  /// The table of a key; null where it is not there.
  const TomlNode* table(const std::string& key);

  template <typename Meaning>
  Meaning word(const std::string& key, const Words<Meaning>& words, Meaning otherwise);
  /// The key must be there.
  void require(const std::string& key, const std::string& what_to_write);

  /// Adds a problem for every key that nothing asked for.
  void finish();

 private:
  const TomlNode* take(const std::string& key);
  const TomlNode* take(const std::string& key, TomlNode::Kind kind, const char* wanted);
  void add_problem(Place place, const std::string& key, const std::string& sentence);
  std::string checked_id(const TomlNode& node, const std::string& key);
  void read_translations(const TomlNode& node, const std::string& key, Text& text);

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

}  // namespace icome::study
