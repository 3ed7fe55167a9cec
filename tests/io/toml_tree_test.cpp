#include "io/toml_tree.h"

#include <gtest/gtest.h>

#include <string>

namespace icome::io {
namespace {

/// The error of reading `text`, or "" where it is read.
std::string fault_of(const std::string& text) {
  const base::Result<TomlNode> tree = parse_toml(text, "f.toml");
  return tree ? "" : tree.error().message;
}

TEST(TomlTree, LettersOutsideOfTheAsciiCodeAreToldWhereTheyMayNotStand) {
  for (const std::string letter :
       {"\u00e9", "\u0416", "\u3042", "\ufb01", "\u2003", "\u1680", "\U0001f600"}) {
    for (const std::string& line :
         {letter + " = 1", "a = 1 " + letter, "[" + letter + "]", "a" + letter + " = 1",
          "a = [1, " + letter + "]", "a = " + letter, "a = 1979-05-27" + letter}) {
      EXPECT_TRUE(fault_of("b = 2\n" + line + "\n").starts_with("f.toml:2:")) << line;
    }
  }
}

TEST(TomlTree, TextsMayHoldAnyLetter) {
  for (const std::string letter : {"\u00e9", "\u0416", "\u3042", "\ufb01", "\U0001f600"}) {
    const base::Result<TomlNode> tree = parse_toml(
        "# " + letter + "\n\"" + letter + "\" = \"\"\"\n" + letter + " \\\n " + letter + "\"\"\"\n",
        "f.toml");
    ASSERT_TRUE(tree) << tree.error().message;
    ASSERT_EQ(tree->members.size(), 1U);
    EXPECT_EQ(tree->members[0].key, letter);
    EXPECT_TRUE(tree->members[0].value.text.starts_with(letter + " "));
    EXPECT_TRUE(tree->members[0].value.text.ends_with(letter));
  }
}

TEST(TomlTree, KeysOfMoreThanAHundredPartsAreRefused) {
  std::string key = "a";
  for (int part = 1; part < 100; ++part) key += ".a";
  EXPECT_EQ(fault_of("b = 1\n" + key + " = 1\n"), "");
  EXPECT_EQ(fault_of("b = 1\n" + key + ".a.a = 1\n"), "f.toml:2: a key has more than 100 parts");
}

}  // namespace
}  // namespace icome::io
