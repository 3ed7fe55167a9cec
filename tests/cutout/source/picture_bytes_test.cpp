#include "cutout/source/picture_bytes.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <array>
#include <memory>
#include <vector>

namespace icome::cutout {
namespace {

/// A JPEG file of one printed colour: cyan, magenta, yellow and black as files of Adobe's kind store them,
/// 255 where nothing is printed.
std::string printed(const std::array<std::uint8_t, 4>& stored) {
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 32 * 16; ++i) pixels.insert(pixels.end(), stored.begin(), stored.end());
  const std::unique_ptr<void, decltype(&tjDestroy)> jpeg(tjInitCompress(), tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(tjCompress2(jpeg.get(), pixels.data(), 32, 0, 16, TJPF_CMYK, &bytes, &size, TJSAMP_444, 95, 0),
            0);
  const std::unique_ptr<unsigned char, decltype(&tjFree)> owned(bytes, tjFree);
  return {reinterpret_cast<const char*>(bytes), size};
}

void expect_all(const std::string& jpeg, const std::array<int, 3>& bgr) {
  const auto frame = decode_picture(jpeg, "printed.jpg");
  ASSERT_TRUE(frame) << frame.error().message;
  ASSERT_EQ(frame->bgr.size(), 32U * 16 * 3);
  for (std::size_t i = 0; i < frame->bgr.size(); ++i) ASSERT_NEAR(frame->bgr[i], bgr[i % 3], 3) << i;
}

TEST(PictureBytes, ReadsJpegOfFourPrintedColours) {
  expect_all(printed({255, 255, 255, 255}), {255, 255, 255});
  expect_all(printed({0, 255, 255, 255}), {255, 255, 0});  // cyan
  expect_all(printed({255, 255, 0, 255}), {0, 255, 255});  // yellow
  expect_all(printed({255, 255, 255, 128}), {128, 128, 128});
  // Without Adobe's marker the numbers are what is printed: here 0, 128, 128 and 128, the YCCK of this
  // colour.
  std::string plain = printed({255, 255, 255, 128});
  const std::size_t marker = plain.find("\xff\xee");
  ASSERT_NE(marker, std::string::npos);
  plain.erase(marker, 16);
  expect_all(plain, {63, 63, 127});
}

}  // namespace
}  // namespace icome::cutout
