#include "animation/files/project_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "io/file_bytes.h"
#include "io/new_file.h"

namespace icome::animation {
namespace {

constexpr std::size_t kLongestJournal = std::size_t{1} << 30U;  // bytes

std::string header_of(std::string_view saved_text) {
  return fmt::format("# Edits of a cut-out animation since it was saved; from {:016x}\n",
                     hash_of_text(saved_text));
}

/// The system's message about a file.
std::string system_error_of(const std::filesystem::path& path) {
  return fmt::format("{}: {}", path.string(), std::strerror(errno));
}

// What lines begin with that are no edit by themselves.
constexpr std::string_view kPart = "part ", kWhole = "whole ";
/// The line of a program that has taken up parts of a recording whose end is missing.
constexpr std::string_view kTakenUp = "parts taken up";

/// Takes up the lines of a journal.
class Replay {
 public:
  explicit Replay(ProjectRead& read) : read_(read) {}

  /// False where the line cannot be read, or does not fit the project.
  bool take(std::string_view line, const std::string& name) {
    if (line == kTakenUp) {
      take_up_parts();
      return true;
    }
    const bool is_part = line.starts_with(kPart), is_whole = line.starts_with(kWhole);
    line.remove_prefix(is_part ? kPart.size() : is_whole ? kWhole.size() : 0);
    auto edit = read_edit(line, name);
    if (!edit) return false;
    if (is_part) {
      parts_.push_back(std::move(*edit));
      return true;
    }
    if (is_whole) parts_.clear();
    if (edit->empty()) return true;
    if (!apply_edit(read_.project, *edit)) return false;
    ++read_.recovered;
    return true;
  }

  /// Parts count together as one edit, those of cells that were deleted meanwhile do not.
  void take_up_parts() {
    bool fits = false;
    for (const ProjectEdit& part : std::exchange(parts_, {}))
      if (apply_edit(read_.project, part)) fits = true;
    if (fits) ++read_.recovered;
  }

 private:
  ProjectRead& read_;
  std::vector<ProjectEdit> parts_;  // of a recording whose end has not come
};

/// Applies the lines of a journal until one is damaged, as the last one of a program that was killed may be.
void replay(std::string_view lines, const std::string& name, ProjectRead& read) {
  Replay work(read);
  for (std::size_t number = 2; !lines.empty(); ++number) {
    const std::size_t end = lines.find('\n');
    if (end == std::string_view::npos ||
        !work.take(lines.substr(0, end), fmt::format("{}, line {}", name, number))) {
      read.note = fmt::format("{}: line {} is damaged; what comes after it is lost.", name, number);
      break;
    }
    read.journal_length += end + 1;
    lines.remove_prefix(end + 1);
  }
  work.take_up_parts();
}

}  // namespace

struct ProjectJournal::File {
  std::filesystem::path path;
  int descriptor = -1;

  ~File() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

std::uint64_t hash_of_text(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3ULL;
  return hash;
}

std::optional<std::uint64_t> hash_of_file(const std::filesystem::path& path) {
  const auto text = io::read_bytes(path, kLongestProject);
  return text ? std::optional(hash_of_text(*text)) : std::nullopt;
}

std::filesystem::path journal_of(const std::filesystem::path& file) {
  return file.parent_path() / fmt::format(".{}.journal", file.filename().string());
}

base::Result<ProjectRead> read_project_file(const std::filesystem::path& path) {
  const auto text = io::read_bytes(path, kLongestProject);
  if (!text) return tl::unexpected(text.error());
  auto project = read_project(*text, path.string());
  if (!project) return tl::unexpected(project.error());
  ProjectRead read;
  read.project = std::move(*project);
  read.hash = hash_of_text(*text);
  const std::filesystem::path journal = journal_of(path);
  std::error_code ignored;
  if (!std::filesystem::exists(journal, ignored)) return read;
  const auto lines = io::read_bytes(journal, kLongestJournal);
  if (!lines) {
    read.note = lines.error().message;
    return read;
  }
  const std::string header = header_of(*text);
  if (!lines->starts_with(header)) {
    read.note = fmt::format("{}: is a journal of another version of {}, so it is left alone.",
                            journal.string(), path.filename().string());
    return read;
  }
  read.journal_length = header.size();
  Project as_saved = read.project;
  replay(std::string_view(*lines).substr(header.size()), journal.string(), read);
  if (read.recovered > 0) read.as_saved = std::move(as_saved);
  return read;
}

base::Result<void> write_project_file(const Project& project, const std::filesystem::path& path) {
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(project_text(project));
  return file->finish();
}

ProjectJournal::ProjectJournal(std::unique_ptr<File> file) : file_(std::move(file)) {}
ProjectJournal::ProjectJournal(ProjectJournal&&) noexcept = default;
ProjectJournal& ProjectJournal::operator=(ProjectJournal&&) noexcept = default;
ProjectJournal::~ProjectJournal() = default;

base::Result<ProjectJournal> ProjectJournal::open(const std::filesystem::path& file, std::uint64_t length) {
  const auto text = io::read_bytes(file, kLongestProject);
  if (!text) return tl::unexpected(text.error());
  auto opened = std::make_unique<File>();
  opened->path = journal_of(file);
  opened->descriptor = ::open(opened->path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (opened->descriptor < 0) return base::fail(system_error_of(opened->path));
  if (::flock(opened->descriptor, LOCK_EX | LOCK_NB) != 0)
    return base::fail(fmt::format("{}: is open in another window already", file.string()));
  if (length == 0 && ::lseek(opened->descriptor, 0, SEEK_END) > 0) {
    std::error_code failed;
    std::filesystem::copy_file(opened->path, opened->path.string() + ".old",
                               std::filesystem::copy_options::overwrite_existing, failed);
    if (failed) return base::fail(fmt::format("{}: {}", opened->path.string(), failed.message()));
  }
  if (::ftruncate(opened->descriptor, off_t(length)) != 0) return base::fail(system_error_of(opened->path));
  ProjectJournal journal(std::move(opened));
  const std::string begun = length > 0 ? std::string(kTakenUp) + "\n" : header_of(*text);
  if (auto written = journal.write(begun); !written) return tl::unexpected(written.error());
  return journal;
}

bool ProjectJournal::is_open(const std::filesystem::path& file) {
  File journal;
  journal.descriptor = ::open(journal_of(file).c_str(), O_RDONLY | O_CLOEXEC);
  return journal.descriptor >= 0 && ::flock(journal.descriptor, LOCK_SH | LOCK_NB) != 0 &&
         errno == EWOULDBLOCK;
}

base::Result<void> ProjectJournal::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_->descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return base::fail(system_error_of(file_->path));
    bytes.remove_prefix(std::size_t(written));
  }
  return {};
}

base::Result<void> ProjectJournal::add(const ProjectEdit& edit, Line line) {
  const std::string_view begun = line == Line::Part ? kPart : line == Line::Whole ? kWhole : "";
  if (auto written = write(fmt::format("{}{}\n", begun, edit_text(edit))); !written) return written;
  if (::fdatasync(file_->descriptor) != 0 && errno != EINVAL) return base::fail(system_error_of(file_->path));
  return {};
}

void ProjectJournal::remove() {
  std::error_code ignored;
  std::filesystem::remove(file_->path, ignored);
}

}  // namespace icome::animation
