#include "render/model/picture_decoder.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "base/random.h"

namespace icome::render {
namespace {

std::string from_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(char(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
  return bytes;
}

// 3 x 4 pixels; in row y: red, green, and the palette's colour y (red, green, blue, white).
const std::string kGif = from_hex(
    "47494638396103000400910000ff000000ff000000ffffffff2c000000000300040000020a0443100c433014c17005003b");
// The same interlaced, with green clear.
const std::string kInterlacedGif = from_hex(
    "47494638396103000400910000ff000000ff000000ffffffff21f90401000001002c000000000300040040020a0443100c45300c"
    "c1"
    "7005003b");
// 16 x 8 pixels, the left half red, the right blue.
const std::string kJpeg = from_hex(
    "ffd8ffe000104a46494600010100000100010000ffdb0043000d090a0b0a080d0b0a0b0e0e0d0f13201513121213271c1e17"
    "202e2931302e292d2c333a4a3e333646372c2d405741464c4e525352323e5a615a50604a51524fffdb0043010e0e0e131113"
    "261515264f352d354f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f"
    "4f4f4f4f4f4f4f4fffc00011080008001003011100021101031101ffc4001f00000105010101010101000000000000000001"
    "02030405060708090a0bffc400b5100002010303020403050504040000017d01020300041105122131410613516107227114"
    "328191a1082342b1c11552d1f02433627282090a161718191a25262728292a3435363738393a434445464748494a53545556"
    "5758595a636465666768696a737475767778797a838485868788898a92939495969798999aa2a3a4a5a6a7a8a9aab2b3b4b5"
    "b6b7b8b9bac2c3c4c5c6c7c8c9cad2d3d4d5d6d7d8d9dae1e2e3e4e5e6e7e8e9eaf1f2f3f4f5f6f7f8f9faffc4001f010003"
    "0101010101010101010000000000000102030405060708090a0bffc400b51100020102040403040705040400010277000102"
    "031104052131061241510761711322328108144291a1b1c109233352f0156272d10a162434e125f11718191a262728292a35"
    "363738393a434445464748494a535455565758595a636465666768696a737475767778797a82838485868788898a92939495"
    "969798999aa2a3a4a5a6a7a8a9aab2b3b4b5b6b7b8b9bac2c3c4c5c6c7c8c9cad2d3d4d5d6d7d8d9dae2e3e4e5e6e7e8e9ea"
    "f2f3f4f5f6f7f8f9faffda000c03010002110311003f00e7ebc63f4930abf623f2a3ffd9");

std::string png_of_four() {
  const auto bytes = charts::encode_png({2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 128, 0, 0, 0, 0}});
  return {bytes->begin(), bytes->end()};
}

using Pixel = std::array<int, 4>;

Pixel pixel_of(const charts::Image& image, int x, int y) {
  const auto* p = image.pixel(x, y);
  return {p[0], p[1], p[2], p[3]};
}

TEST(PictureDecoder, ReadsPng) {
  const auto image = decode_picture(png_of_four());
  ASSERT_TRUE(image.has_value()) << image.error().message;
  EXPECT_EQ(pixel_of(*image, 0, 0), (Pixel{255, 0, 0, 255}));
  EXPECT_EQ(pixel_of(*image, 1, 0), (Pixel{0, 255, 0, 255}));
  EXPECT_EQ(pixel_of(*image, 0, 1)[3], 128);
  EXPECT_EQ(pixel_of(*image, 1, 1)[3], 0);
}

TEST(PictureDecoder, ReadsJpeg) {
  const auto image = decode_picture(kJpeg);
  ASSERT_TRUE(image.has_value()) << image.error().message;
  EXPECT_EQ(image->width, 16);
  EXPECT_EQ(image->height, 8);
  const Pixel left = pixel_of(*image, 3, 4), right = pixel_of(*image, 12, 4);
  EXPECT_GT(left[0], 220);
  EXPECT_LT(left[2], 40);
  EXPECT_GT(right[2], 220);
  EXPECT_EQ(right[3], 255);
}

TEST(PictureDecoder, ReadsGif) {
  const auto image = decode_picture(kGif);
  ASSERT_TRUE(image.has_value()) << image.error().message;
  EXPECT_EQ(pixel_of(*image, 0, 3), (Pixel{255, 0, 0, 255}));
  EXPECT_EQ(pixel_of(*image, 1, 0), (Pixel{0, 255, 0, 255}));
  EXPECT_EQ(pixel_of(*image, 2, 2), (Pixel{0, 0, 255, 255}));
  EXPECT_EQ(pixel_of(*image, 2, 3), (Pixel{255, 255, 255, 255}));
}

TEST(PictureDecoder, ReadsInterlacedGifsWithAClearColour) {
  const auto image = decode_picture(kInterlacedGif);
  ASSERT_TRUE(image.has_value()) << image.error().message;
  EXPECT_EQ(pixel_of(*image, 1, 0)[3], 0);
  EXPECT_EQ(pixel_of(*image, 2, 2), (Pixel{0, 0, 255, 255}));
  EXPECT_EQ(pixel_of(*image, 2, 3), (Pixel{255, 255, 255, 255}));
}

TEST(PictureDecoder, OtherFilesAreRefused) {
  for (const char* bytes : {"", "P", "BM and more", "<svg/>"}) {
    const auto image = decode_picture(bytes);
    ASSERT_FALSE(image.has_value());
    EXPECT_NE(image.error().message.find("PNG, JPEG and GIF"), std::string::npos);
  }
}

TEST(PictureDecoder, PicturesThatWouldFillTheMemoryAreRefused) {
  std::string gif = kGif;
  gif.replace(30, 4, "\xff\xff\xff\xff");  // width and height of the picture in the file
  const auto image = decode_picture(gif);
  ASSERT_FALSE(image.has_value());
  EXPECT_NE(image.error().message.find("65535 x 65535"), std::string::npos) << image.error().message;
}

TEST(PictureDecoder, DamagedFilesHarmNothing) {
  base::Random random(3);
  for (const std::string& whole : {png_of_four(), kJpeg, kGif, kInterlacedGif}) {
    for (int i = 0; i < 2000; ++i) {
      std::string bytes = whole;
      for (std::uint64_t n = random.index(4); n > 0; --n)
        bytes[random.index(bytes.size())] = char(random.index(256));
      if (random.index(3) == 0) bytes.resize(random.index(bytes.size()));
      const auto image = decode_picture(bytes);
      if (image) {
        ASSERT_EQ(image->rgba.size(), 4 * std::size_t(image->width) * std::size_t(image->height));
      } else {
        ASSERT_FALSE(image.error().message.empty());
      }
    }
  }
}

}  // namespace
}  // namespace icome::render
