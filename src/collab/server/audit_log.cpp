#include "collab/server/audit_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace icome::collab {
namespace {

std::string line_of(const AuditRow& row) {
  const nlohmann::ordered_json line{{"at", row.at},           {"what", row.what},
                                    {"address", row.address}, {"design", row.design},
                                    {"name", row.name},       {"invitation", row.invitation},
                                    {"author", row.author},   {"detail", row.detail}};
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

AuditLog::AuditLog(std::filesystem::path path) : path_(std::move(path)) { open(); }

AuditLog::~AuditLog() { close(); }

void AuditLog::open() {
  close();
  constexpr mode_t kOwnerOnly = 0600;
  file_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, kOwnerOnly);
}

void AuditLog::close() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
}

bool AuditLog::is_at_its_place() const {
  struct stat ours = {}, there = {};
  return file_ >= 0 && ::fstat(file_, &ours) == 0 && ::stat(path_.c_str(), &there) == 0 &&
         ours.st_dev == there.st_dev && ours.st_ino == there.st_ino;
}

/// All of the row or nothing.
bool AuditLog::append(const AuditRow& row) {
  const std::string line = line_of(row);
  struct stat before = {};
  if (file_ < 0 || ::fstat(file_, &before) != 0) return false;
  const ssize_t written = ::write(file_, line.data(), line.size());
  if (written == ssize_t(line.size())) return true;
  if (written > 0) (void)!::ftruncate(file_, before.st_size);
  return false;
}

void AuditLog::write(const AuditRow& row) {
  if (!is_at_its_place()) open();
  if (lost_ > 0 &&
      append({row.at, "lost", {}, {}, {}, {}, 0, fmt::format("{} rows could not be written", lost_)}))
    lost_ = 0;
  if (lost_ > 0 || !append(row)) ++lost_;
}

}  // namespace icome::collab
