#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

namespace icome::io {

enum class ByteOrder { LittleEndian, BigEndian };

/// The number whose bytes lie at `bytes` in the given order; any alignment.
template <typename Number>
Number load(const char* bytes, ByteOrder order) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), bytes, raw.size());
  if ((order == ByteOrder::LittleEndian) != (std::endian::native == std::endian::little))
    std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

/// Writes the number's bytes in the given order from `bytes` on; any alignment.
template <typename Number>
void store(Number number, ByteOrder order, char* bytes) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if ((order == ByteOrder::LittleEndian) != (std::endian::native == std::endian::little))
    std::reverse(raw.begin(), raw.end());
  std::memcpy(bytes, raw.data(), raw.size());
}

/// Appends the number's bytes in the given order.
template <typename Number>
void store(Number number, ByteOrder order, std::string& bytes) {
  std::array<char, sizeof(Number)> raw;
  store(number, order, raw.data());
  bytes.append(raw.data(), raw.size());
}

}  // namespace icome::io
