#include "files/journal.h"

#include "files/journal_replay.h"

namespace icome::files {

base::Result<ReadJournal> read_journal(const std::filesystem::path& path,
                                       const world::GeometryFactory& factory,
                                       const JournalProgress& progress) {
  const auto file = OpenFile::open(path, OpenFile::Use::Read);
  if (!file) return tl::unexpected(file.error());
  auto replayed = replay_journal(*file, factory, progress);
  if (!replayed) return tl::unexpected(replayed.error());
  return ReadJournal{std::move(replayed->world), std::move(replayed->report)};
}

}  // namespace icome::files
