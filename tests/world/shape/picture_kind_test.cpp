#include "world/shape/picture_kind.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace icome::world {
namespace {

/// The first bytes of a PNG of this colour type (ISO/IEC 15948, 11.2.2).
std::string png_of_type(char type) {
  std::string bytes("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\1\0\0\0\1\x08", 25);
  return bytes + type + std::string(7, '\0');
}

TEST(PictureKind, GreyIsWhatAFileSaysAndNotWhatItShows) {
  EXPECT_TRUE(is_grey_picture(png_of_type(0)));
  EXPECT_TRUE(is_grey_picture(png_of_type(4)));
  EXPECT_FALSE(is_grey_picture(png_of_type(2)));
  EXPECT_FALSE(is_grey_picture(png_of_type(3)));
  EXPECT_FALSE(is_grey_picture(png_of_type(6)));
  // A comment before the frame header (ISO/IEC 10918-1, B.2.2), whose last byte here is the components.
  const std::string head("\xff\xd8\xff\xfe\0\4ab\xff\xc0\0\x0b\x08\0\1\0\1", 17);
  EXPECT_TRUE(is_grey_picture(head + '\1'));
  EXPECT_FALSE(is_grey_picture(head + '\3'));
  EXPECT_FALSE(is_grey_picture(head));
  EXPECT_FALSE(is_grey_picture(""));
}

TEST(PictureKind, OnlyWhatMayBeClearIsLookedAt) {
  EXPECT_FALSE(may_be_clear(png_of_type(2)));
  EXPECT_TRUE(may_be_clear(png_of_type(2) + "tRNS"));
  EXPECT_TRUE(may_be_clear(png_of_type(6)));
  EXPECT_FALSE(may_be_clear("\xff\xd8\xff\xe0"));
}

TEST(PictureKind, LeavesHaveEdgesAndGlassHasNone) {
  const auto of = [](std::vector<int> alphas) {
    std::vector<std::uint8_t> pixels;
    for (const int alpha : alphas) pixels.insert(pixels.end(), {9, 9, 9, std::uint8_t(alpha)});
    return opacity_of(pixels);
  };
  EXPECT_EQ(of({255, 255, 255, 255}), PictureOpacity::Opaque);
  EXPECT_EQ(of({255, 0, 0, 128, 255, 255, 255, 0}), PictureOpacity::CutOut);
  EXPECT_EQ(of({255, 128, 128, 128}), PictureOpacity::Blended);
}

}  // namespace
}  // namespace icome::world
