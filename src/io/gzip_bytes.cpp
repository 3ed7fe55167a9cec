#include "io/gzip_bytes.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>

namespace icome::io {
namespace {

constexpr std::size_t kFirstUnpacked = 1U << 20U;
constexpr int kGzipWindow = 15 + 16;  // the largest window; gzip's head and checksum

/// A decoder that is freed on destruction.
struct Inflater {
  z_stream stream{};
  bool ready = inflateInit2(&stream, kGzipWindow) == Z_OK;
  Inflater() = default;
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() {
    if (ready) inflateEnd(&stream);
  }
};

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

base::Result<std::string> unpack_gzip(std::string_view packed, std::uint64_t limit, const std::string& name,
                                      MemoryBudget* memory) {
  Inflater inflater;
  if (!inflater.ready) return base::fail(name + ": there is not enough memory to unpack it");
  z_stream& stream = inflater.stream;
  std::string bytes;
  std::size_t filled = 0;
  while (true) {
    const std::size_t part = std::min<std::size_t>(packed.size(), std::numeric_limits<uInt>::max());
    if (filled == bytes.size()) {
      const std::size_t more = std::max(kFirstUnpacked, filled / 2);
      if (memory && !memory->has_room(filled + more))
        return base::fail(fmt::format("{}: {}", name, memory->problem().message));
      bytes.resize(filled + more);
    }
    const std::size_t room = std::min<std::size_t>(bytes.size() - filled, std::numeric_limits<uInt>::max());
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(part);
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + filled);
    stream.avail_out = static_cast<uInt>(room);
    const int code = inflate(&stream, Z_NO_FLUSH);
    packed.remove_prefix(part - stream.avail_in);
    filled += room - stream.avail_out;
    if (filled > limit)
      return base::fail(fmt::format("{}: unpacks to more than the limit of {:.6g} MiB", name,
                                    static_cast<double>(limit) / (1024.0 * 1024.0)));
    if (code == Z_STREAM_END) {
      // Another member may follow; what else follows is padding, which gzip itself passes over.
      if (!is_gzip(packed)) break;
      inflateReset(&stream);
    } else if (code == Z_BUF_ERROR || (code == Z_OK && packed.empty() && stream.avail_out > 0)) {
      return base::fail(name + ": the gzip data is cut short");
    } else if (code != Z_OK) {
      return base::fail(name + ": the gzip data is damaged");
    }
  }
  bytes.resize(filled);
  if (memory) memory->take(filled);
  return bytes;
}

}  // namespace icome::io
