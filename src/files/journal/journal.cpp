#include "files/journal/journal.h"

#include "files/journal/journal_reader.h"
#include "files/journal/journal_replay.h"

namespace icome::files {

base::Result<ReadJournal> read_journal(const std::filesystem::path& path,
                                       const world::GeometryFactory& factory,
                                       const JournalProgress& progress) {
  const auto file = io::OpenFile::open(path, io::OpenFile::Use::Read);
  if (!file) return tl::unexpected(file.error());
  auto replayed = replay_journal(*file, factory, progress);
  if (!replayed) return tl::unexpected(replayed.error());
  return ReadJournal{std::move(replayed->world), std::move(replayed->report)};
}

base::Result<bool> is_whole_journal(const std::filesystem::path& path) {
  const auto file = io::OpenFile::open(path, io::OpenFile::Use::Read);
  if (!file) return tl::unexpected(file.error());
  auto reader = JournalReader::create(*file);
  if (!reader || !reader->header_is_good()) return false;
  bool has_snapshot = false;
  while (!reader->at_end()) {
    const auto record = reader->next();
    if (!record) return tl::unexpected(record.error());
    if (!*record) return false;
    has_snapshot = has_snapshot || (*record)->kind == JournalKind::SnapshotEnd;
  }
  return has_snapshot;
}

}  // namespace icome::files
