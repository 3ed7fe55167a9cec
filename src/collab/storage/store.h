#pragma once
#include <memory>
#include <optional>
#include <string>

#include "collab/server/token.h"
#include "collab/storage/op_log.h"
#include "collab/storage/store_folder.h"

namespace icome::collab {

/// A place where designs are kept, as `--store` names it: a folder of this machine, which one server serves
/// at a time, or a PostgreSQL database, which servers on many machines do. A value that knows the place.
class Store {
 public:
  /// A store that is there. An empty text is the usual folder, StoreFolder::default_path().
  static base::Result<Store> open(const std::string& text);
  /// As open(); makes the folder where there is none. The tables of a database are made by log().
  static base::Result<Store> make(const std::string& text);

  bool is_database() const { return !folder_; }
  /// The place for people; of a database without user and password.
  const std::string& shown() const { return shown_; }
  /// Null for a database.
  const StoreFolder* folder() const { return folder_ ? &*folder_ : nullptr; }

  /// Fails where the designs should be there and are not, so that nobody takes a store that lost them for a
  /// new one, or another folder for a store.
  base::Result<void> demand_designs() const;
  /// Fails as demand_designs() does, too.
  base::Result<std::unique_ptr<OpLog>> log() const;
  /// Signs invitations, with the same secret for all servers of the store, which is made where there is none.
  base::Result<TokenSigner> signer() const;
  /// Notes where the store is served from now on; of several servers, the last one counts.
  base::Result<void> write_address(const ServedAddress& address) const;
  /// Nothing where it was never served.
  base::Result<std::optional<ServedAddress>> address() const;

 private:
  Store(std::string text, std::string shown, std::optional<StoreFolder> folder, bool makes)
      : text_(std::move(text)), shown_(std::move(shown)), folder_(std::move(folder)), makes_(makes) {}
  static base::Result<Store> place(const std::string& text, bool makes);
  std::string text_;
  std::string shown_;
  std::optional<StoreFolder> folder_;
  bool makes_;
};

/// Is the text after --store the address of a database, "postgresql://..." or "postgres://...", and not a
/// folder?
bool is_database_address(std::string_view text);

}  // namespace icome::collab
