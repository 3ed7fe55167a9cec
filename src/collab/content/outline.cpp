#include "collab/content/outline.h"

#include <openssl/sha.h>

#include <cassert>

#include "io/byte_order.h"
#include "world/edit/flat_bytes.h"

namespace icome::collab {
namespace {

// As bytes: the number of places (u64), each with offset and size (u64) and hash, then the rest. All numbers
// are little-endian.
constexpr std::size_t kNumberBytes = 8;
constexpr std::size_t kPlaceBytes = 2 * kNumberBytes + kContentHashBytes;

std::uint64_t take_number(std::string_view& bytes) {
  const auto number = io::load<std::uint64_t>(bytes.data(), io::ByteOrder::LittleEndian);
  bytes.remove_prefix(kNumberBytes);
  return number;
}

}  // namespace

ContentHash hash_of_content(std::string_view bytes) {
  static_assert(kContentHashBytes == SHA256_DIGEST_LENGTH);
  ContentHash hash(kContentHashBytes, '\0');
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
         reinterpret_cast<unsigned char*>(hash.data()));
  return hash;
}

std::uint64_t Outline::whole_size() const {
  std::uint64_t size = rest.size();
  for (const ContentPlace& place : places) size += place.size;
  return size;
}

Outline outline_of(std::string_view whole, const std::vector<world::ByteRange>& parts) {
  Outline outline;
  std::size_t end = 0;
  for (const world::ByteRange& part : parts) {
    outline.rest += whole.substr(end, part.offset - end);
    outline.places.push_back({part.offset, part.size, hash_of_content(whole.substr(part.offset, part.size))});
    end = part.offset + part.size;
  }
  outline.rest += whole.substr(end);
  return outline;
}

std::string whole_of(const Outline& outline, const std::vector<ContentPointer>& contents) {
  std::string whole;
  whole.reserve(outline.whole_size());
  std::size_t from = 0;  // in the rest
  for (std::size_t i = 0; i < outline.places.size(); ++i) {
    const ContentPlace& place = outline.places[i];
    assert(contents[i]->size() == place.size);
    const std::size_t between = place.offset - whole.size();
    whole += std::string_view(outline.rest).substr(from, between);
    whole += *contents[i];
    from += between;
  }
  whole += std::string_view(outline.rest).substr(from);
  return whole;
}

std::string to_bytes(const Outline& outline) {
  std::string bytes;
  bytes.reserve(kNumberBytes + outline.places.size() * kPlaceBytes + outline.rest.size());
  io::store<std::uint64_t>(outline.places.size(), io::ByteOrder::LittleEndian, bytes);
  for (const ContentPlace& place : outline.places) {
    io::store<std::uint64_t>(place.offset, io::ByteOrder::LittleEndian, bytes);
    io::store<std::uint64_t>(place.size, io::ByteOrder::LittleEndian, bytes);
    bytes += place.hash;
  }
  return bytes + outline.rest;
}

base::Result<Outline> outline_from_bytes(std::string_view bytes) {
  const auto damaged = [] { return base::fail("The outline of an edit is damaged."); };
  if (bytes.size() < kNumberBytes) return damaged();
  const std::uint64_t count = take_number(bytes);
  if (count > bytes.size() / kPlaceBytes) return damaged();
  Outline outline;
  std::uint64_t cut = 0;  // bytes in the places so far
  for (std::uint64_t i = 0; i < count; ++i) {
    ContentPlace place;
    place.offset = take_number(bytes);
    place.size = take_number(bytes);
    place.hash = bytes.substr(0, kContentHashBytes);
    bytes.remove_prefix(kContentHashBytes);
    const std::uint64_t end =
        outline.places.empty() ? 0 : outline.places.back().offset + outline.places.back().size;
    if (place.offset < end || place.size == 0 || place.size > world::kMostReadBytes - cut) return damaged();
    cut += place.size;
    outline.places.push_back(std::move(place));
  }
  if (bytes.size() > world::kMostReadBytes - cut) return damaged();
  outline.rest = bytes;
  // Between the places there is no more than the rest.
  if (!outline.places.empty() &&
      outline.places.back().offset + outline.places.back().size > outline.whole_size())
    return damaged();
  return outline;
}

}  // namespace icome::collab
