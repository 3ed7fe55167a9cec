#include "collab/storage/store.h"

#include <fmt/format.h>

#include <algorithm>

#include "collab/storage/postgres_op_log.h"
#include "collab/storage/random_bytes.h"
#include "collab/storage/sqlite_op_log.h"

namespace icome::collab {
namespace {

constexpr const char* kTokenKey = "token key";
constexpr const char* kAddress = "address";

/// "postgresql://ann:secret@db:5432/icome?x=y" without what stands before the '@' and behind the '?'.
std::string without_secrets(const std::string& address) {
  const std::size_t begin = address.find("://") + 3;
  const std::size_t end = std::min(address.find('?'), address.size());
  const std::size_t at = address.rfind('@', end);
  const std::size_t from = at == std::string::npos || at < begin ? begin : at + 1;
  return address.substr(0, begin) + address.substr(from, end - from);
}

}  // namespace

bool is_database_address(std::string_view text) {
  return text.starts_with("postgresql://") || text.starts_with("postgres://");
}

base::Result<Store> Store::place(const std::string& text, bool makes) {
  if (is_database_address(text)) return Store(text, without_secrets(text), std::nullopt, makes);
  const auto path = text.empty() ? StoreFolder::default_path() : base::Result<std::filesystem::path>(text);
  if (!path) return tl::unexpected(path.error());
  const auto folder = makes ? StoreFolder::make(*path) : StoreFolder::open(*path);
  if (!folder) return tl::unexpected(folder.error());
  return Store(text, folder->path().string(), *folder, makes);
}

base::Result<Store> Store::open(const std::string& text) { return place(text, false); }

base::Result<Store> Store::make(const std::string& text) { return place(text, true); }

base::Result<void> Store::demand_designs() const {
  if (!folder_) return {};
  const StoreFolder& folder = *folder_;
  std::error_code error;
  const bool is_there = std::filesystem::exists(folder.designs(), error);
  if (is_there && std::filesystem::file_size(folder.designs(), error) > 0) return {};
  const auto served = folder.address();
  if (served && *served)
    return base::fail(
        fmt::format("{}: {}, though this store was served before. Restore a backup (icome store restore), "
                    "or, to begin anew "
                    "without designs, remove {} too.",
                    folder.designs().string(), is_there ? "is empty" : "is not there",
                    (folder.path() / "address").string()));
  if (makes_ || is_there) return {};
  return base::fail(folder.path().string() + ": is no store; there is no designs.sqlite in it.");
}

base::Result<std::unique_ptr<OpLog>> Store::log() const {
  const auto any = [](auto log) -> base::Result<std::unique_ptr<OpLog>> {
    if (!log) return tl::unexpected(log.error());
    return std::make_unique<std::decay_t<decltype(*log)>>(std::move(*log));
  };
  if (!folder_) return any(PostgresOpLog::open(text_));
  if (const auto there = demand_designs(); !there) return tl::unexpected(there.error());
  return any(SqliteOpLog::open(folder_->designs()));
}

base::Result<TokenSigner> Store::signer() const {
  if (folder_) return TokenSigner::open(folder_->token_key());
  const auto fresh = random_bytes(TokenSigner::kKeyBytes);
  if (!fresh) return tl::unexpected(fresh.error());
  auto log = PostgresOpLog::open(text_);
  if (!log) return tl::unexpected(log.error());
  auto key = log->note_once(kTokenKey, *fresh);
  if (!key) return tl::unexpected(key.error());
  if (key->size() == TokenSigner::kKeyBytes) return TokenSigner(std::move(*key));
  return base::fail(shown_ + ": the key of the store is damaged. Restore a backup of the database.");
}

base::Result<void> Store::write_address(const ServedAddress& address) const {
  if (folder_) return folder_->write_address(address);
  const auto note = address_note(address);
  if (!note) return tl::unexpected(note.error());
  auto log = PostgresOpLog::open(text_);
  if (!log) return tl::unexpected(log.error());
  return log->write_note(kAddress, *note);
}

base::Result<std::optional<ServedAddress>> Store::address() const {
  if (folder_) return folder_->address();
  auto log = PostgresOpLog::open(text_);
  if (!log) return tl::unexpected(log.error());
  const auto note = log->note(kAddress);
  if (!note) return tl::unexpected(note.error());
  return *note ? address_in(**note) : std::nullopt;
}

}  // namespace icome::collab
