#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "collab/content/content_cache.h"
#include "collab/content/outline.h"
#include "collab/protocol/message.h"

namespace icome::collab {

/// Puts outlines together with their contents: from a cache, or piece by piece from the server. What has come
/// of a content stays when a connection is lost. One thread.
class ContentFetcher {
 public:
  /// Null: nothing is kept.
  explicit ContentFetcher(ContentCachePointer cache) : cache_(std::move(cache)) {}

  /// The outline of a snapshot, which is no part of another one. Null: it is fetched from now on.
  ContentPointer outline(const ContentHash& hash, std::uint64_t size);
  /// The whole of an outline's bytes. Nothing: contents are missing, which are fetched from now on; call
  /// again when nothing is_fetching() any more. Fails for what is no outline.
  base::Result<std::optional<std::string>> whole(std::string_view outline);

  bool is_fetching() const { return !missing_.empty(); }
  /// The next questions for the server.
  std::vector<Fetch> questions();
  /// Fails for a content that the server does not have any more, and for one that is not what its name says.
  base::Result<void> take(const Piece& piece);
  /// Ends what is under way; all that has come stays.
  void connection_lost();

  /// Bytes that have come of what is fetched, and all of them.
  std::uint64_t fetched_bytes() const { return fetched_; }
  std::uint64_t bytes_to_fetch() const { return to_fetch_; }

 private:
  void add_missing(const ContentPlace& place, bool is_kept);

  /// A content of which a part has come.
  struct Missing {
    std::uint64_t size = 0;
    std::string bytes = {};
    bool is_kept = true;  // in the cache
  };

  ContentCachePointer cache_;
  std::map<ContentHash, Missing> missing_;          // the first one is asked for
  std::map<ContentHash, std::string> in_part_;      // what had come when a connection was lost
  std::map<ContentHash, ContentPointer> complete_;  // of the outline that is put together
  std::uint64_t asked_ = 0;  // bytes of the first one that were asked for, from its begin
  std::uint64_t fetched_ = 0, to_fetch_ = 0;
};

}  // namespace icome::collab
