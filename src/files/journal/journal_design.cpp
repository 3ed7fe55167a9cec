#include "files/journal/journal_design.h"

#include <fmt/format.h>

#include "drawing/shape/every_kind.h"
#include "files/journal/journal.h"
#include "files/journal/journal_lost.h"
#include "files/journal/journal_replay.h"

namespace icome::files {

base::Result<LoadedDesign> read_journal_design(const std::filesystem::path& path,
                                               const DesignReadOptions& options, io::MemoryBudget& memory) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > options.size_limit) {
    return base::fail(
        fmt::format("{}: is larger than the limit of {} MB.", path.string(), options.size_limit >> 20U));
  }
  const auto file = io::OpenFile::open(path, io::OpenFile::Use::Read);
  if (!file) return tl::unexpected(file.error());
  if (!error) memory.add_file(size);
  auto journal = replay_journal(*file, drawing::every_kind_of_shape(), options.progress, &memory);
  if (!journal) return tl::unexpected(journal.error());
  JournalReport& report = journal->report;
  if (const auto kept = keep_what_is_lost(*file, report); !kept) {
    report.damage.push_back(
        {{}, 0, "What is lost could not be copied to a file beside it: " + kept.error().message});
  }
  return LoadedDesign{std::move(journal->world), "ICOME journal", std::move(report.damage)};
}

base::Result<std::vector<Remark>> write_journal_design(const std::filesystem::path& path,
                                                       const world::World& world) {
  if (const auto written = write_journal(path, world); !written) return tl::unexpected(written.error());
  return std::vector<Remark>();
}

}  // namespace icome::files
