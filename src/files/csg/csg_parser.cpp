// The grammar of .csg: a text becomes a CsgDocument. One pass, without recursion.
#include <fmt/format.h>

#include <limits>
#include <utility>

#include "base/parse_number.h"
#include "files/csg/csg_document.h"
#include "io/byte_watch.h"
#include "io/text_scanner.h"

namespace icome::files {
namespace {

constexpr std::size_t kLongestCsgName = 255;
constexpr std::string_view kCsgByteOrderMark = "\xef\xbb\xbf";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$'; }
bool in_name(char c) { return begins_name(c) || is_digit(c); }

}  // namespace

class CsgParser {
 public:
  CsgParser(std::string_view text, const std::string& name, io::TimeBudget& time_budget)
      : document_(text, name),
        begin_(text.data()),
        at_(begin_),
        end_(begin_ + text.size()),
        watch_(text, &time_budget) {
    if (text.starts_with(kCsgByteOrderMark)) at_ += kCsgByteOrderMark.size();
  }

  base::Result<CsgDocument> run() {
    while (next_statement()) {
    }
    if (!error_.message.empty()) return tl::unexpected(error_);
    return std::move(document_);
  }

 private:
  using Kind = CsgDocument::Kind;
  struct Open {
    CsgDocument::Index statement;
    CsgDocument::Offset brace;
  };

  bool next_statement();
  bool statement();
  bool end_of_text();
  bool arguments();
  bool argument();
  bool value();
  bool close_vectors();
  bool scalar();
  std::string_view number_word() const;
  bool number();
  bool string();
  bool word_value();

  /// Skips space and comments. False, with the error, when a comment is not closed or the time budget ends.
  bool skip_space();
  bool skip_comment();
  /// Skips space, then takes the character if it comes next.
  bool take(char wanted);
  std::string_view take_name();
  char peek() const { return at_ < end_ ? *at_ : '\0'; }
  CsgDocument::Offset offset(const char* place) const {
    return static_cast<CsgDocument::Offset>(place - begin_);
  }
  bool fail(const char* place, const std::string& message);
  bool fail_expected(const std::string& what);
  /// The text at at_, for messages.
  std::string found() const;

  CsgDocument document_;
  const char* begin_;
  const char* at_;
  const char* end_;
  io::ByteWatch watch_;
  std::vector<Open> open_;                        // statements whose brace is open
  std::vector<CsgDocument::Index> open_vectors_;  // of the value being read
  base::Error error_;
};

bool CsgParser::fail(const char* place, const std::string& message) {
  if (error_.message.empty()) error_ = document_.error_at(offset(place), message);
  return false;
}

std::string CsgParser::found() const {
  if (at_ == end_) return "the file ends: it may be cut short";
  const char* last = at_ + 1;
  while (in_name(*at_) && last < end_ && in_name(*last)) ++last;
  return "there is " + io::quoted({at_, static_cast<std::size_t>(last - at_)});
}

bool CsgParser::fail_expected(const std::string& what) {
  return fail(at_, fmt::format("{} is expected, but {}", what, found()));
}

bool CsgParser::skip_comment() {
  const std::string_view rest(at_, static_cast<std::size_t>(end_ - at_));
  const bool block = rest[1] == '*';
  const std::size_t stop = rest.find(block ? "*/" : "\n", 2);
  if (stop == std::string_view::npos && block)
    return fail(at_, "the comment that begins here with /* has no */");
  at_ = stop == std::string_view::npos ? end_ : at_ + stop + (block ? 2 : 1);
  return true;
}

bool CsgParser::skip_space() {
  if (!watch_.lasts(at_)) {
    if (error_.message.empty()) error_ = io::interruption();
    at_ = end_;
    return false;
  }
  while (at_ < end_) {
    if (*at_ == ' ' || (*at_ >= '\t' && *at_ <= '\r')) {
      ++at_;
    } else if (*at_ == '/' && at_ + 1 < end_ && (at_[1] == '/' || at_[1] == '*')) {
      if (!skip_comment()) return false;
    } else {
      return true;
    }
  }
  return true;
}

bool CsgParser::take(char wanted) {
  if (!skip_space() || peek() != wanted || at_ == end_) return false;
  ++at_;
  return true;
}

std::string_view CsgParser::take_name() {
  const char* const first = at_;
  if (at_ < end_ && begins_name(*at_)) {
    while (at_ < end_ && in_name(*at_)) ++at_;
  }
  const std::string_view name(first, static_cast<std::size_t>(at_ - first));
  if (name.size() <= kLongestCsgName) return name;
  fail(first, fmt::format("the name {} is longer than {} characters", io::quoted(name), kLongestCsgName));
  return {};
}

/// One step: closes a brace, skips a lone ';' or reads a statement up to its children. False at the end.
bool CsgParser::next_statement() {
  if (!skip_space()) return false;
  if (at_ == end_) return end_of_text();
  if (*at_ == ';') {
    ++at_;
    return true;
  }
  if (*at_ != '}') return statement();
  if (open_.empty()) return fail(at_, "this '}' closes nothing: a statement or the end is expected");
  ++at_;
  document_.statements_[open_.back().statement].end =
      static_cast<CsgDocument::Index>(document_.statements_.size());
  open_.pop_back();
  return true;
}

bool CsgParser::end_of_text() {
  if (open_.empty()) return false;
  const std::string_view opened = document_.name(document_.statements_[open_.back().statement]);
  return fail(at_, fmt::format("'}}' is expected, for the '{{' of {} in line {}, but {}", opened,
                               document_.line(open_.back().brace), found()));
}

bool CsgParser::statement() {
  CsgDocument::Statement next;
  constexpr std::string_view kSigns = "*%#!";
  for (std::size_t sign; at_ < end_ && (sign = kSigns.find(*at_)) != std::string_view::npos;) {
    next.modifiers = static_cast<std::uint8_t>(next.modifiers | (1U << sign));
    ++at_;
    if (!skip_space()) return false;
  }
  next.offset = offset(at_);
  const std::string_view name = take_name();
  if (name.empty()) return fail_expected("a statement such as cube(...);");
  next.name_length = static_cast<std::uint16_t>(name.size());
  next.first_argument = static_cast<CsgDocument::Index>(document_.arguments_.size());
  const auto index = static_cast<CsgDocument::Index>(document_.statements_.size());
  next.end = index + 1;
  document_.statements_.push_back(next);
  if (!take('(')) return fail_expected(fmt::format("'(' after {}", io::quoted(name)));
  if (!arguments()) return false;
  if (take(';')) return true;
  if (!take('{')) return fail_expected("'{' or ';'");
  open_.push_back({index, offset(at_ - 1)});
  return true;
}

/// Reads the arguments with their ')'.
bool CsgParser::arguments() {
  if (take(')')) return true;
  while (argument()) {
    if (take(')')) return true;
    if (!take(',')) return fail_expected("',' or ')'");
  }
  return false;
}

bool CsgParser::argument() {
  if (!skip_space()) return false;
  CsgDocument::Argument next;
  const char* const first = at_;
  const std::string_view name = take_name();
  if (!name.empty() && take('=')) {
    next.name = offset(first);
    next.name_length = static_cast<std::uint16_t>(name.size());
  } else {
    at_ = first;  // a value such as true
  }
  if (!error_.message.empty()) return false;
  next.value = static_cast<CsgDocument::Index>(document_.values_.size());
  document_.arguments_.push_back(next);
  return value();
}

bool CsgParser::value() {
  open_vectors_.clear();
  for (;;) {
    if (take('[')) {
      open_vectors_.push_back(static_cast<CsgDocument::Index>(document_.values_.size()));
      document_.values_.push_back({0.0, offset(at_ - 1), Kind::Vector});
      if (!skip_space()) return false;
      if (peek() != ']') continue;
    } else if (!scalar()) {
      return false;
    }
    if (!close_vectors()) return false;
    if (open_vectors_.empty()) return true;
  }
}

/// To be called after a value: closes the vectors that end here and goes to the next element.
bool CsgParser::close_vectors() {
  while (!open_vectors_.empty()) {
    if (take(',')) {
      if (!skip_space()) return false;
      if (peek() != ']') return true;  // OpenSCAD allows a comma before the bracket
    }
    if (!take(']')) return fail_expected("',' or ']'");
    document_.values_[open_vectors_.back()].number = static_cast<double>(document_.values_.size());
    open_vectors_.pop_back();
  }
  return true;
}

bool CsgParser::scalar() {
  if (!skip_space()) return false;
  const char first = peek();
  if (first == '"') return string();
  if (first == '-' || first == '+' || first == '.' || is_digit(first)) return number();
  if (begins_name(first)) return word_value();
  return fail_expected("a value");
}

/// All characters that look like one number to a person, so that "1.2.3" is refused as a whole.
std::string_view CsgParser::number_word() const {
  const char* last = at_ + 1;
  for (; last < end_; ++last) {
    const bool sign_of_exponent = (*last == '-' || *last == '+') && (last[-1] == 'e' || last[-1] == 'E');
    if (!in_name(*last) && *last != '.' && !sign_of_exponent) break;
  }
  return {at_, static_cast<std::size_t>(last - at_)};
}

bool CsgParser::number() {
  const std::string_view word = number_word();
  const std::string_view digits = word.substr(word[0] == '-' || word[0] == '+' ? 1 : 0);
  if (digits.starts_with("inf") || digits.starts_with("nan"))
    return fail(at_, io::quoted(word) + " is not a finite number");
  const auto read = base::number_at_front<double>(word);
  if (!read.is_all())
    return fail(at_, fmt::format("a number is expected, but there is {}", io::quoted(word)));
  if (!read.good()) return fail(at_, io::quoted(word) + " is out of range");
  document_.values_.push_back({read.value, offset(at_), Kind::Number});
  at_ += word.size();
  return true;
}

bool CsgParser::string() {
  const char* const first = at_;
  const char* last = first + 1;
  while (last < end_ && *last != '"') last += *last == '\\' && last + 1 < end_ ? 2 : 1;
  if (last == end_) return fail(first, "the string that begins here has no closing '\"'");
  at_ = last + 1;
  document_.values_.push_back({0.0, offset(first), Kind::String});
  return true;
}

bool CsgParser::word_value() {
  const char* const first = at_;
  const std::string_view word = take_name();
  if (word.empty()) return false;
  CsgDocument::Value next{0.0, offset(first), Kind::Boolean};
  if (word == "true")
    next.number = 1.0;
  else if (word == "undef")
    next.kind = Kind::Undefined;
  else if (word == "inf" || word == "nan")
    return fail(first, io::quoted(word) + " is not a finite number");
  else if (word != "false")
    return fail(
        first,
        fmt::format("a value (a number, true, false, undef, \"text\" or [...]) is expected, but there is {}",
                    io::quoted(word)));
  document_.values_.push_back(next);
  return true;
}

base::Result<CsgDocument> CsgDocument::parse(std::string_view text, const std::string& name,
                                             io::TimeBudget& time_budget) {
  if (text.size() >= std::numeric_limits<Offset>::max())
    return base::fail(name + ": is too large: a .csg file of up to 4 GiB can be read");
  return CsgParser(text, name, time_budget).run();
}

}  // namespace icome::files
