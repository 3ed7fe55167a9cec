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
/// edits as main's, those that have queued up meanwhile in one go. What the representation throws, such as
/// for want of memory, is told of, and it is opened anew with the next post. Owns replica, representation and
/// thread.
class Follower {
 public:
  /// Starts with an empty world. `name` ("felt world") is what people are told of, and the thread's, of which
  /// debuggers show 15 letters. The queue outlives this.
  Follower(EditedQueue& queue, std::unique_ptr<Representation> representation, std::string name);
  /// Waits for what the representation is making; what is in the queue behind that is left there. The queue
  /// has been closed.
  ~Follower();
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;

  /// The number of the last post that the representation shows, or could not. Any thread.
  std::uint64_t followed() const { return followed_.load(std::memory_order_acquire); }
  /// How often the representation was brought up to date: less often than there were posts, where making took
  /// long. Any thread.
  std::uint64_t rounds() const { return rounds_.load(std::memory_order_relaxed); }

  /// The queue's readers end without taking what is left. Before the queue is closed.
  void give_up() { given_up_.store(true, std::memory_order_relaxed); }

  /// A sentence or two when the representation has fallen behind, or follows again, since the last call.
  /// Main.
  std::optional<std::string> news();

 private:
  /// Why the representation does not follow; empty: it does. Takes no memory, of which there may be none.
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
  // Since the representation was brought up to date.
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
