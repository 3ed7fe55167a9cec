#include "files/journal/journaled_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "files/journal/journal_lost.h"
#include "files/journal/journal_replay.h"
#include "files/journal/journal_writer.h"

namespace icome::files {
namespace {

tl::unexpected<base::Error> in_use(const std::filesystem::path& path) {
  return base::fail(path.string() + ": somebody works with it already: close it there first.");
}

/// Opens and locks the file that the path leads to. In between, its former owner may have put another file
/// in its place.
base::Result<io::OpenFile> open_alone(const std::filesystem::path& path, io::OpenFile::Use use) {
  constexpr int kTries = 10;
  for (int i = 0; i < kTries; ++i) {
    auto file = io::OpenFile::open(path, use);
    if (!file) return file;
    const auto locked = file->lock();
    if (!locked) return tl::unexpected(locked.error());
    if (!*locked) return in_use(path);
    if (file->is_at_its_path()) return file;
  }
  return in_use(path);
}

/// Makes an empty file a journal of an empty world.
base::Result<void> begin_journal(const io::OpenFile& file) {
  std::string bytes = journal_header();
  add_journal_record(JournalKind::SnapshotEnd, 0, {}, bytes);
  if (const auto written = file.write(0, bytes); !written) return written;
  const auto synced = file.sync();
  io::sync_folder_of(file.path());
  return synced;
}

/// Compaction writes a whole file beside the journal, which is left there when the program is killed. The
/// holder of the journal's lock may remove such a file.
void remove_left_behind(const std::filesystem::path& path) {
  const std::string whole = path.filename().string();
  std::error_code error;
  std::vector<std::filesystem::path> left;
  for (std::filesystem::directory_iterator it(path.parent_path(), error), end; !error && it != end;
       it.increment(error)) {
    if (io::is_part_of(it->path().filename().string(), whole)) left.push_back(it->path());
  }
  for (const std::filesystem::path& it : left) std::filesystem::remove(it, error);
}

}  // namespace

base::Result<JournaledWorld> JournaledWorld::open(const std::filesystem::path& path,
                                                  const world::GeometryFactory& factory,
                                                  const JournalOptions& options) {
  // The target of a link, as compacting renames over it; independent of the working folder.
  std::error_code error;
  const std::filesystem::path whole =
      std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
  auto file = open_alone(error ? path : whole,
                         options.create ? io::OpenFile::Use::ChangeOrCreate : io::OpenFile::Use::Change);
  if (!file) return tl::unexpected(file.error());
  const auto size = file->size();
  if (!size) return tl::unexpected(size.error());
  if (*size == 0 && options.create) {
    if (const auto begun = begin_journal(*file); !begun) return tl::unexpected(begun.error());
  }
  JournaledWorld result(std::move(*file), options);
  if (const auto started = result.start(factory); !started) return tl::unexpected(started.error());
  return result;
}

base::Result<void> JournaledWorld::start(const world::GeometryFactory& factory) {
  auto replayed = replay_journal(file_, factory);
  if (!replayed) return tl::unexpected(replayed.error());
  report_ = std::move(replayed->report);
  if (replayed->fault == JournalFault::Unknown) {
    return base::fail(sentence(report_.damage.front(), path().string()) +
                      " Nothing was changed: a newer version or one that knows the shape can open it.");
  }
  world_ = std::move(replayed->world);
  end_ = report_.damaged_from;
  records_ = replayed->records;
  snapshot_ = report_.snapshot_bytes + kJournalHeaderBytes;
  edits_ = report_.edit_bytes;
  remove_left_behind(path());
  if (const auto kept = keep_what_is_lost(file_, report_); !kept) {
    return base::fail(sentence(report_.damage.front(), path().string()) +
                      " Nothing was changed, as what is lost cannot be kept: " + kept.error().message);
  }
  if (replayed->fault == JournalFault::CutOff) {
    if (const auto cut = file_.cut_to(end_); !cut) return cut;
    return file_.sync();
  }
  if (replayed->fault != JournalFault::None) return compact();
  compact_if_due();
  return {};
}

base::Result<world::Edit> JournaledWorld::perform(const world::Edit& edit, const world::Edit& same) {
  if (broken_) return tl::unexpected(*broken_);
  const auto bytes = world::to_bytes(edit);
  if (!bytes) return tl::unexpected(bytes.error());
  auto inverse = world::apply(world_, same);
  if (!inverse) return inverse;
  if (const auto written = append(*bytes); !written) {
    [[maybe_unused]] const auto back = world::apply(world_, *inverse);
    assert(back);
    return tl::unexpected(written.error());
  }
  compact_if_due();
  return inverse;
}

world::EditSink JournaledWorld::sink() {
  return world::EditSink([this](const world::Edit& edit) { return perform(edit); });
}

base::Result<void> JournaledWorld::append(std::string_view content) {
  record_.clear();
  add_journal_record(JournalKind::Edit, records_, content, record_);
  if (const auto written = file_.write(end_, record_); !written) {
    // A part of the record may be written, behind which nothing could be found again.
    if (const auto cut = file_.cut_to(end_); !cut) broken_ = cut.error();
    return base::fail(written.error().message +
                      " The edit was not done: make room, or save the design elsewhere.");
  }
  end_ += record_.size();
  edits_ += record_.size();
  ++records_;
  return {};
}

base::Result<void> JournaledWorld::sync() {
  if (broken_) return tl::unexpected(*broken_);
  const auto synced = file_.sync();
  if (!synced)
    broken_ = base::Error{synced.error().message + " Save the design elsewhere, or compact it to try again."};
  return broken_ ? base::Result<void>(tl::unexpected(*broken_)) : synced;
}

base::Result<void> JournaledWorld::compact() { return write_anew(world_); }

base::Result<void> JournaledWorld::restart(world::World world) {
  auto written = write_anew(world);
  if (written) world_ = std::move(world);
  return written;
}

base::Result<void> JournaledWorld::write_anew(const world::World& world) {
  auto fresh = io::NewFile::create(path());
  if (!fresh) return tl::unexpected(fresh.error());
  auto file = io::OpenFile::copy_of(fresh->descriptor(), path());
  if (!file) return tl::unexpected(file.error());
  // Locked before it gets the journal's name, so that nobody comes between.
  const auto locked = file->lock();
  if (!locked) return tl::unexpected(locked.error());
  const auto snapshot = write_snapshot(world, *fresh);
  if (!snapshot) return tl::unexpected(snapshot.error());
  if (const auto finished = fresh->finish(); !finished) return finished;
  file_ = std::move(*file);
  end_ = snapshot_ = snapshot->bytes;
  records_ = snapshot->records;
  edits_ = retry_ = 0;
  broken_.reset();
  compact_problem_.reset();
  return {};
}

void JournaledWorld::compact_if_due() {
  const double due = std::max(double(options_.compact_from), options_.compact_factor * double(snapshot_));
  if (double(edits_) <= due || edits_ < retry_) return;
  const auto done = compact();
  if (done) return;
  compact_problem_ = done.error();
  retry_ = 2 * edits_;
}

}  // namespace icome::files
