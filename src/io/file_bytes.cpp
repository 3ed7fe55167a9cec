#include "io/file_bytes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <lzma.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "io/byte_watch.h"

namespace icome::io {
namespace {

/// The largest table that xz's own presets need to unpack is 65 MiB.
constexpr std::uint64_t kUnpackMemoryLimit = 256ULL << 20U;
constexpr std::size_t kPiece = 1U << 20U;  // bytes read or unpacked between two checks whether to go on

/// An open file descriptor, closed on destruction.
class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& path)
      : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

tl::unexpected<base::Error> fail_with_errno(const std::filesystem::path& path) {
  return base::fail(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
}

std::string limit_text(std::uint64_t limit) {
  return fmt::format("{:.6g} MiB", static_cast<double>(limit) / (1024.0 * 1024.0));
}

/// A decoder that is freed on destruction.
struct Decoder {
  lzma_stream stream = LZMA_STREAM_INIT;
  Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() { lzma_end(&stream); }
};

std::string unpack_error(lzma_ret code) {
  switch (code) {
    case LZMA_FORMAT_ERROR:
      return "is not xz data";
    case LZMA_BUF_ERROR:
      return "the xz data is cut short";
    case LZMA_DATA_ERROR:
      return "the xz data is damaged";
    case LZMA_MEM_ERROR:
    case LZMA_MEMLIMIT_ERROR:
      return "unpacking takes too much memory";
    default:
      return "the xz data uses an option that is not supported";
  }
}

}  // namespace

base::Result<std::string> read_bytes(const std::filesystem::path& path, std::uint64_t limit,
                                     TimeBudget* time_budget) {
  const Descriptor file(path);
  if (file.number() < 0) return fail_with_errno(path);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return fail_with_errno(path);
  if (S_ISDIR(status.st_mode)) return base::fail(path.string() + ": is a folder, not a file");
  if (!S_ISREG(status.st_mode)) return base::fail(path.string() + ": is not a regular file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > limit)
    return base::fail(fmt::format("{}: is larger than the limit of {}", path.string(), limit_text(limit)));
  std::string bytes;
  bytes.reserve(size);
  std::size_t filled = 0;
  while (filled < size) {
    if (time_budget && !time_budget->lasts(double(filled) / double(size)))
      return tl::unexpected(interruption());
    bytes.resize(std::min<std::uint64_t>(size, filled + kPiece));
    const ssize_t count = ::read(file.number(), bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return fail_with_errno(path);
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  bytes.resize(filled);
  return bytes;
}

base::Result<std::string> unpack_xz(std::string_view packed, std::uint64_t limit, const std::string& name,
                                    TimeBudget* time_budget, MemoryBudget* memory) {
  Decoder decoder;
  lzma_ret code = lzma_stream_decoder(&decoder.stream, kUnpackMemoryLimit, LZMA_CONCATENATED);
  decoder.stream.next_in = reinterpret_cast<const std::uint8_t*>(packed.data());
  decoder.stream.avail_in = packed.size();
  std::string bytes;
  while (code == LZMA_OK) {
    const std::size_t filled = bytes.size();
    if (filled > limit)
      return base::fail(fmt::format("{}: unpacks to more than the limit of {}", name, limit_text(limit)));
    if (memory && !memory->has_room(filled + kPiece))
      return base::fail(fmt::format("{}: {}", name, memory->problem().message));
    if (time_budget && !time_budget->lasts(double(decoder.stream.total_in) / double(packed.size())))
      return tl::unexpected(interruption());
    bytes.resize(filled + kPiece);  // its capacity grows by factors
    decoder.stream.next_out = reinterpret_cast<std::uint8_t*>(bytes.data() + filled);
    decoder.stream.avail_out = bytes.size() - filled;
    while (code == LZMA_OK && decoder.stream.avail_out > 0) code = lzma_code(&decoder.stream, LZMA_FINISH);
    bytes.resize(bytes.size() - decoder.stream.avail_out);
  }
  if (code != LZMA_STREAM_END) return base::fail(name + ": " + unpack_error(code));
  if (bytes.size() > limit)
    return base::fail(fmt::format("{}: unpacks to more than the limit of {}", name, limit_text(limit)));
  if (memory) memory->take(bytes.size());
  return bytes;
}

base::Result<std::string> read_unpacked(const std::filesystem::path& path, std::uint64_t limit, bool packed,
                                        const FileParts& parts, TimeBudget& time_budget,
                                        MemoryBudget& memory) {
  time_budget.step(0.0, parts.read);
  auto bytes = read_bytes(path, limit, &time_budget);
  if (bytes && !memory.add_file(bytes->size()))
    return base::fail(fmt::format("{}: {}", path.string(), memory.problem().message));
  if (!bytes || !packed) return bytes;
  time_budget.step(parts.read, parts.unpacked);
  return unpack_xz(*bytes, limit, path.string(), &time_budget, &memory);
}

}  // namespace icome::io
