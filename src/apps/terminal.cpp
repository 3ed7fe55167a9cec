#include "apps/terminal.h"

#include <fmt/format.h>

#include <cstdio>

#include "base/terminal_text.h"

namespace icome::apps {

void tell(std::string_view sentence) { fmt::print(stderr, "icome: {}\n", base::terminal_text(sentence)); }

void print(std::string_view text) {
  const std::string shown = base::terminal_text(text);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
}

}  // namespace icome::apps
