#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "realtime/latest_value.h"
#include "session/edited_queue.h"
#include "session/representation.h"

namespace icome::session {

/// Keeps a representation up to date on a thread of its own: a replica of the world goes through the same
/// edits as main's, through those that have queued up meanwhile in one go. Exceptions of the representation,
/// such as for want of memory, are reported, and it is opened anew with the next post. Owns replica,
/// representation and thread.
class Follower {
 public:
  /// Starts with an empty world. `name` ("felt world") is used in what people are told and for the thread, of
  /// which debuggers show 15 letters. The queue outlives this.
  Follower(EditedQueue& queue, std::unique_ptr<Representation> representation, std::string name);
  /// Waits for the representation to end what it is making; later posts are left in the queue.
  /// Precondition: the queue has been closed.
  ~Follower();
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;

  /// The number of the last post that the representation shows, or failed to show. Any thread.
  std::uint64_t followed() const { return followed_.load(std::memory_order_acquire); }
  /// Number of times that the representation was brought up to date: fewer than there were posts, where
  /// making took long. Any thread.
  std::uint64_t rounds() const { return rounds_.load(std::memory_order_relaxed); }

  /// Lets the reader end without taking what is left. To be called before the queue is closed.
  void give_up() { given_up_.store(true, std::memory_order_relaxed); }

  /// A sentence or two when the representation has fallen behind, or follows again, since the last call.
  /// Main.
  std::optional<std::string> news();

 private:
  /// The reason why the representation does not follow; empty: it does. Takes no memory: there may be none.
  using Trouble = std::array<char, 128>;

  void run();
  bool wait();
  void take_all();
  void take(Edited& edited);
  void bring_up_to_date();
  void note(const char* why);

  const std::string name_;
  EditedQueue::Reader& reader_;
  std::unique_ptr<Representation> representation_;
  world::World replica_;
  world::SceneId shown_ = {};
  // Taken since the representation was brought up to date.
  std::shared_ptr<const world::World> whole_;
  std::vector<std::shared_ptr<const world::Edit>> edits_;
  bool other_scene_ = false;
  std::optional<double> played_since_ = {};  // none: motions are not played
  bool other_play_ = false;
  std::uint64_t taken_ = 0;
  bool lost_ = false;      // the replica is not main's world, until there is another
  bool half_way_ = false;  // the representation threw
  bool troubled_ = false;  // as was published last

  realtime::LatestValue<Trouble> trouble_;
  bool troubled_told_ = false;  // main's

  std::atomic<std::uint64_t> followed_ = 0;
  std::atomic<std::uint64_t> rounds_ = 0;
  std::atomic<bool> given_up_ = false;
  std::thread thread_;
};

}  // namespace icome::session
