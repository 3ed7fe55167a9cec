#include "io/new_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "base/parse_number.h"
#include "io/open_file.h"

namespace icome::io {
namespace {

constexpr std::string_view kPart = ".part-";
constexpr std::string_view kPartDigits = "0123456789";

tl::unexpected<base::Error> cannot_write(const std::filesystem::path& path, const char* why) {
  return base::fail(fmt::format("{}: cannot be written ({}).", path.string(), why));
}

/// Opens a new file beside the path; null, with errno, on failure. A name may be taken by another thread,
/// or by a file that a killed program left.
std::FILE* open_beside(const std::filesystem::path& path, std::filesystem::path& beside) {
  constexpr int kMostTries = 100;
  for (int i = 0;; ++i) {
    beside = path;
    beside += fmt::format("{}{}", kPart, ::getpid());
    if (i > 0) beside += fmt::format("-{}", i);
    std::FILE* const file = std::fopen(beside.c_str(), "wbxe");
    if (file != nullptr || errno != EEXIST || i == kMostTries) return file;
  }
}

/// Is there no process of the number with which the text begins?
bool is_gone(std::string_view text) {
  const auto process = base::number_at_front<pid_t>(text);
  if (!process.good() || process.value <= 0) return true;
  return ::kill(process.value, 0) != 0 && errno == ESRCH;
}

/// Removes files that ended processes left beside the path.
void remove_parts_of_the_gone(const std::filesystem::path& path) {
  const std::string whole = path.filename().string();
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::vector<std::filesystem::path> left;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (is_part_of(name, whole) && is_gone(std::string_view(name).substr(whole.size() + kPart.size())))
      left.push_back(it->path());
  }
  for (const std::filesystem::path& it : left) std::filesystem::remove(it, error);
}

}  // namespace

bool is_part_of(std::string_view name, std::string_view whole) {
  if (!name.starts_with(whole)) return false;
  name.remove_prefix(whole.size());
  if (!name.starts_with(kPart)) return false;
  name.remove_prefix(kPart.size());
  const std::size_t process = std::min(name.find_first_not_of(kPartDigits), name.size());
  const std::string_view which = name.substr(process);
  return process > 0 && (which.empty() || (which.size() > 1 && which.front() == '-' &&
                                           which.find_first_not_of(kPartDigits, 1) == which.npos));
}

base::Result<NewFile> NewFile::create(const std::filesystem::path& path) {
  // Renaming over a device such as /dev/null would replace it, and likewise a link.
  std::error_code error;
  const bool there = std::filesystem::exists(path, error);
  if (there && !std::filesystem::is_regular_file(path, error))
    return cannot_write(path, "not an ordinary file");
  std::filesystem::path real = there ? std::filesystem::canonical(path, error) : path;
  if (error) return cannot_write(path, error.message().c_str());
  remove_parts_of_the_gone(real);
  std::filesystem::path beside;
  std::FILE* const file = open_beside(real, beside);
  if (file == nullptr) return cannot_write(path, std::strerror(errno));
  // The new file keeps the permissions of the old one.
  struct stat before = {};
  if (there && ::stat(real.c_str(), &before) == 0) {
    [[maybe_unused]] const int ignored = ::fchmod(::fileno(file), before.st_mode & 07777U);
  }
  return NewFile(std::move(real), std::move(beside), file);
}

NewFile::NewFile(std::filesystem::path path, std::filesystem::path beside, std::FILE* file)
    : path_(std::move(path)), beside_(std::move(beside)), file_(file) {}

NewFile::~NewFile() {
  if (file_ == nullptr) return;
  std::error_code ignored;  // a failure cannot be reported here
  std::filesystem::remove(beside_, ignored);
}

void NewFile::write(std::string_view bytes) {
  if (write_error_ == 0 && std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
    write_error_ = errno;
}

int NewFile::descriptor() const { return ::fileno(file_.get()); }

base::Result<void> NewFile::finish() {
  if (write_error_ == 0 && (std::fflush(file_.get()) != 0 || ::fsync(::fileno(file_.get())) != 0))
    write_error_ = errno;
  if (write_error_ != 0) return cannot_write(path_, std::strerror(write_error_));
  std::error_code error;
  std::filesystem::rename(beside_, path_, error);
  if (error) return cannot_write(path_, error.message().c_str());
  sync_folder_of(path_);
  file_.reset();
  return {};
}

}  // namespace icome::io
