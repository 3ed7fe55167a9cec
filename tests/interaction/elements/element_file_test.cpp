#include "interaction/elements/element_file.h"

#include <gtest/gtest.h>

#include "places.h"

namespace icome::interaction {
namespace {

std::string wrong(const std::string& text) {
  const auto read = read_element(text, "m.toml");
  return read ? "" : read.error().message;
}

TEST(ElementFile, ReadsTheMenusOfTheProject) {
  for (const char* const name : {"colours", "modelling", "clear", "desktop"}) {
    const auto path = places::project_folder() / "data/menus" / (std::string(name) + ".toml");
    const auto read = read_element_file(path);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_FALSE(read->widgets.empty());
  }
}

TEST(ElementFile, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(wrong("kind = \"menus\"\n[[item]]\nname = \"A\"\n"),
            "m.toml:1:8: the element: kind cannot be 'menus'; did you mean 'menu'?");
  EXPECT_EQ(wrong("[[item]]\nname = \"A\"\n[[item]]\nname = \"A\"\n"),
            "m.toml:4:8: item: there are two of the name 'A'.");
  EXPECT_EQ(wrong("[[item]]\nname = \"A\"\ncolor = 1\n").substr(0, 41),
            "m.toml:3:1: item: there is no key 'color'");
  EXPECT_NE(wrong("[[item]]\nname = \"A\"\noperation = \"extrud\"\n").find("m.toml:3:13: item 'A': "),
            std::string::npos);
  EXPECT_NE(wrong("[[item]]\nname = \"A\"\noperation = \"extrude\"\nwith = { hight = 1 }\n")
                .find("takes no 'hight'"),
            std::string::npos);
  EXPECT_NE(
      wrong("[choosing]\nnear_m = 0.002\n[[item]]\nname = \"A\"\n").find("m.toml:2:10: choosing: near_m"),
      std::string::npos)
      << "a push of 3 mm would end the nearness";
  EXPECT_NE(wrong("kind = \"dialog\"\n[[item]]\nname = \"A\"\ndefault = true\n[[item]]\nname = "
                  "\"B\"\ndefault = true\n")
                .find("only one item can be the default"),
            std::string::npos);
  EXPECT_NE(wrong("[[item]]\nname = \"A\\nB\"\n").find("control characters"), std::string::npos);
  EXPECT_NE(wrong("[[item]]\nname = \"A\"\noperation = \"create\"\nwith = { shape = \"blob\" }\n")
                .find("m.toml:4:"),
            std::string::npos);
  EXPECT_NE(wrong("").find("has no widgets"), std::string::npos);
  EXPECT_NE(
      wrong("turn_deg = nan\n[[item]]\nname = \"A\"\n").find("m.toml:1:12: the element: turn_deg is nan"),
      std::string::npos);
  EXPECT_NE(wrong("languages = [\"en\", \"nl\"]\n[[item]]\nname = \"A\"\ntext = { en = \"A\" }\n")
                .find("has no text in 'nl'"),
            std::string::npos);
  EXPECT_NE(wrong("[[item]]\nname = \"A\"\nicon = \"yelow\"\n").find("did you mean 'yellow'?"),
            std::string::npos);
}

TEST(ElementFile, RefusesTooManyWidgetsAndTooDeepMenus) {
  std::string many;
  for (std::size_t i = 0; i <= kMostWidgets; ++i) many += "[[item]]\nname = \"" + std::to_string(i) + "\"\n";
  EXPECT_NE(wrong(many).find("items at most"), std::string::npos);
  std::string deep, key = "item";
  for (int i = 0; i < 12; ++i, key += ".item")
    deep += "[[" + key + "]]\nname = \"" + std::to_string(i) + "\"\n";
  EXPECT_NE(wrong(deep).find("deep at most"), std::string::npos);
}

}  // namespace
}  // namespace icome::interaction
