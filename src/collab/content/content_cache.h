#pragma once
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "collab/content/outline.h"

namespace icome::collab {

/// Keeps contents that came from servers, so that each is fetched once.
class ContentCache {
 public:
  virtual ~ContentCache() = default;
  /// Null: it is not here.
  virtual ContentPointer find(const ContentHash& hash) = 0;
  virtual void keep(const ContentHash& hash, const ContentPointer& content) = 0;
};
using ContentCachePointer = std::shared_ptr<ContentCache>;

/// Contents as files of a folder, for its owner only; those that were used last, up to a number of bytes.
/// Several programs may use one folder. A disk that is full or broken only costs what is kept. Writes in a
/// thread of its own.
class FolderContents final : public ContentCache {
 public:
  static constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

  explicit FolderContents(std::filesystem::path folder, std::uint64_t most_bytes = kMostBytes);
  ~FolderContents() override;

  /// That of this program's user: icome/contents in $XDG_CACHE_HOME or ~/.cache. Null where neither is set.
  static ContentCachePointer of_user();

  /// Damaged files count as none, and go.
  ContentPointer find(const ContentHash& hash) override;
  void keep(const ContentHash& hash, const ContentPointer& content) override;

 private:
  using Kept = std::pair<ContentHash, ContentPointer>;
  void run();
  void write(const Kept& kept) const;
  void remove_oldest() const;
  std::filesystem::path path_of(const ContentHash& hash) const;

  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
  std::mutex mutex_;  // of the two below
  std::deque<Kept> to_write_;
  bool stops_ = false;
  std::condition_variable wake_;
  std::thread thread_;
};

}  // namespace icome::collab
