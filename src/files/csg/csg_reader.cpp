#include "files/csg/csg_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <new>
#include <utility>

#include "base/clock.h"
#include "files/csg/csg_builder.h"
#include "files/csg/csg_document.h"
#include "io/byte_watch.h"
#include "io/file_bytes.h"
#include "io/text_scanner.h"

namespace icome::files {
namespace {

// Shares of the whole work that are done at the end of each step.
constexpr double kCsgReadPart = 0.05, kCsgUnpackedPart = 0.2, kCsgParsedPart = 0.5, kCsgGatheredPart = 0.8;

base::Result<LoadedCsg> make_csg(std::string_view text, const std::string& name,
                                 const CsgReadOptions& options, double begin, io::TimeBudget& time_budget) {
  const std::int64_t started = base::steady_nanoseconds();
  time_budget.step(begin, kCsgParsedPart);
  const auto document = CsgDocument::parse(text, name, time_budget);
  if (!document) return tl::unexpected(document.error());
  LoadedCsg loaded;
  time_budget.step(kCsgParsedPart, kCsgGatheredPart);
  const auto parts = gather_parts(*document, options.max_primitives, loaded.notes, time_budget);
  if (!parts) return tl::unexpected(parts.error());
  time_budget.step(kCsgGatheredPart, 1.0);
  loaded.tree = assemble(*document, *parts, time_budget);
  if (!time_budget.lasts_now()) return tl::unexpected(io::interruption());
  if (loaded.tree.empty()) {
    return base::fail(fmt::format("{}: holds no solid{}{}", name, loaded.notes.empty() ? "" : ": ",
                                  fmt::join(loaded.notes, "; ")));
  }
  loaded.read_seconds = 1e-9 * static_cast<double>(base::steady_nanoseconds() - started);
  return loaded;
}

}  // namespace

base::Result<LoadedCsg> parse_csg(std::string_view text, const std::string& name,
                                  const CsgReadOptions& options) try {
  io::TimeBudget time_budget(options.progress);
  return make_csg(text, name, options, 0.0, time_budget);
} catch (const std::bad_alloc&) {
  return base::fail(name + ": there is not enough memory to read it");
}

base::Result<LoadedCsg> read_csg(const std::filesystem::path& path, const CsgReadOptions& options) try {
  constexpr io::FileParts kParts = {kCsgReadPart, kCsgUnpackedPart};
  constexpr std::uint64_t kBytesOfPrimitive = 1000;  // with the operation that takes it in
  const std::int64_t started = base::steady_nanoseconds();
  const std::string name = path.string();
  const bool packed = io::same_word(path.extension().string(), ".xz");
  io::TimeBudget time_budget(options.progress);
  io::MemoryBudget own;
  io::MemoryBudget& memory = options.memory ? *options.memory : own;
  const auto bytes = io::read_unpacked(path, options.size_limit, packed, kParts, time_budget, memory);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->empty()) return base::fail(name + ": the file is empty");
  // The budget of a plain file allows more for each byte; a packed one may hold any amount.
  if (constexpr std::uint64_t kBytesForAByte = 10; packed && !memory.take(kBytesForAByte * bytes->size()))
    return base::fail(fmt::format("{}: {}", name, memory.problem().message));
  CsgReadOptions limited = options;
  limited.max_primitives = std::min<std::uint64_t>(options.max_primitives, memory.left() / kBytesOfPrimitive);
  base::Result<LoadedCsg> loaded =
      make_csg(*bytes, name, limited, packed ? kCsgUnpackedPart : kCsgReadPart, time_budget);
  if (loaded) loaded->read_seconds = 1e-9 * static_cast<double>(base::steady_nanoseconds() - started);
  return loaded;
} catch (const std::bad_alloc&) {
  return base::fail(path.string() + ": there is not enough memory to read it");
}

}  // namespace icome::files
