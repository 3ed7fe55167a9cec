#include "apps/status_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "base/terminal_text.h"

namespace icome::apps {
namespace {

constexpr double kRefreshSeconds = 0.1;
constexpr const char* kEraseLine = "\r\x1b[K";

}  // namespace

StatusLine::StatusLine() : terminal_(::isatty(STDERR_FILENO) == 1) {}

void StatusLine::say(const std::string& text) {
  if (!terminal_) return;
  fmt::print(stderr, "{}{}", kEraseLine, base::terminal_text(text));
  std::fflush(stderr);
  shown_ = true;
}

void StatusLine::progress(const std::string& what, double done, double all, const char* unit) {
  if (since_.seconds() - last_ < kRefreshSeconds) return;
  last_ = since_.seconds();
  say(fmt::format("{}: {:.10g} of {:.10g} {}", what, done, all, unit));
}

void StatusLine::clear() {
  if (!shown_) return;
  fmt::print(stderr, "{}", kEraseLine);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace icome::apps
