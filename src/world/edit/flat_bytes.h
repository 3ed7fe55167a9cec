#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "world/shape/geometry.h"

namespace icome::world {

/// FlatBuffers counts with 32 bits, one of them a sign; this leaves it room to grow in.
inline constexpr std::size_t kMostFlatBytes = std::size_t{1} << 30;
/// Limit of bytes to read: a little above that of writing, as sizes are estimated when writing.
inline constexpr std::size_t kMostReadBytes = kMostFlatBytes + (kMostFlatBytes >> 2);

/// Takes values out of FlatBuffers that somebody else may have written. A value that does not fit is
/// read as empty and remembered as the fault, so that one check at the end tells whether all was well.
///
/// Parts of a FlatBuffer may overlap, so that few bytes can stand for very many. Honest ones never do:
/// taking more bytes out than there are is refused.
class FlatReader {
 public:
  /// Reads `bytes` in place, which must outlive this, or copies them to where numbers can be read.
  explicit FlatReader(std::string_view bytes);
  FlatReader(const FlatReader&) = delete;
  FlatReader& operator=(const FlatReader&) = delete;

  const std::uint8_t* data() const { return reinterpret_cast<const std::uint8_t*>(bytes_.data()); }
  std::size_t size() const { return bytes_.size(); }

  /// Remembers why the bytes are unusable: the first reason counts, an empty one is none.
  void refuse(const std::string& why);
  /// Empty as long as all is well.
  const std::string& fault() const { return fault_; }

  /// The text of a string; empty for none.
  template <typename Text>
  std::string text(const Text* text) {
    return text && take(text->size()) ? std::string(text->data(), text->size()) : std::string();
  }

  /// A vector of bytes without a copy; valid as long as the bytes are there.
  template <typename Bytes>
  std::string_view view(const Bytes& bytes) {
    if (!take(bytes.size())) return {};
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  /// The items of a vector of numbers, several to one item such as a point; empty for none.
  template <typename Item, typename Numbers>
  std::vector<Item> items(const Numbers* numbers) {
    static_assert(std::endian::native == std::endian::little);
    if (!numbers) return {};
    const std::size_t bytes = numbers->size() * sizeof(typename Numbers::value_type);
    if (bytes % sizeof(Item) != 0)
      refuse("The bytes of a shape or an edit end within a point or a triangle.");
    if (bytes == 0 || !take(bytes) || !fault_.empty()) return {};
    std::vector<Item> result(bytes / sizeof(Item));
    std::memcpy(static_cast<void*>(result.data()), numbers->data(), bytes);
    return result;
  }

 private:
  bool take(std::size_t bytes);

  std::string copy_;
  std::string_view bytes_;
  std::size_t left_;
  std::string fault_;
};

/// An affine transform as numbers, without its last row, column after column, and back.
std::array<double, 12> frame_numbers(const Affine3& frame);
Affine3 frame_of(const std::array<double, 12>& numbers);

}  // namespace icome::world
