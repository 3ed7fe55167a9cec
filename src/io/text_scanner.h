#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"
#include "io/byte_watch.h"

namespace icome::io {

/// Reads words and numbers from a text that it does not own. The first failure sticks: from then on the
/// scanner is at the end, numbers read as 0, and error() says what and on which line. So a parser may
/// read a whole row and ask once.
class TextScanner {
 public:
  enum class Lines {
    AreSpace,  ///< a row may spread over lines
    Matter,    ///< a row is a line: a number that is not on this line is missing
    Continue   ///< as Matter, but a line that ends in a backslash goes on in the next
  };

  /// `comment` begins a comment that lasts to the end of the line; '\0' for none. When the time budget (may
  /// be null) ends, the scanner fails.
  TextScanner(std::string_view text, std::string name, Lines lines, char comment,
              TimeBudget* time_budget = nullptr);

  /// Skips space, line ends and comments; true when nothing is left.
  bool at_end();
  /// Skips space within the line; true when a word follows on it.
  bool more_on_line();
  /// Moves past the end of this line.
  void skip_line();

  /// The next word; empty when there is none (on this line, where lines matter).
  std::string_view word();
  /// The rest of the line, without space around it and comments behind space: a name of several words.
  std::string_view rest();
  /// The next word as a number; "nan" and "inf" are numbers. `what` names it in errors: "a coordinate".
  double number(const char* what);
  /// The next word as a whole number.
  std::int64_t integer(const char* what);

  /// Records the error, at the line of the last word read.
  void fail(const std::string& message);
  bool failed() const { return !error_.message.empty(); }
  const base::Error& error() const { return error_; }
  /// Line of the last word read, from 1. Takes time in proportion to the text before it.
  int line() const;
  /// Offset in the text from which the next word is looked for.
  std::size_t position() const { return static_cast<std::size_t>(at_ - text_.data()); }

 private:
  void skip_blanks();
  void ask_whether_to_go_on();
  void fail_word(std::string_view word, const char* what);

  std::string_view text_;
  std::string name_;
  Lines lines_;
  char comment_;
  const char* at_;
  const char* end_;
  const char* word_begin_;
  ByteWatch watch_;
  base::Error error_;
};

/// A word out of a file made fit for a message: quoted, shortened, without control characters.
std::string quoted(std::string_view word);

/// Compares ascii words without regard to case.
bool same_word(std::string_view a, std::string_view b);

}  // namespace icome::io
