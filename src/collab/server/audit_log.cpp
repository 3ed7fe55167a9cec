#include "collab/server/audit_log.h"

#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace icome::collab {

AuditLog::AuditLog(std::filesystem::path path) : path_(std::move(path)) { open(); }

void AuditLog::open() { file_.reset(std::fopen(path_.c_str(), "ae")); }

bool AuditLog::is_at_its_place() const {
  struct stat ours = {}, there = {};
  return file_ && ::fstat(::fileno(file_.get()), &ours) == 0 && ::stat(path_.c_str(), &there) == 0 &&
         ours.st_dev == there.st_dev && ours.st_ino == there.st_ino;
}

void AuditLog::write(const AuditRow& row) {
  if (!is_at_its_place()) open();
  if (!file_) return;
  const nlohmann::ordered_json line{{"at", row.at},           {"what", row.what},
                                    {"address", row.address}, {"design", row.design},
                                    {"name", row.name},       {"invitation", row.invitation},
                                    {"author", row.author},   {"detail", row.detail}};
  const std::string text = line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  std::fwrite(text.data(), 1, text.size(), file_.get());
  std::fflush(file_.get());
}

}  // namespace icome::collab
