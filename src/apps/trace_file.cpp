#include "apps/trace_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iterator>
#include <system_error>
#include <utility>

namespace icome::apps {
namespace {

constexpr std::size_t kBufferBytes = 1 << 18;
constexpr const char* kHeader =
    "t,tip_x,tip_y,tip_z,scp_x,scp_y,scp_z,force_x,force_y,force_z,touching,object,tick_us\n";
constexpr double kNanosecondsPerMicrosecond = 1e3;  // divided by, so that 1234 ns print as 1.234

tl::unexpected<base::Error> cannot_write(const std::filesystem::path& path, int error) {
  return base::fail(
      fmt::format("{}: the trace cannot be written ({}).", path.string(), std::strerror(error)));
}

}  // namespace

base::Result<TraceFile> TraceFile::create(const std::filesystem::path& path) {
  // Renaming over a device such as /dev/null would replace it.
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) {
    return base::fail(fmt::format("{}: the trace cannot be written (not an ordinary file).", path.string()));
  }
  std::filesystem::path beside = path;
  beside += fmt::format(".part-{}", ::getpid());
  std::FILE* file = std::fopen(beside.c_str(), "wbx");
  if (file == nullptr) return cannot_write(path, errno);
  return TraceFile(path, std::move(beside), file);
}

TraceFile::TraceFile(std::filesystem::path path, std::filesystem::path beside, std::FILE* file)
    : path_(std::move(path)), beside_(std::move(beside)), file_(file), buffer_(kHeader) {
  buffer_.reserve(kBufferBytes + 1024);
}

TraceFile::~TraceFile() {
  if (file_ == nullptr) return;
  std::error_code ignored;  // nothing is left to be told here
  std::filesystem::remove(beside_, ignored);
}

void TraceFile::add(const TickRow& row) {
  const base::Vector3& scp = row.touching() ? row.scp : row.tip;
  fmt::format_to(std::back_inserter(buffer_), "{},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.t, row.tip.x(),
                 row.tip.y(), row.tip.z(), scp.x(), scp.y(), scp.z(), row.force.x(), row.force.y(),
                 row.force.z(), row.touching() ? 1 : 0, row.object,
                 static_cast<double>(row.own_ns) / kNanosecondsPerMicrosecond);
  if (buffer_.size() >= kBufferBytes) flush();
}

void TraceFile::flush() {
  if (write_error_ == 0 && std::fwrite(buffer_.data(), 1, buffer_.size(), file_.get()) != buffer_.size()) {
    write_error_ = errno;
  }
  buffer_.clear();
}

base::Result<void> TraceFile::finish() {
  flush();
  if (write_error_ == 0 && (std::fflush(file_.get()) != 0 || ::fsync(::fileno(file_.get())) != 0)) {
    write_error_ = errno;
  }
  if (write_error_ != 0) return cannot_write(path_, write_error_);
  std::error_code error;
  std::filesystem::rename(beside_, path_, error);
  if (error) return cannot_write(path_, error.value());
  file_.reset();
  return {};
}

}  // namespace icome::apps
