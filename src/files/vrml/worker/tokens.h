#pragma once
#include <cstddef>
#include <string_view>

namespace icome::files {

struct Token {
  enum class Kind { End, Word, Number, String, Open, Close, OpenList, CloseList };
  Kind kind = Kind::End;
  std::size_t begin = 0;  // in the text
  std::size_t end = 0;
};

/// Cuts VRML 2.0 into words, numbers, strings and brackets. Never fails: a string without an end is one that
/// ends with the text.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) {}

  Token next();
  Token peek();
  /// Behind what was read last.
  std::size_t place() const { return place_; }
  /// Passes all numbers that stand here; quickly, since most of a file is numbers.
  void skip_numbers();
  /// Passes what belongs to a bracket that was just read, its partner included. False: it has none.
  bool skip_to_partner();
  /// How deep the brackets of all that is left go.
  int deepest();
  std::string_view word(const Token& token) const {
    return text_.substr(token.begin, token.end - token.begin);
  }
  /// The line of a place, from 1. Quick when the places rise.
  int line(std::size_t place);

 private:
  void skip_space();

  std::string_view text_;
  std::size_t place_ = 0;
  std::size_t counted_place_ = 0;
  int counted_line_ = 1;
};

}  // namespace icome::files
