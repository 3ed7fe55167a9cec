#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
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
/// new one begins at its place with the next row.
class AuditLog {
 public:
  explicit AuditLog(std::filesystem::path path);

  bool is_open() const { return file_ != nullptr; }
  void write(const AuditRow& row);

 private:
  struct Close {
    void operator()(std::FILE* it) const { std::fclose(it); }
  };
  void open();
  bool is_at_its_place() const;

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;  // null: it cannot be written
};

}  // namespace icome::collab
