#pragma once
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "files/journal/file_stamp.h"
#include "files/remark.h"
#include "session/background_task.h"
#include "world/world.h"

namespace icome::session {

/// Writes designs in the background, one after the other; it has to be polled for outcomes. A file that
/// was there stays as it was until the new one is whole. One thread (main) uses it and never waits but in
/// the destructor. Owns the thread that writes.
class DesignSaver {
 public:
  struct Outcome {
    std::filesystem::path design = {};
    std::uint64_t number = 0;  // as given to save()
    /// The losses by the format; or the reason why there is no new file, and what to do.
    base::Result<std::vector<files::Remark>> result = {};
    /// There is no new file, as it would replace one that must not be lost unasked: a person
    /// decides, and may save with `Replace::Anyway`.
    bool asks = false;
  };
  enum class Replace : std::uint8_t {
    Safely,  // not what another program has changed, nor a damaged journal (files::why_not_replace)
    Anyway,
  };
  /// Saves that may wait for their turn; each holds a world, which shares with others what did not change.
  static constexpr std::size_t kMostWaiting = 8;

  DesignSaver();
  /// Writes the saves that are still waiting.
  ~DesignSaver();
  DesignSaver(const DesignSaver&) = delete;
  DesignSaver& operator=(const DesignSaver&) = delete;

  /// Writes the world as it is now, after the saves before it. `number` comes back with the outcome: the
  /// last post of the EditedQueue that is in this world.
  /// Precondition: can_save().
  void save(const std::filesystem::path& design, world::World world, std::uint64_t number = 0,
            Replace replace = Replace::Safely);
  bool can_save() const { return waiting_.size() < kMostWaiting; }
  /// Notes a design's file as it was opened: changes by others from now on are not replaced unasked.
  void has_read(const std::filesystem::path& design, const std::optional<files::FileStamp>& stamp);

  bool busy() const { return writing_ != nullptr || !waiting_.empty(); }
  /// The outcome of the oldest save, once each, in the order of saving. Begins with the next.
  std::optional<Outcome> poll();
  /// Waits until the oldest save has ended, so that poll() tells of it.
  void wait() const;

 private:
  struct Order {
    std::filesystem::path design;
    world::World world;
    std::uint64_t number = 0;
    Replace replace = Replace::Safely;
  };
  struct Writing;

  void begin_next();

  std::unique_ptr<Writing> writing_;  // null: none is under way
  std::deque<Order> waiting_;
  std::map<std::filesystem::path, files::FileStamp> seen_;  // files as they were read or written here last
};

}  // namespace icome::session
