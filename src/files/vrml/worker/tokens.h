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

/// Cuts VRML 2.0 into words, numbers, strings and brackets. Never fails: a string without an end ends with
/// the text.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) {}

  Token next();
  Token peek();
  /// Offset behind the last token that was read.
  std::size_t place() const { return place_; }
  /// Skips all numbers at this place; quickly, since most of a file is numbers.
  void skip_numbers();
  /// Skips the content of a bracket that was just read, with its partner. False: it has none.
  bool skip_to_partner();
  /// Largest depth of brackets in the rest of the text, which is consumed.
  int deepest();
  std::string_view word(const Token& token) const {
    return text_.substr(token.begin, token.end - token.begin);
  }
  /// The line of a place, from 1. Quick for rising places.
  int line(std::size_t place);

 private:
  void skip_space();

  std::string_view text_;
  std::size_t place_ = 0;
  std::size_t counted_place_ = 0;
  int counted_line_ = 1;
};

}  // namespace icome::files
