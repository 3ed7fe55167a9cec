#include "files/pictures/picture_bytes.h"

#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace icome::files {
namespace {

/// The PNG's pixels as red, green, blue and opacity, row after row from the top.
std::vector<unsigned> unpacked(const std::string& png) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, png.data(), png.size()), 0);
  image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
  return {pixels.begin(), pixels.end()};
}

std::vector<unsigned> there_and_back(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                                     const std::string& pixels) {
  const auto png = png_of({width, height, channels, pixels});
  EXPECT_TRUE(png.has_value());
  EXPECT_EQ(picture_type(*png), "image/png");
  return unpacked(*png);
}
using Pixels = std::vector<unsigned>;

TEST(PictureBytes, BecomePngFilesRowsFromTheTop) {
  EXPECT_EQ(there_and_back(1, 2, 1, "\x10\x20"), (Pixels{32, 32, 32, 255, 16, 16, 16, 255}));
  EXPECT_EQ(there_and_back(1, 2, 2, std::string("\x10\xff\x20\x00", 4)).at(7), 255U);
  EXPECT_EQ(there_and_back(2, 1, 3, "\x01\x02\x03\x04\x05\x06"), (Pixels{1, 2, 3, 255, 4, 5, 6, 255}));
  EXPECT_EQ(there_and_back(1, 1, 4, "\x01\x02\x03\xff"), (Pixels{1, 2, 3, 255}));
}

TEST(PictureBytes, AreRefusedWhereTheyMakeNoSense) {
  EXPECT_FALSE(png_of({0, 1, 1, ""}).has_value());
  EXPECT_FALSE(png_of({1, 1, 0, ""}).has_value());
  EXPECT_FALSE(png_of({1, 1, 5, "12345"}).has_value());
  EXPECT_FALSE(png_of({2, 2, 1, "123"}).has_value());
  EXPECT_FALSE(png_of({0x10000, 0x10000, 4, ""}).has_value());
  EXPECT_FALSE(png_of({0xffffffff, 0xffffffff, 4, "abcd"}).has_value());
}

void expect_mean(const std::string& bytes, const std::array<double, 3>& mean) {
  const auto found = picture_mean(bytes);
  ASSERT_TRUE(found.has_value());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((*found)[i], mean[i], 0.01) << i;
}

TEST(PictureBytes, HaveAMean) {
  expect_mean(*png_of({2, 1, 3, std::string("\xff\x80\x00\x00\x80\x33", 6)}), {0.5, 0.5, 0.1});
  std::vector<unsigned char> pixels;
  for (int i = 0; i < 40 * 24; ++i) {
    for (const int part : {i % 40 < 20 ? 255 : 0, 100, 50})
      pixels.push_back(static_cast<unsigned char>(part));
  }
  const std::unique_ptr<void, decltype(&tjDestroy)> jpeg(tjInitCompress(), tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  ASSERT_EQ(tjCompress2(jpeg.get(), pixels.data(), 40, 0, 24, TJPF_RGB, &bytes, &size, TJSAMP_444, 95, 0), 0);
  const std::string file(reinterpret_cast<const char*>(bytes), size);
  tjFree(bytes);
  expect_mean(file, {0.5, 100.0 / 255.0, 50.0 / 255.0});
  EXPECT_FALSE(picture_mean(file.substr(0, 200)).has_value());
  EXPECT_FALSE(picture_mean("GIF89a").has_value());
}

/// One grey pixel of so much of 65535, with nothing on how bright that is.
std::string png_of_16_bits(std::uint16_t grey) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  const auto append = [](png_structp to, png_bytep data, png_size_t size) {
    static_cast<std::string*>(png_get_io_ptr(to))->append(reinterpret_cast<const char*>(data), size);
  };
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, 1, 1, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  const std::array<png_byte, 2> row = {png_byte(grey >> 8U), png_byte(grey & 0xffU)};
  png_write_row(png, row.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

TEST(PictureBytes, OfSixteenBitsHaveTheMeanThatStandsInThem) {
  expect_mean(png_of_16_bits(0x8000), {0.5, 0.5, 0.5});
  expect_mean(png_of_16_bits(0x1999), {0.1, 0.1, 0.1});
}

TEST(PictureBytes, SayHowManyPixelsTheyHave) {
  EXPECT_EQ(pixel_count(*png_of({3, 2, 1, "abcdef"})), 6U);
  EXPECT_EQ(pixel_count("\x89PNG\r\n\x1a\n"), 0U);
  EXPECT_EQ(pixel_count("\xff\xd8\xff"), 0U);
  EXPECT_EQ(pixel_count("GIF89a"), 0U);
}

TEST(PictureBytes, AreKnownByTheirHead) {
  EXPECT_EQ(picture_type("\x89PNG\r\n\x1a\nx"), "image/png");
  EXPECT_EQ(picture_type("\xff\xd8\xff\xe0"), "image/jpeg");
  EXPECT_EQ(picture_type("GIF87a"), "image/gif");
  EXPECT_EQ(picture_type("GIF89"), "");
  EXPECT_EQ(picture_type("root:x:0:0"), "");
  EXPECT_EQ(picture_type(""), "");
}

}  // namespace
}  // namespace icome::files
