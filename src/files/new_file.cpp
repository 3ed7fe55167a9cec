#include "files/new_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "files/open_file.h"

namespace icome::files {
namespace {

tl::unexpected<base::Error> cannot_write(const std::filesystem::path& path, const char* why) {
  return base::fail(fmt::format("{}: cannot be written ({}).", path.string(), why));
}

}  // namespace

base::Result<NewFile> NewFile::create(const std::filesystem::path& path) {
  // Renaming over a device such as /dev/null would replace it.
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    return cannot_write(path, "not an ordinary file");
  std::filesystem::path beside = path;
  beside += fmt::format(".part-{}", ::getpid());
  std::FILE* file = std::fopen(beside.c_str(), "wbxe");
  if (file == nullptr) return cannot_write(path, std::strerror(errno));
  return NewFile(path, std::move(beside), file);
}

NewFile::NewFile(std::filesystem::path path, std::filesystem::path beside, std::FILE* file)
    : path_(std::move(path)), beside_(std::move(beside)), file_(file) {}

NewFile::~NewFile() {
  if (file_ == nullptr) return;
  std::error_code ignored;  // nothing is left to be told here
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

}  // namespace icome::files
