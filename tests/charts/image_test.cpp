#include "charts/image.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <iterator>

namespace icome::charts {
namespace {

namespace fs = std::filesystem;

Image checkered(int width, int height) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    const std::uint8_t value = i % 2 ? 255 : 0;
    for (const std::uint8_t channel : {value, std::uint8_t{128}, std::uint8_t{7}, std::uint8_t{255}}) {
      image.rgba.push_back(channel);
    }
  }
  return image;
}

/// A folder of this test's own that goes with it.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("icome_image_test_" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

std::uint32_t big_endian(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 |
         std::uint32_t{bytes[at + 2]} << 8 | bytes[at + 3];
}

TEST(EncodePng, BeginsWithTheSignatureAndTheSize) {
  const auto bytes = encode_png(checkered(37, 11));
  ASSERT_TRUE(bytes.has_value());
  // PNG specification, sections 5.2 and 11.2.1.
  const std::array<std::uint8_t, 8> signature{0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a};
  EXPECT_TRUE(std::equal(signature.begin(), signature.end(), bytes->begin()));
  EXPECT_EQ(big_endian(*bytes, 16), 37U);
  EXPECT_EQ(big_endian(*bytes, 20), 11U);
}

TEST(EncodePng, RefusesAnEmptyPicture) { EXPECT_FALSE(encode_png(Image{}).has_value()); }

TEST(WritePng, LeavesTheEncodedBytesAndNothingElse) {
  const Folder folder;
  const Image image = checkered(8, 8);
  ASSERT_TRUE(write_png(image, folder.path / "a.png").has_value());
  std::ifstream file(folder.path / "a.png", std::ios::binary);
  const std::vector<std::uint8_t> read{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(read, *encode_png(image));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 1);
}

TEST(WritePng, NamesTheFileThatCannotBeWritten) {
  const auto written = write_png(checkered(2, 2), "/no/such/folder/a.png");
  ASSERT_FALSE(written.has_value());
  EXPECT_NE(written.error().message.find("/no/such/folder/a.png"), std::string::npos);
}

TEST(WritePng, CleansUpWhenThePathIsAFolder) {
  const Folder folder;
  fs::create_directories(folder.path / "taken");
  EXPECT_FALSE(write_png(checkered(2, 2), folder.path / "taken").has_value());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 1);
}

}  // namespace
}  // namespace icome::charts
