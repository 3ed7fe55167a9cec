#include "session/storage/autosave_files.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string_view>
#include <vector>

#include "io/file_bytes.h"
#include "io/new_file.h"

namespace icome::session {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "autosave-";
constexpr std::string_view kJournalEnding = ".icome";
constexpr std::string_view kNoteEnding = ".of";
constexpr std::string_view kDamagedEnding = ".damaged";
constexpr std::string_view kHalfDone = ".part-";
// The design's path follows as it is, to the end: file names may hold anything else.
constexpr std::string_view kNoteHead = "ICOME autosave, work on:\n";

fs::path with_ending(fs::path journal, std::string_view ending) { return journal.replace_extension(ending); }

/// The journal that a file beside it belongs to; empty for all other files.
fs::path journal_of(const fs::path& path) {
  std::string name = path.filename().string();
  if (!name.starts_with(kPrefix)) return {};
  bool belongs = false;
  const std::size_t half = name.rfind(kHalfDone);
  if (half != name.npos && io::is_part_of(name, std::string_view(name).substr(0, half))) {
    name.resize(half);
    belongs = name.ends_with(kJournalEnding);
  }
  if (name.ends_with(kNoteEnding)) {
    name.resize(name.size() - kNoteEnding.size());
    name += kJournalEnding;
    belongs = true;
  }
  return belongs ? path.parent_path() / name : fs::path();
}

template <typename Wanted>
void remove_files(const fs::path& folder, const Wanted& wanted) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const fs::path journal = journal_of(it->path());
    if (!journal.empty() && wanted(journal)) found.push_back(it->path());
  }
  for (const fs::path& it : found) fs::remove(it, error);
}

}  // namespace

fs::path default_autosave_folder() {
  const fs::path within = fs::path("icome") / "autosave";
  const char* const state = std::getenv("XDG_STATE_HOME");
  // The specification has relative ones ignored.
  if (state != nullptr && fs::path(state).is_absolute()) return state / within;
  const char* const home = std::getenv("HOME");
  if (home == nullptr || !fs::path(home).is_absolute()) return {};
  return home / fs::path(".local") / "state" / within;
}

base::Result<void> make_autosave_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return {};
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path(), error);
  constexpr mode_t kOnlyMine = 0700;
  if (::mkdir(folder.c_str(), kOnlyMine) == 0) return {};
  return base::fail(
      fmt::format("{}: this folder cannot be made ({}).", folder.string(), std::strerror(errno)));
}

fs::path new_autosave_journal(const fs::path& folder) {
  static std::atomic<unsigned> given = 0;
  while (true) {
    fs::path path =
        folder / fmt::format("{}{:%Y%m%d-%H%M%S}-{}-{}{}", kPrefix, fmt::gmtime(std::time(nullptr)),
                             ::getpid(), ++given, kJournalEnding);
    std::error_code error;
    if (!fs::exists(path, error)) return path;
  }
}

bool is_autosave_journal(const fs::path& path) {
  return path.filename().string().starts_with(kPrefix) && path.extension() == kJournalEnding;
}

base::Result<void> write_design_of(const fs::path& journal, const fs::path& design) {
  auto file = io::NewFile::create(with_ending(journal, kNoteEnding));
  if (!file) return tl::unexpected(file.error());
  file->write(kNoteHead);
  std::error_code error;
  const fs::path whole = design.empty() ? design : fs::absolute(design, error);
  file->write(error ? design.native() : whole.native());
  return file->finish();
}

fs::path read_design_of(const fs::path& journal) {
  constexpr std::uint64_t kLongest = 1U << 16U;  // bytes; no system has longer paths
  const auto bytes = io::read_bytes(with_ending(journal, kNoteEnding), kLongest);
  if (!bytes || !bytes->starts_with(kNoteHead)) return {};
  const std::string path = bytes->substr(kNoteHead.size());
  return path.find('\0') == path.npos ? fs::path(path) : fs::path();
}

void remove_autosave(const fs::path& journal) {
  std::error_code error;
  fs::remove(journal, error);
  remove_files(journal.parent_path(), [&](const fs::path& owner) { return owner == journal; });
}

fs::path damaged_name(const fs::path& journal) { return with_ending(journal, kDamagedEnding); }

void set_autosave_aside(const fs::path& journal) {
  std::error_code error;
  fs::rename(journal, damaged_name(journal), error);
  if (!error) remove_files(journal.parent_path(), [&](const fs::path& owner) { return owner == journal; });
}

void sweep_autosave_folder(const fs::path& folder) {
  remove_files(folder, [](const fs::path& owner) {
    std::error_code error;
    return !fs::exists(owner, error) && !error;
  });
}

}  // namespace icome::session
