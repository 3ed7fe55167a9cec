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
/// What is read may be a little more than what was counted when it was written.
inline constexpr std::size_t kMostReadBytes = kMostFlatBytes + (kMostFlatBytes >> 2);

/// Takes values out of FlatBuffers that somebody else may have written. What does not fit is read as
/// nothing and remembered as the fault, so that one look at the end tells whether all was well.
///
/// Parts of a FlatBuffer may lie over each other, so that few bytes can stand for very many. Honest ones
/// never do: whoever takes more out than there is, is refused.
class FlatReader {
 public:
  /// Reads where `bytes` are, which outlive this, or copies them to where numbers can be read.
  explicit FlatReader(std::string_view bytes);
  FlatReader(const FlatReader&) = delete;
  FlatReader& operator=(const FlatReader&) = delete;

  const std::uint8_t* data() const { return reinterpret_cast<const std::uint8_t*>(bytes_.data()); }
  std::size_t size() const { return bytes_.size(); }

  /// Remembers why the bytes are no good: the first reason counts, an empty one is none.
  void refuse(const std::string& why);
  /// Empty while all is well.
  const std::string& fault() const { return fault_; }

  /// Of a string; empty for none.
  template <typename Text>
  std::string text(const Text* text) {
    return text && take(text->size()) ? std::string(text->data(), text->size()) : std::string();
  }

  /// The same without a copy, of a vector of bytes: as long as the bytes are there.
  template <typename Bytes>
  std::string_view view(const Bytes& bytes) {
    if (!take(bytes.size())) return {};
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  /// Of a vector of numbers, several of which may make one item, such as a point; empty for none.
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

/// An affine transform without its last row, column after column, and back.
std::array<double, 12> frame_numbers(const Affine3& frame);
Affine3 frame_of(const std::array<double, 12>& numbers);

}  // namespace icome::world
