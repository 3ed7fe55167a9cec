#include "base/terminal_text.h"

#include <gtest/gtest.h>

namespace icome::base {
namespace {

TEST(TerminalText, ShowsControlCharactersInsteadOfSendingThem) {
  EXPECT_EQ(terminal_text("a\x1b[31mb\rc\x07"), "a\\u001b[31mb\\u000dc\\u0007");
  EXPECT_EQ(terminal_text(std::string("a\0b", 3)), "a\\u0000b");
  EXPECT_EQ(terminal_text("\x7f\xc2\x9b\x35m"), "\\u007f\\u009b5m")
      << "one of eight bits, which is Escape [ too";
  EXPECT_EQ(terminal_text("\xe2\x80\xaegnp\xe2\x81\xa6"), "\\u202egnp\\u2066") << "read from right to left";
}

TEST(TerminalText, LeavesAllElse) {
  const std::string text = "a table\t1.5 m\n\xc3\xa4\xe4\xb8\xad\xf0\x9f\x98\x80\xc2\xa0\\u001b";
  EXPECT_EQ(terminal_text(text), text);
  EXPECT_EQ(terminal_text(""), "");
}

TEST(TerminalText, HasNoBytesThatAreNoUtf8) {
  EXPECT_EQ(terminal_text("\x9b\x31m \xff\xc2"), "?1m ??");
  for (int byte = 0; byte < 256; ++byte) {
    const std::string shown = terminal_text(std::string(1, char(byte)));
    for (const char c : shown) EXPECT_TRUE((c >= ' ' && c < '\x7f') || c == '\n' || c == '\t') << byte;
  }
}

}  // namespace
}  // namespace icome::base
