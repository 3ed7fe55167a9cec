#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/result.h"
#include "io/open_file.h"

namespace icome::collab {

/// Where a store is served, or was last.
struct ServedAddress {
  std::string host = {};         // a name or a number; IPv6 without brackets
  std::uint16_t port = 0;        // not 0
  std::string fingerprint = {};  // "sha256:" and 64 hexadecimal digits of the certificate; empty: without TLS

  bool operator==(const ServedAddress&) const = default;
};

/// An address as a few lines of text. Fails for one that nothing could be served at.
base::Result<std::string> address_note(const ServedAddress& address);
/// The address that such lines hold; nothing where they hold none.
std::optional<ServedAddress> address_in(std::string_view note);

/// The folder of a store: its database, what proves who serves it, and the secret that signs invitations. A
/// value that knows the paths; the files in it belong to whom it gives them to.
class StoreFolder {
 public:
  /// $XDG_DATA_HOME/icome/store, or ~/.local/share/icome/store.
  static base::Result<std::filesystem::path> default_path();
  /// A folder that is there.
  static base::Result<StoreFolder> open(const std::filesystem::path& path);
  /// As open(); makes the folder, which only its owner can enter, where there is none.
  static base::Result<StoreFolder> make(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path designs() const { return path_ / "designs.sqlite"; }
  std::filesystem::path certificate() const { return path_ / "certificate.pem"; }
  std::filesystem::path certificate_key() const { return path_ / "key.pem"; }
  std::filesystem::path token_key() const { return path_ / "token.key"; }
  std::filesystem::path audit() const { return path_ / "audit.jsonl"; }

  /// The right to serve from the folder, or to restore what is in it, as long as the file is open. Fails,
  /// saying so, while another process, or another part of this one, has it.
  base::Result<io::OpenFile> lock() const;

  /// Notes where the store is served from now on.
  base::Result<void> write_address(const ServedAddress& address) const;
  /// Nothing where it was never served; fails where the note is none.
  base::Result<std::optional<ServedAddress>> address() const;

 private:
  explicit StoreFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace icome::collab
