#include "session/storage/recovery.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "files/journal/journal_format.h"
#include "files/journal/journal_reader.h"
#include "io/open_file.h"
#include "session/storage/autosave_files.h"

namespace icome::session {
namespace {

namespace fs = std::filesystem;
using io::OpenFile;

/// Size of a journal with an empty world and no edits: its header and the end of its snapshot.
constexpr std::uint64_t kEmptyJournalBytes = files::kJournalHeaderBytes + files::kJournalFrameBytes;

/// The journal, if no program has it.
std::optional<OpenFile> open_if_left(const fs::path& path) {
  auto file = OpenFile::open(path, OpenFile::Use::Read);
  if (!file) return std::nullopt;
  const auto locked = file->lock();
  if (!locked || !*locked || !file->is_at_its_path()) return std::nullopt;
  return std::move(*file);
}

enum class Holds { Work, Nothing, Damage, SomethingElse };

Holds judge(const OpenFile& file) {
  const auto size = file.size();
  if (!size) return Holds::SomethingElse;
  if (*size <= kEmptyJournalBytes) return Holds::Nothing;
  if (files::JournalReader::create(file)) return Holds::Work;
  std::string first(files::kJournalHeaderBytes, '\0');
  if (!file.read(0, first.data(), first.size())) return Holds::SomethingElse;
  // A newer version can read the journals that it wrote.
  const bool newer = files::judge_journal_header(first) == files::JournalHeader::Newer;
  return newer ? Holds::SomethingElse : Holds::Damage;
}

std::chrono::system_clock::time_point last_change(const fs::path& path) {
  std::error_code error;
  const auto time = fs::last_write_time(path, error);
  if (error) return {};
  return std::chrono::time_point_cast<std::chrono::system_clock::duration>(
      std::chrono::file_clock::to_sys(time));
}

}  // namespace

std::vector<RecoverableWork> find_recoverable_work(const fs::path& folder) {
  std::vector<fs::path> journals;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (is_autosave_journal(it->path())) journals.push_back(it->path());

  std::vector<RecoverableWork> found;
  for (const fs::path& path : journals) {
    const auto file = open_if_left(path);
    if (!file) continue;
    switch (judge(*file)) {
      case Holds::Work:
        found.push_back({path, read_design_of(path), last_change(path)});
        break;
      case Holds::Nothing:
        remove_autosave(path);
        break;
      case Holds::Damage:
        set_autosave_aside(path);
        break;
      case Holds::SomethingElse:
        break;
    }
  }
  sweep_autosave_folder(folder);
  std::sort(found.begin(), found.end(), [](const RecoverableWork& a, const RecoverableWork& b) {
    return a.changed != b.changed ? a.changed > b.changed : a.journal > b.journal;
  });
  return found;
}

}  // namespace icome::session
