#include "animation/files/project_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

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

/// Applies the lines of a journal until one is damaged, as the last one of a program that was killed may be.
void replay(std::string_view lines, const std::string& name, ProjectRead& read) {
  std::size_t number = 1;
  while (!lines.empty()) {
    ++number;
    const std::size_t end = lines.find('\n');
    const bool is_whole = end != std::string_view::npos;
    const auto edit = read_edit(lines.substr(0, end), fmt::format("{}, line {}", name, number));
    const auto done = edit && is_whole ? apply_edit(read.project, *edit) : base::Result<ProjectEdit>();
    if (!edit || !is_whole || !done) {
      read.note = fmt::format("{}: line {} is damaged; what comes after it is lost.", name, number);
      return;
    }
    ++read.recovered;
    read.journal_length += end + 1;
    lines.remove_prefix(end + 1);
  }
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
  if (length > 0) return journal;
  if (auto written = journal.write(header_of(*text)); !written) return tl::unexpected(written.error());
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

base::Result<void> ProjectJournal::add(const ProjectEdit& edit) {
  if (auto written = write(edit_text(edit) + "\n"); !written) return written;
  if (::fdatasync(file_->descriptor) != 0 && errno != EINVAL) return base::fail(system_error_of(file_->path));
  return {};
}

void ProjectJournal::remove() {
  std::error_code ignored;
  std::filesystem::remove(file_->path, ignored);
}

}  // namespace icome::animation
