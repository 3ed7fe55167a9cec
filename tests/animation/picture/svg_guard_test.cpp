#include "animation/picture/svg_guard.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "animation/picture/svg_picture.h"

namespace icome::animation {
namespace {

std::string svg_of(const std::string& content) {
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' width='20' "
      "height='20'>{}</svg>",
      content);
}

std::string chain(int length, const std::string& attributes) {
  std::string text = "<g id='g0'><rect width='9' height='9'/></g>";
  for (int i = 1; i <= length; ++i)
    text += fmt::format("<g id='g{}' {}><use xlink:href='#g{}'/></g>", i, attributes, i - 1);
  return text;
}

std::string fault(const std::string& content) {
  const auto cost = svg_cost(svg_of(content), "a.svg");
  return cost ? "" : cost.error().message;
}

TEST(SvgGuard, CountsWhatLiesInOneAnother) {
  const SvgCost plain =
      svg_cost(svg_of("<g><g><rect/></g></g><g opacity='0.5'><g opacity='0.5'/></g>"), "a").value();
  EXPECT_EQ(plain.depth, 4);
  EXPECT_EQ(plain.layers, 2);
  const SvgCost uses = svg_cost(svg_of(chain(10, "opacity='0.9'")), "a").value();
  EXPECT_EQ(uses.depth, 23);
  EXPECT_EQ(uses.layers, 10);
  // Side by side is not within one another.
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "<g opacity='0.5'/>";
  EXPECT_EQ(svg_cost(svg_of(many), "a").value().layers, 1);
}

TEST(SvgGuard, FollowsUrlsStylesAndPictures) {
  EXPECT_EQ(
      svg_cost(svg_of("<mask id='m'><rect mask='url(#n)'/></mask><mask id='n'/><rect style='mask:url(#m)'/>"),
               "a")
          .value()
          .layers,
      4);
  EXPECT_EQ(
      svg_cost(svg_of("<style>.a { filter: url(\"#f\") }</style><filter id='f'><feFlood/><feFlood/></filter>"
                      "<rect class='a'/>"),
               "a")
          .value()
          .layers,
      11);  // sheets could make one of every element
  // <svg width='1' height='1'><g opacity='1'><g opacity='1'/></g></svg>
  EXPECT_EQ(
      svg_cost(
          svg_of(
              "<image xlink:href='data:image/svg+xml;base64,"
              "PHN2ZyB3aWR0aD0nMScgaGVpZ2h0PScxJz48ZyBvcGFjaXR5PScxJz48ZyBvcGFjaXR5PScxJy8+PC9nPjwvc3ZnPg=="
              "'/>"),
          "a")
          .value()
          .layers,
      3);
}

TEST(SvgGuard, RefusesWhatWouldEndTheProgram) {
  const std::string deep = "a.svg: it cannot be drawn: it has elements more than 256 deep in one another";
  EXPECT_EQ(fault(chain(2000, "")), deep);
  EXPECT_EQ(fault(chain(200'000, "")), deep);
  std::string nested;
  for (int i = 0; i < 5000; ++i) nested += "<g>";
  for (int i = 0; i < 5000; ++i) nested += "</g>";
  EXPECT_EQ(fault(nested), deep);
  EXPECT_NE(
      fault("<g id='a'><use xlink:href='#b'/></g><g id='b'><use href='#a'/></g>").find("drawn within itself"),
      std::string::npos);
  EXPECT_NE(fault("<image href='data:image/svg+xml,%3Csvg/%3E'/>").find("cannot be looked into"),
            std::string::npos);
}

TEST(SvgGuard, RefusesWhatItCannotKnow) {
  const std::string entity = "<!DOCTYPE svg [<!ENTITY e '#g1'>]>" + svg_of("<use xlink:href='&e;'/>");
  EXPECT_FALSE(svg_cost(entity, "a"));
  // Names of spaces by entities, as some programs write them, do no harm.
  EXPECT_TRUE(svg_cost("<!DOCTYPE svg [<!ENTITY n 'http://a'>]>" + svg_of("<g xmlns:x='&n;'/>"), "a"));
  EXPECT_FALSE(svg_cost("<?xml version='1.0' encoding='UTF-7'?>" + svg_of(""), "a"));
  EXPECT_TRUE(svg_cost("<?xml version='1.0' encoding='UTF-8'?>" + svg_of(""), "a"));
}

TEST(SvgGuard, LetsThroughWhatIsDrawn) {
  // As deep as is let through, by ways that take the renderer much of its stack: it lives, whatever it draws.
  for (const std::string& attributes : {std::string(), std::string("opacity='0.99'")})
    EXPECT_TRUE(SvgPicture::read(svg_of(chain(120, attributes)), "a", 10).value().drawn(20, 20, 20));
  std::string masks = "<rect width='9' height='9' mask='url(#m1)'/>";
  for (int i = 1; i < 120; ++i)
    masks += fmt::format("<mask id='m{}'><rect width='9' height='9' fill='#fff' mask='url(#m{})'/></mask>", i,
                         i + 1);
  const auto picture = SvgPicture::read(svg_of(masks), "a", 10);
  ASSERT_TRUE(picture) << picture.error().message;
  [[maybe_unused]] const auto drawn = picture->drawn(20, 20, 0.5);
  std::string patterns = "<rect width='9' height='9' fill='url(#p1)'/>";
  for (int i = 1; i < 120; ++i)
    patterns += fmt::format(
        "<pattern id='p{}' width='1' height='1'><rect width='9' height='9' fill='url(#p{})'/>"
        "</pattern>",
        i, i + 1);
  [[maybe_unused]] const auto filled = SvgPicture::read(svg_of(patterns), "a", 10).value().drawn(20, 20, 0.5);
}

}  // namespace
}  // namespace icome::animation
