#include "speech/words/spoken_words.h"

#include <fmt/format.h>

#include <array>

#include "base/parse_number.h"

namespace icome::speech {
namespace {

constexpr std::array kSmall = {"zero",    "one",     "two",       "three",    "four",
                               "five",    "six",     "seven",     "eight",    "nine",
                               "ten",     "eleven",  "twelve",    "thirteen", "fourteen",
                               "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"};
constexpr std::array kTens = {"",      "",      "twenty",  "thirty", "forty",
                              "fifty", "sixty", "seventy", "eighty", "ninety"};

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

/// Is the letter part of words? A point or an apostrophe is so between others; bytes of UTF-8 are.
bool is_spoken(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || is_digit(letter) ||
         static_cast<unsigned char>(letter) >= 0x80U;
}

char small(char letter) { return letter >= 'A' && letter <= 'Z' ? char(letter - 'A' + 'a') : letter; }

/// Digits as words: whole numbers below 1000 as a number, others digit by digit.
std::string digits_as_words(std::string_view digits) {
  constexpr unsigned kReadAsOne = 1000;
  const auto number = base::parse_number<unsigned>(digits);
  if (number && *number < kReadAsOne && (digits.front() != '0' || digits.size() == 1))
    return number_words(*number);
  std::string words;
  for (const char digit : digits) {
    if (!words.empty()) words += ' ';
    words += kSmall[std::size_t(digit - '0')];
  }
  return words;
}

/// Bytes of the apostrophe, plain or typographic, that the text begins with; 0: with none.
std::size_t apostrophe_length(std::string_view text) {
  for (const std::string_view sign : {"'", "\u2019", "\u2018"})
    if (text.starts_with(sign)) return sign.size();
  return 0;
}

/// The sentence with blanks between what is said, and numbers as words.
std::string spelled_out(std::string_view sentence) {
  std::string text;
  for (std::size_t i = 0; i < sentence.size();) {
    const char letter = sentence[i];
    const bool is_minus = letter == '-' && i + 1 < sentence.size() && is_digit(sentence[i + 1]) &&
                          (i == 0 || !is_spoken(sentence[i - 1]));
    if (is_minus) text += "minus";
    if (is_digit(letter)) {
      std::size_t end = i;
      while (end < sentence.size() && is_digit(sentence[end])) ++end;
      text += fmt::format(" {} ", digits_as_words(sentence.substr(i, end - i)));
      const bool goes_on = end + 1 < sentence.size() && sentence[end] == '.' && is_digit(sentence[end + 1]);
      if (goes_on) {
        text += "point ";
        std::size_t last = ++end;
        while (last < sentence.size() && is_digit(sentence[last])) ++last;
        for (; end < last; ++end) text += fmt::format("{} ", kSmall[std::size_t(sentence[end] - '0')]);
      }
      i = end;
      continue;
    }
    if (const std::size_t length = apostrophe_length(sentence.substr(i))) {
      const bool between = i > 0 && i + length < sentence.size() && is_spoken(sentence[i - 1]) &&
                           is_spoken(sentence[i + length]);
      text += between ? '\'' : ' ';
      i += length;
      continue;
    }
    text += is_spoken(letter) ? small(letter) : ' ';
    ++i;
  }
  return text;
}

}  // namespace

std::vector<std::string> spoken_words(std::string_view sentence,
                                      const std::map<std::string, std::string, std::less<>>& same) {
  std::vector<std::string> words;
  const std::string text = spelled_out(sentence);
  for (std::size_t begin = 0; begin < text.size();) {
    begin = text.find_first_not_of(' ', begin);
    if (begin == std::string::npos) break;
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const auto other = same.find(word);
    words.push_back(other == same.end() ? word : other->second);
    begin = end;
  }
  return words;
}

std::string joined_words(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

std::string number_words(unsigned number) {
  if (number < kSmall.size()) return kSmall[number];
  constexpr unsigned kTen = 10, kHundred = 100;
  const auto with = [](std::string first, unsigned rest) {
    return rest == 0 ? first : first + " " + number_words(rest);
  };
  if (number < kHundred) return with(kTens[number / kTen], number % kTen);
  return with(std::string(kSmall[number / kHundred]) + " hundred", number % kHundred);
}

}  // namespace icome::speech
