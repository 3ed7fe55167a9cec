#pragma once
#include <gtest/gtest.h>
#include <lzma.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace icome::files {

/// The bytes as the command xz packs them.
inline std::string packed_xz(std::string_view bytes) {
  std::string result(lzma_stream_buffer_bound(bytes.size()), '\0');
  std::size_t size = 0;
  EXPECT_EQ(lzma_easy_buffer_encode(6, LZMA_CHECK_CRC64, nullptr,
                                    reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
                                    reinterpret_cast<std::uint8_t*>(result.data()), &size, result.size()),
            LZMA_OK);
  result.resize(size);
  return result;
}

}  // namespace icome::files
