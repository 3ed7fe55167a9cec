#include "interaction/elements/element_file.h"

#include <gtest/gtest.h>

#include "interaction/elements/element_use.h"
#include "places.h"

namespace icome::interaction {
namespace {

std::string wrong(const std::string& text) {
  const auto read = read_element(text, "m.toml");
  return read ? "" : read.error().message;
}

TEST(ElementFile, ReadsTheMenusOfTheProject) {
  for (const char* const name : {"colours", "modelling", "clear", "desktop", "properties"}) {
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
  for (const char* const toml :
       {"[[item]]\nname = \"A\"\nchecked = true\n",
        "[[item]]\nname = \"A\"\nkind = \"check\"\ngroup = \"g\"\n",
        "[[item]]\nname = \"A\"\ncommand = \"edit.undo\"\n[[item.item]]\nname = \"B\"\n",
        "columns = 2\n[[item]]\nname = \"A\"\n", "kind = \"ring\"\ncone_deg = 20\n[[item]]\nname = \"A\"\n",
        "[[item]]\nname = \" \"\n", "[[item]]\nname = \"A\"\ntext = \"a\\u0007\"\n",
        "kind = \"dialog\"\n[[item]]\nname = \"A\"\nenabled = false\ndefault = true\n",
        "[[item]]\nname = \"A\"\nkind = \"number\"\nunit = \"\\n\"\n"})
    EXPECT_NE(wrong(toml), "") << toml;
  EXPECT_NE(wrong("[fading]\nbegins_m = 0.001\n[[item]]\nname = \"A\"\n").find(":2:"), std::string::npos);
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

TEST(ElementFile, ReadsListsNumbersPickersAndTabs) {
  const auto read = read_element(
      "[[item]]\nname = \"T\"\nkind = \"tabs\"\nvalue = \"P2\"\n"
      "[[item.item]]\nname = \"P1\"\n"
      "[[item.item.item]]\nname = \"L\"\nkind = \"list\"\nrows = 4\nvalue = \"r2\"\n"
      "[[item.item.item.item]]\nname = \"r1\"\n[[item.item.item.item]]\nname = \"r2\"\n"
      "[[item.item]]\nname = \"P2\"\n"
      "[[item.item.item]]\nname = \"N\"\nkind = \"number\"\nleast = 5\nmost = 9\nstep = 2\nunit = \"mm\"\n"
      "[[item.item.item]]\nname = \"C\"\nkind = \"colour\"\nvalue = \"gold\"\n"
      "[[item]]\nname = \"B\"\nkind = \"button\"\n[[item]]\nname = \"S\"\nkind = \"toggle\"\n",
      "m.toml");
  ASSERT_TRUE(read) << read.error().message;
  const auto widget = [&](const char* name) -> const Widget& { return *find_widget(read->widgets, name); };
  EXPECT_EQ(widget("P1").kind, WidgetKind::Page);
  EXPECT_EQ(widget("r2").kind, WidgetKind::Row);
  EXPECT_EQ(widget("L").rows, 4U);
  EXPECT_EQ(widget("L").chosen, "r2");
  EXPECT_EQ(widget("T").chosen, "P2");
  EXPECT_EQ(widget("N").value, 5.0);
  EXPECT_EQ(widget("N").unit, "mm");
  EXPECT_EQ(widget("C").colour[2], 0.0F);
  EXPECT_EQ(widget("B").kind, WidgetKind::Item);
  EXPECT_EQ(widget("S").kind, WidgetKind::Check);
}

TEST(ElementFile, SaysWhatIsWrongWithTheNewKindsAndWhere) {
  const auto item = [](const std::string& more) { return "[[item]]\nname = \"A\"\n" + more; };
  const auto expect = [&](const std::string& toml, const std::string& what) {
    EXPECT_NE(wrong(toml).find(what), std::string::npos) << wrong(toml);
  };
  const std::string number = "kind = \"number\"\n", colour = "kind = \"colour\"\n",
                    list = "kind = \"list\"\n";
  const std::string row = "[[item.item]]\nname = \"r\"\n";
  expect(item(number + "least = 5\nmost = 5\n"), "m.toml:5:8: item 'A': most must be above least.");
  expect(item(number + "value = 200\n"), "m.toml:4:9: item: value is 200; choose a number from 0 to 100.");
  expect(item(number + "step = 0\n"), "m.toml:4:8:");
  expect(item(number + "unit = 3\n"), "m.toml:4:8:");
  expect(item(colour + "value = \"yelow\"\n"), "m.toml:4:9: item 'A': there is no colour 'yelow'");
  expect(item(list), "m.toml:1:1: item 'A': it has no rows");
  expect(item(list + "rows = 2\n" + row),
         "m.toml:4:8: item: rows is 2; choose a whole number from 3 to 100.");
  expect(item(list + "value = \"s\"\n" + row), "m.toml:4:9: item 'A': it has no 's'");
  expect(item(list + row + "kind = \"check\"\n"), "m.toml:4:1: item 'r': a row is an item of no other kind");
  expect(item(list + row + "[[item.item.item]]\nname = \"x\"\n"), "m.toml:4:1: item 'r': a row");
  expect(item("kind = \"tabs\"\n" + row), "m.toml:4:1: item 'r': the page is empty.");
  expect(item("rows = 4\n"), "m.toml:3:8: item 'A': rows are of a list");
  expect("kind = \"pie\"\nrows = 4\n" + item(""), "m.toml:2:8: the element: only a menu has rows.");
  expect("kind = \"toolbar\"\n" + item(colour), "m.toml:2:1: item 'A': lists, tabs and pickers");
  expect("rows = 4\n" + item(colour), "m.toml:2:1: item 'A': lists, tabs and pickers");
  expect(item(number + row), "m.toml:1:1: item 'A': only an item of kind");
  // Values for operations.
  const std::string op = "operation = \"colour\"\n";
  expect(item(colour + "value_as = \"colour\"\n"), "m.toml:4:12: item 'A': value_as needs operation.");
  expect(item(colour + op + "value_as = \"color\"\n"),
         "m.toml:5:12: item 'A': colour takes no 'color'; did you mean");
  expect(item(number + op + "value_as = \"colour\"\n"),
         "m.toml:5:12: item 'A': its value does not fit: 'colour'");
  expect(item(op + "value_as = \"colour\"\n"), "m.toml:4:12: item 'A': it has no value");
  expect(item(colour + op + "value_as = \"colour\"\nwith = { colour = \"red\" }\n"),
         "m.toml:5:12: item 'A': 'colour' is said");
  expect(item(number + "least = -5\noperation = \"place\"\nvalue_as = \"factor\"\n"),
         "m.toml:6:12: item 'A': its value");
  expect(item(number + "value_times = 2\n"), "m.toml:4:15: item 'A': value_times needs value_as.");
  expect(item(list + "operation = \"create\"\nvalue_as = \"shape\"\n" + row),
         "m.toml:5:12: item 'A': its value does not fit");
  EXPECT_EQ(wrong(item(colour + op + "value_as = \"colour\"\n")), "");
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
