#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace icome::collab {

/// Something that somebody did, for the audit log. No tokens.
struct AuditRow {
  std::int64_t at = 0;       // ms since 1970
  std::string what = {};     // "join", "leave", "refused", "edit", "revoked", "open", "close"
  std::string address = {};  // of the client
  std::string design = {};
  std::string name = {};        // of the person
  std::string invitation = {};  // its id
  std::uint32_t author = 0;
  std::string detail = {};
};

/// A file of JSON lines, each written out at once. Where it was moved away, as logrotate does, or removed, a
/// new one begins at its place with the next row. A row that cannot be written leaves nothing of itself, and
/// the next one that can be has a row before it that says how many were lost.
class AuditLog {
 public:
  explicit AuditLog(std::filesystem::path path);
  AuditLog(const AuditLog&) = delete;
  AuditLog& operator=(const AuditLog&) = delete;
  ~AuditLog();

  bool is_open() const { return file_ >= 0; }
  void write(const AuditRow& row);
  /// Rows that were not written since one was.
  std::size_t lost() const { return lost_; }

 private:
  void open();
  void close();
  bool is_at_its_place() const;
  bool append(const AuditRow& row);

  std::filesystem::path path_;
  int file_ = -1;  // descriptor; negative: it cannot be written
  std::size_t lost_ = 0;
};

}  // namespace icome::collab
