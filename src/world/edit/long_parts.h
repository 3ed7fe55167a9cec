#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

namespace icome::world {

/// A part of some bytes.
struct ByteRange {
  std::size_t offset = 0;
  std::size_t size = 0;
  bool operator==(const ByteRange&) const = default;
};

/// The places of the shapes and pictures of at least so many bytes in an edit's bytes, in their order there.
/// Precondition: the bytes are those that to_bytes() gave, or that edit_from_bytes() could read.
std::vector<ByteRange> long_parts(std::string_view edit, std::size_t least_bytes);

}  // namespace icome::world
