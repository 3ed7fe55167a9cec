#include "files/vrml/worker/tokens.h"

#include <algorithm>
#include <array>

namespace icome::files {
namespace {

// The classes of characters in words and numbers are even.
constexpr unsigned char kOther = 0;
constexpr unsigned char kSpace = 1;
constexpr unsigned char kNumeric = 2;
constexpr unsigned char kSpecial = 3;

constexpr std::array<unsigned char, 256> make_classes() {
  std::array<unsigned char, 256> classes{};
  for (std::size_t c = 0; c <= ' '; ++c) classes[c] = kSpace;
  classes[','] = kSpace;
  for (const char c : std::string_view("0123456789+-.")) classes[static_cast<unsigned char>(c)] = kNumeric;
  for (const char c : std::string_view("{}[]#\"")) classes[static_cast<unsigned char>(c)] = kSpecial;
  return classes;
}

constexpr auto kClasses = make_classes();

unsigned char class_of(char c) { return kClasses[static_cast<unsigned char>(c)]; }

}  // namespace

void Tokens::skip_space() {
  while (place_ < text_.size()) {
    if (class_of(text_[place_]) == kSpace) {
      ++place_;
    } else if (text_[place_] == '#') {
      place_ = std::min(text_.find_first_of("\r\n", place_), text_.size());
    } else {
      return;
    }
  }
}

Token Tokens::next() {
  skip_space();
  Token token{Token::Kind::End, place_, place_};
  if (place_ == text_.size()) return token;
  const char c = text_[place_++];
  constexpr std::string_view kBrackets = "{}[]";
  if (const std::size_t bracket = kBrackets.find(c); bracket != std::string_view::npos) {
    using enum Token::Kind;
    token.kind = std::array{Open, Close, OpenList, CloseList}[bracket];
  } else if (c == '"') {
    token.kind = Token::Kind::String;
    while (place_ < text_.size() && text_[place_] != '"') place_ += text_[place_] == '\\' ? 2 : 1;
    place_ = std::min(place_ + 1, text_.size());
  } else {
    token.kind = class_of(c) == kNumeric ? Token::Kind::Number : Token::Kind::Word;
    while (place_ < text_.size() && class_of(text_[place_]) % 2 == 0) ++place_;
  }
  token.end = place_;
  return token;
}

Token Tokens::peek() {
  const std::size_t here = place_;
  const Token token = next();
  place_ = here;
  return token;
}

void Tokens::skip_numbers() {
  const char* const begin = text_.data();
  while (place_ < text_.size()) {
    const unsigned char kind = class_of(begin[place_]);
    if (kind == kSpace || kind == kNumeric) {
      ++place_;
    } else if (begin[place_] == '#') {
      skip_space();
    } else if (kind == kOther && place_ > 0 && class_of(begin[place_ - 1]) == kNumeric) {
      while (place_ < text_.size() && class_of(begin[place_]) % 2 == 0) ++place_;  // 1e5, 0xff
    } else {
      return;
    }
  }
}

bool Tokens::skip_to_partner() {
  for (std::size_t depth = 1; depth > 0;) {
    skip_numbers();
    const Token token = next();
    if (token.kind == Token::Kind::End) return false;
    if (token.kind == Token::Kind::Open || token.kind == Token::Kind::OpenList) ++depth;
    if (token.kind == Token::Kind::Close || token.kind == Token::Kind::CloseList) --depth;
  }
  return true;
}

int Tokens::deepest() {
  int depth = 0;
  int most = 0;
  for (Token token = next(); token.kind != Token::Kind::End; token = next()) {
    if (token.kind == Token::Kind::Open || token.kind == Token::Kind::OpenList)
      most = std::max(most, ++depth);
    if (token.kind == Token::Kind::Close || token.kind == Token::Kind::CloseList) --depth;
  }
  return most;
}

int Tokens::line(std::size_t place) {
  if (place < counted_place_) counted_place_ = 0, counted_line_ = 1;
  const std::string_view passed = text_.substr(counted_place_, place - counted_place_);
  counted_line_ += static_cast<int>(std::count(passed.begin(), passed.end(), '\n'));
  counted_place_ = place;
  return counted_line_;
}

}  // namespace icome::files
