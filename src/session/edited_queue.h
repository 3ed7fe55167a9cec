#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <semaphore>
#include <vector>

#include "realtime/message_pipe.h"
#include "world/edit/edit.h"

namespace icome::session {

class ClaimedWork;

/// The part of a session's work that is in a file of the person's own; the rest is kept against crashes.
struct SavedWork {
  std::filesystem::path design = {};  // the file; empty: there is none yet
  std::uint64_t number = 0;           // posts up to this one are in it; a `whole` of the same post, too
  bool in_part = false;               // the format cannot hold all: the work counts as unsaved
  bool by_server = false;             // a server keeps this world, whatever is done to it: no journal does
  /// Not null: the `whole` of the same post is in no file but this work, recovered from a session that
  /// crashed, which goes when it is kept anew.
  std::shared_ptr<ClaimedWork> recovered = nullptr;
};

/// One thing that happened to a session's world.
struct Edited {
  std::uint64_t number = 0;                             // of the post, from 1
  std::shared_ptr<const world::World> whole = nullptr;  // not null: the world is another one from now on
  std::shared_ptr<const world::Edit> edit = nullptr;    // not null: the world has been through this
  /// Not null where `edit` is not null, often the same: the edit that makes a replica of the world equal
  /// again. It holds the shapes that main has made in performing `edit`, so that they are not made once more.
  std::shared_ptr<const world::Edit> for_replicas = nullptr;
  std::optional<world::SceneId> shown = {};  // another scene (none: the whole world) is looked at and touched
  /// The start or the end of playing the objects' motions.
  struct Play {
    std::optional<double> since = {};  // s, of session_seconds; none: all is at rest from now on
  };
  std::optional<Play> play = {};
  std::shared_ptr<const SavedWork> saved = nullptr;  // not null: the design was saved, opened or recovered
  std::uint64_t bytes =
      0;  // of memory that its edits may take, as world::memory_of counts; the queue counts them
};

/// The EditedQueue of thesis 5.6.1: edits are queued once, and each representation of the world (for hand,
/// eye, disk, colleagues) takes what it needs, on a thread of its own and in its own time. One thread (main)
/// posts and never waits, however far behind a reader is; posts that do not fit into a reader's pipe are kept
/// for it. has_room() is to be asked before editing, which bounds the kept posts. Owns the readers.
class EditedQueue {
 public:
  /// One representation's end of the queue; one thread uses it.
  class Reader {
   public:
    /// Waits until there is something to take; false when the queue has been closed and all is taken.
    bool wait();
    /// Waits for so long at most; then true, though there may be nothing to take.
    bool wait_for(std::chrono::nanoseconds longest);
    /// Takes the next post; nothing when all are taken. Never waits.
    std::optional<Edited> take();

   private:
    friend class EditedQueue;
    static constexpr std::size_t kRoom = 1024;

    void hand_on();
    bool look();

    realtime::MessagePipe<Edited> pipe_{kRoom};
    std::counting_semaphore<> news_{0};
    std::atomic<bool> closed_ = false;
    std::atomic<std::uint64_t> taken_bytes_ = 0;  // of edits, since the first
    std::deque<Edited>
        kept_;  // did not fit; the posting thread's until the queue is closed, then the reader's
    std::optional<Edited> next_;  // the reader's
  };

  /// Memory that a reader which is behind may keep from being freed; one post more may come on top.
  static constexpr std::uint64_t kMostBytes = 1ULL << 30U;
  explicit EditedQueue(std::uint64_t most_bytes = kMostBytes) : most_bytes_(most_bytes) {}

  /// Adds the reader of one more representation. Before the first post; lives as long as the queue.
  Reader& add_reader();

  /// Is no reader so far behind that editing on would take too much memory?
  bool has_room() const;

  /// Queues it for all readers and gives it its number.
  std::uint64_t post(Edited edited);
  /// Hands on posts that did not fit before. The posting thread calls it now and then.
  void pump();
  /// Lets readers take what is left and then tells them that there will be no more.
  void close();
  /// The number of the last post; 0 before it.
  std::uint64_t posted() const { return posted_; }

 private:
  std::vector<std::unique_ptr<Reader>> readers_;
  std::uint64_t most_bytes_;
  std::uint64_t posted_ = 0;
  std::uint64_t posted_bytes_ = 0;
  bool closed_ = false;
};

}  // namespace icome::session
