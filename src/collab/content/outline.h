#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "world/edit/long_parts.h"

namespace icome::collab {

/// A shape's or a picture's bytes, by themselves.
using ContentPointer = std::shared_ptr<const std::string>;
/// SHA-256 of a content: 32 bytes. The same name is the same content, wherever it is used.
using ContentHash = std::string;

inline constexpr std::size_t kContentHashBytes = 32;
ContentHash hash_of_content(std::string_view bytes);

/// The place of a content in the bytes that it belongs to.
struct ContentPlace {
  std::uint64_t offset = 0;  // in the whole
  std::uint64_t size = 0;
  ContentHash hash = {};
};

/// The bytes of edits without their contents, which go by themselves: each is fetched once, whatever uses it.
struct Outline {
  std::vector<ContentPlace> places = {};  // in order, apart from each other
  std::string rest = {};                  // all that is in none of them

  /// Bytes of the whole.
  std::uint64_t whole_size() const;
};

/// Cuts the parts out of the bytes. Precondition: they are in order, within them and apart.
Outline outline_of(std::string_view whole, const std::vector<world::ByteRange>& parts);
/// The whole again; one content for each place, of its size.
std::string whole_of(const Outline& outline, const std::vector<ContentPointer>& contents);

std::string to_bytes(const Outline& outline);
/// Fails for bytes that are no outline, or that of more than a GB. Memory stays in proportion to them.
base::Result<Outline> outline_from_bytes(std::string_view bytes);

}  // namespace icome::collab
