#include "files/csg_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <new>
#include <utility>

#include "base/clock.h"
#include "files/csg_builder.h"
#include "files/csg_document.h"
#include "files/file_bytes.h"
#include "files/text_scanner.h"

namespace icome::files {

base::Result<LoadedCsg> parse_csg(std::string_view text, const std::string& name,
                                  const CsgReadOptions& options) try {
  const std::int64_t started = base::steady_nanoseconds();
  const auto document = CsgDocument::parse(text, name);
  if (!document) return tl::unexpected(document.error());
  LoadedCsg loaded;
  const auto parts = gather_parts(*document, options.max_primitives, loaded.notes);
  if (!parts) return tl::unexpected(parts.error());
  loaded.tree = assemble(*document, *parts);
  if (loaded.tree.empty()) {
    return base::fail(fmt::format("{}: holds no solid{}{}", name, loaded.notes.empty() ? "" : ": ",
                                  fmt::join(loaded.notes, "; ")));
  }
  loaded.read_seconds = 1e-9 * static_cast<double>(base::steady_nanoseconds() - started);
  return loaded;
} catch (const std::bad_alloc&) {
  return base::fail(name + ": there is not enough memory to read it");
}

base::Result<LoadedCsg> read_csg(const std::filesystem::path& path, const CsgReadOptions& options) try {
  const std::int64_t started = base::steady_nanoseconds();
  const std::string name = path.string();
  base::Result<std::string> bytes = read_bytes(path, options.size_limit);
  if (bytes && same_word(path.extension().string(), ".xz"))
    bytes = unpack_xz(*bytes, options.size_limit, name);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->empty()) return base::fail(name + ": the file is empty");
  base::Result<LoadedCsg> loaded = parse_csg(*bytes, name, options);
  if (loaded) loaded->read_seconds = 1e-9 * static_cast<double>(base::steady_nanoseconds() - started);
  return loaded;
} catch (const std::bad_alloc&) {
  return base::fail(path.string() + ": there is not enough memory to read it");
}

}  // namespace icome::files
