#include "apps/touch/trace_file.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace icome::apps {
namespace {

constexpr std::size_t kBufferBytes = 1 << 18;
constexpr const char* kHeader =
    "t,tip_x,tip_y,tip_z,scp_x,scp_y,scp_z,force_x,force_y,force_z,touching,object,tick_us\n";
constexpr double kNanosecondsPerMicrosecond = 1e3;  // divided by, so that 1234 ns print as 1.234

}  // namespace

base::Result<TraceFile> TraceFile::create(const std::filesystem::path& path) {
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  return TraceFile(std::move(*file));
}

TraceFile::TraceFile(io::NewFile file) : file_(std::move(file)), buffer_(kHeader) {
  buffer_.reserve(kBufferBytes + 1024);
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
  file_.write(buffer_);
  buffer_.clear();
}

base::Result<void> TraceFile::finish() {
  flush();
  return file_.finish();
}

}  // namespace icome::apps
