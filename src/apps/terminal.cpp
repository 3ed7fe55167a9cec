#include "apps/terminal.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "apps/interrupt.h"
#include "base/terminal_text.h"

namespace icome::apps {

namespace {

/// The sentence without the secrets of links, which whoever reads over one's shoulder could use.
std::string without_tokens(std::string_view sentence) {
  constexpr std::string_view kBegin = "token=";
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::string result;
  while (!sentence.empty()) {
    const std::size_t begin = std::min(sentence.find(kBegin), sentence.size());
    result += sentence.substr(0, begin);
    sentence.remove_prefix(begin);
    if (sentence.empty()) break;
    result += "token=...";
    sentence.remove_prefix(kBegin.size());
    sentence.remove_prefix(std::min(sentence.find_first_not_of(kLetters), sentence.size()));
  }
  return result;
}

}  // namespace

void tell(std::string_view sentence) {
  fmt::print(stderr, "icome: {}\n", base::terminal_text(without_tokens(sentence)));
}

bool ask(std::string_view question) {
  fmt::print(stderr, "{} [y/N] ", base::terminal_text(question));
  constexpr int kLook = 100;  // ms from one look at interrupted() to the next
  char first = '\0';
  while (!interrupted()) {
    pollfd input = {STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, kLook) <= 0) continue;
    char letter = '\0';
    if (::read(STDIN_FILENO, &letter, 1) != 1) return false;
    if (letter == '\n') return first == 'y' || first == 'Y';
    if (first == '\0') first = letter;
  }
  fmt::print(stderr, "\n");
  return false;
}

void print(std::string_view text) {
  const std::string shown = base::terminal_text(text);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
}

std::string how_many(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

int print_answer(std::string_view text) {
  print(text);
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return 0;
  tell("standard output cannot be written: is the disk full?");
  return kFailed;
}

}  // namespace icome::apps
