#include "collab/storage/open_op_log.h"

#include "collab/storage/postgres_op_log.h"
#include "collab/storage/sqlite_op_log.h"
#include "collab/storage/store_folder.h"

namespace icome::collab {
namespace {

template <typename Log>
base::Result<std::unique_ptr<OpLog>> any_log(base::Result<Log> log) {
  if (!log) return tl::unexpected(log.error());
  return std::make_unique<Log>(std::move(*log));
}

}  // namespace

bool is_database_address(std::string_view text) {
  return text.starts_with("postgresql://") || text.starts_with("postgres://");
}

base::Result<std::unique_ptr<OpLog>> open_op_log(const std::string& text) {
  if (is_database_address(text)) return any_log(PostgresOpLog::open(text));
  const auto folder = StoreFolder::make(text);
  if (!folder) return tl::unexpected(folder.error());
  return any_log(SqliteOpLog::open(folder->designs()));
}

}  // namespace icome::collab
