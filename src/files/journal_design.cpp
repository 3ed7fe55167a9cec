#include "files/journal_design.h"

#include <fmt/format.h>

#include "files/journal.h"

namespace icome::files {

base::Result<LoadedDesign> read_journal_design(const std::filesystem::path& path,
                                               const DesignReadOptions& options) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > options.size_limit) {
    return base::fail(
        fmt::format("{}: is larger than the limit of {} MB.", path.string(), options.size_limit >> 20U));
  }
  auto journal = read_journal(path, world::GeometryFactory(), options.progress);
  if (!journal) return tl::unexpected(journal.error());
  return LoadedDesign{std::move(journal->world), "ICOME journal", std::move(journal->report.damage)};
}

base::Result<std::vector<Remark>> write_journal_design(const std::filesystem::path& path,
                                                       const world::World& world) {
  if (const auto written = write_journal(path, world); !written) return tl::unexpected(written.error());
  return std::vector<Remark>();
}

}  // namespace icome::files
