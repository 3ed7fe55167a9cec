#include "files/journal/journal_writer.h"

#include <algorithm>

#include "files/journal/journal.h"
#include "io/open_file.h"
#include "world/edit/edits_of.h"

namespace icome::files {
namespace {

JournalNames names_of(const world::World& world) {
  // A record is shorter than 4 GB, and this one only serves to name losses.
  constexpr std::size_t kMostRecordBytes = 64U << 20U;
  JournalNames names;
  std::size_t bytes = 0;
  for (const auto& [id, object] : world.objects()) {
    names.emplace_back(id, object.name);
    bytes += object.name.size();
  }
  std::sort(names.begin(), names.end());
  return bytes > kMostRecordBytes ? JournalNames{} : names;
}

}  // namespace

base::Result<JournalSnapshot> write_snapshot(const world::World& world, io::NewFile& file) {
  JournalSnapshot snapshot;
  std::string bytes = journal_header();
  const auto write = [&] {
    file.write(bytes);
    snapshot.bytes += bytes.size();
    bytes.clear();
  };
  if (const JournalNames names = names_of(world); !names.empty()) {
    add_journal_record(JournalKind::Contents, snapshot.records++, journal_names_to_bytes(names), bytes);
    write();
  }
  for (const world::Edit& edit : world::edits_of(world)) {
    const auto written = world::to_bytes(edit);
    if (!written) return base::fail(file.path().string() + ": " + written.error().message);
    add_journal_record(JournalKind::Snapshot, snapshot.records++, *written, bytes);
    write();
  }
  add_journal_record(JournalKind::SnapshotEnd, snapshot.records++, {}, bytes);
  write();
  return snapshot;
}

base::Result<void> write_journal(const std::filesystem::path& path, const world::World& world) {
  const auto old = io::OpenFile::open(path, io::OpenFile::Use::Read);
  const auto free = old ? old->lock() : base::Result<bool>(true);
  if (!free) return tl::unexpected(free.error());
  if (!*free) return base::fail(path.string() + ": somebody works with it: close it there first.");
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  if (const auto written = write_snapshot(world, *file); !written) return tl::unexpected(written.error());
  return file->finish();
}

}  // namespace icome::files
