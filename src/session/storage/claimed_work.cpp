#include "session/storage/claimed_work.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "drawing/shape/every_kind.h"
#include "files/journal/journal.h"
#include "session/storage/autosave_files.h"

namespace icome::session {
namespace {

/// Locks the file, in several tries: a search through the folder has a lock for a moment, too.
base::Result<bool> lock_soon(const io::OpenFile& file) {
  constexpr int kTries = 5;
  constexpr auto kMoment = std::chrono::milliseconds(10);
  auto locked = file.lock();
  for (int i = 1; i < kTries && locked && !*locked; ++i) {
    std::this_thread::sleep_for(kMoment);
    locked = file.lock();
  }
  return locked;
}

}  // namespace

base::Result<std::shared_ptr<ClaimedWork>> ClaimedWork::claim(const RecoverableWork& work) {
  std::error_code error;
  auto file = io::OpenFile::open(work.journal, io::OpenFile::Use::Read);
  if (!file && !std::filesystem::exists(work.journal, error))
    return base::fail(work.journal.string() +
                      ": this work is gone: it was recovered or discarded elsewhere.");
  if (!file) return tl::unexpected(file.error());
  const auto locked = lock_soon(*file);
  if (!locked) return tl::unexpected(locked.error());
  if (!*locked || !file->is_at_its_path())
    return base::fail(work.journal.string() + ": another ICOME is recovering this work.");
  return std::shared_ptr<ClaimedWork>(new ClaimedWork(work, std::move(*file)));
}

base::Result<files::LoadedDesign> ClaimedWork::read(const files::DesignReadOptions& options) {
  auto journal = files::read_journal(work_.journal, drawing::every_kind_of_shape(), options.progress);
  if (!journal) return tl::unexpected(journal.error());
  files::LoadedDesign design{std::move(journal->world), "recovered work", std::move(journal->report.damage)};
  has_more_ = journal->report.lost_bytes > 0 && !journal->report.is_torn;
  if (has_more_) {
    design.remarks.push_back(
        {{}, 0, fmt::format("The damaged file will be kept as {}.", damaged_name(work_.journal).string())});
  }
  return design;
}

void ClaimedWork::discard() {
  has_more_ ? set_autosave_aside(work_.journal) : remove_autosave(work_.journal);
}

}  // namespace icome::session
