#include "io/jpeg_markers.h"

#include <gtest/gtest.h>

#include <string>

namespace icome::io {
namespace {

std::string big(int value) { return {char(value >> 8), char(value & 0xff)}; }

std::string segment(int marker, const std::string& content) {
  return std::string("\xff") + char(marker) + big(int(content.size()) + 2) + content;
}

const std::string kBegins = "\xff\xd8", kScan = segment(0xda, "scan");

/// Exif data of two entries, of which the second is the orientation.
std::string exif(bool is_little, int orientation) {
  const auto number = [&](int value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += char(value >> (8 * (is_little ? i : bytes - 1 - i)) & 0xff);
    return text;
  };
  const auto entry = [&](int tag, int value) {
    return number(tag, 2) + number(3, 2) + number(1, 4) + number(value, 2) + number(0, 2);
  };
  return std::string("Exif\0\0", 6) + (is_little ? "II" : "MM") + number(42, 2) + number(8, 4) +
         number(2, 2) + entry(0x0100, 7) + entry(0x0112, orientation) + number(0, 4);
}

TEST(JpegMarkers, TellHowThePictureWasHeld) {
  const std::string jfif = segment(0xe0, std::string("JFIF\0", 5));
  for (int orientation = 1; orientation <= 8; ++orientation)
    for (const bool is_little : {true, false}) {
      const std::string held = segment(0xe1, exif(is_little, orientation));
      EXPECT_EQ(exif_orientation(kBegins + held + kScan), orientation);
      EXPECT_EQ(exif_orientation(kBegins + jfif + segment(0xe1, "http://other/xmp") + "\xff" + held),
                orientation);
      EXPECT_EQ(exif_orientation(kBegins + kScan + held), 1) << "behind the pixels";
    }
  EXPECT_EQ(exif_orientation(kBegins + segment(0xe1, exif(true, 9))), 1);
  EXPECT_EQ(exif_orientation("no JPEG"), 1);
  EXPECT_EQ(exif_orientation(""), 1);
}

/// Whatever is cut off or wrong is no fault, under the sanitizers too.
TEST(JpegMarkers, SayNothingWhereTheyAreDamaged) {
  const std::string whole = kBegins + segment(0xe1, exif(true, 6));
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_TRUE(exif_orientation(std::string(whole, 0, length)) == 1 || length + 6 >= whole.size()) << length;
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const char byte : {'\0', '\x7f', '\xff'}) {
      std::string damaged = whole;
      damaged[at] = byte;
      const int told = exif_orientation(damaged);
      EXPECT_TRUE(told >= 1 && told <= 8);
    }
}

TEST(JpegMarkers, TellFilesOfAdobesKind) {
  EXPECT_TRUE(has_adobe_marker(kBegins + segment(0xee, std::string("Adobe\0d", 7)) + kScan));
  EXPECT_FALSE(has_adobe_marker(kBegins + segment(0xed, std::string("Adobe\0d", 7)) + kScan));
  EXPECT_FALSE(has_adobe_marker(kBegins + kScan));
}

}  // namespace
}  // namespace icome::io
