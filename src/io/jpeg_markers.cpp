#include "io/jpeg_markers.h"

#include <cstddef>
#include <cstdint>

#include "io/byte_order.h"

namespace icome::io {
namespace {

constexpr unsigned char kStartOfScan = 0xDA, kFirstApp = 0xE0;

/// A number at a place of bytes; 0 beyond their end.
template <typename Number>
Number number_at(std::string_view bytes, std::size_t at, ByteOrder order) {
  return at <= bytes.size() && bytes.size() - at >= sizeof(Number) ? load<Number>(bytes.data() + at, order)
                                                                   : Number{};
}

/// The content of the first application segment of a number that begins with some text, after that; empty:
/// none.
std::string_view app_segment(std::string_view jpeg, int number, std::string_view begins) {
  if (!jpeg.starts_with("\xff\xd8")) return {};
  for (std::size_t at = 2; at + 4 <= jpeg.size() && jpeg[at] == '\xff';) {
    const auto marker = static_cast<unsigned char>(jpeg[at + 1]);
    if (marker == kStartOfScan) return {};
    const std::size_t length = number_at<std::uint16_t>(jpeg, at + 2, ByteOrder::BigEndian);
    if (marker == 0xFF) {  // filling
      ++at;
      continue;
    }
    if (length < 2) return {};
    const std::string_view content = jpeg.substr(at + 4).substr(0, length - 2);
    if (marker == kFirstApp + number && content.starts_with(begins)) return content.substr(begins.size());
    at += 2 + length;
  }
  return {};
}

}  // namespace

int exif_orientation(std::string_view jpeg) {
  constexpr std::uint16_t kOrientation = 0x0112;
  constexpr std::size_t kEntry = 12;  // bytes: tag, type, count, value
  const std::string_view tiff = app_segment(jpeg, 1, std::string_view("Exif\0\0", 6));
  const bool is_little = tiff.starts_with("II");
  if (!is_little && !tiff.starts_with("MM")) return 1;
  const ByteOrder order = is_little ? ByteOrder::LittleEndian : ByteOrder::BigEndian;
  const std::size_t directory = number_at<std::uint32_t>(tiff, 4, order);
  const std::size_t entries = number_at<std::uint16_t>(tiff, directory, order);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + i * kEntry;
    if (number_at<std::uint16_t>(tiff, entry, order) != kOrientation) continue;
    const int value = number_at<std::uint16_t>(tiff, entry + 8, order);
    return value >= 1 && value <= 8 ? value : 1;
  }
  return 1;
}

bool has_adobe_marker(std::string_view jpeg) { return !app_segment(jpeg, 14, "Adobe").empty(); }

}  // namespace icome::io
