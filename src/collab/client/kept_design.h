#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "base/result.h"
#include "collab/client/conversation.h"
#include "collab/client/kept_copy.h"
#include "collab/protocol/address.h"
#include "io/open_file.h"

namespace icome::collab {

/// A design of a server that is kept on this machine, so that one can work on it without the server: a folder
/// with its copy, for its owner only, which one program uses at a time.
class KeptDesign {
 public:
  /// The folder with all of them: icome/kept in $XDG_DATA_HOME or ~/.local/share.
  static base::Result<std::filesystem::path> usual_folder();

  /// Begins to keep a design, or goes on. Fails where another program has it.
  static base::Result<KeptDesign> make(const std::filesystem::path& folder, const DesignAddress& address);
  /// Nothing: the design is not kept here. An empty optional in it: it is, and another program has it.
  static std::optional<std::optional<KeptDesign>> find(const std::filesystem::path& folder,
                                                       const DesignAddress& address);
  /// The design's own folder, whether it is kept or not: two links to one design have the same.
  static std::filesystem::path place_of(const std::filesystem::path& folder, const DesignAddress& address);
  /// The folders of all that are kept.
  static std::vector<std::filesystem::path> all(const std::filesystem::path& folder);

  /// Nothing: none was written yet.
  base::Result<std::optional<KeptCopy>> read() const;
  /// As read(), while another program may work with it.
  static base::Result<std::optional<KeptCopy>> read(const std::filesystem::path& place);
  /// Replaces the copy, whole or not at all.
  base::Result<void> write(const KeptCopy& copy) const;
  /// Has a conversation go on from the copy, with the copy's key, and keeps what follows from that in its
  /// place, so that no other program goes on from the same copy. Before the first connection.
  base::Result<void> resume(Conversation& talk, const KeptCopy& copy) const;
  /// Leaves the copy beside those that are written from now on, under a name of its own: it is damaged, or of
  /// another history of the design. Where it can be read, what it holds, with what was not sent, becomes a
  /// design file beside it. Gives the path for people: of that file, else of the copy. Fails where it cannot
  /// be put aside.
  base::Result<std::filesystem::path> put_aside() const;
  /// Keeps it no longer, nor what was put aside.
  void remove() const;
  /// As remove(), where nothing was written and nothing put aside.
  void remove_if_empty() const;

 private:
  KeptDesign(std::filesystem::path place, io::OpenFile lock)
      : place_(std::move(place)), lock_(std::move(lock)) {}

  std::filesystem::path place_;
  io::OpenFile lock_;
};

}  // namespace icome::collab
