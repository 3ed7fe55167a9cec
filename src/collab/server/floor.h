#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "collab/order/items.h"

namespace icome::collab {

/// A thing that somebody has for himself or herself alone.
struct Hold {
  Item item;
  std::uint32_t holder = 0;  // an author of the design
  std::uint64_t fence = 0;   // higher for each new hold: a late edit carries an old one

  bool operator==(const Hold&) const = default;
};

/// Who is in the way of a request, and with what.
struct Obstacle {
  Item item;                 // held: the requested one, an ancestor or a descendant
  std::uint32_t holder = 0;  // 0: the requested thing is not there
};

/// Somebody waits for a thing that is held.
struct Waiting {
  Item item;
  std::uint32_t holder = 0;

  bool operator==(const Waiting&) const = default;
};

/// Floor control of one design (thesis 2.4.1): who has which things. A request for an object is granted if
/// neither it nor an ancestor nor a descendant is held by another; siblings are free. Other things are simply
/// granted or denied; a shape that several objects share is one thing, so it is held for all its users. Knows
/// the world during calls only, and no time: whoever owns it says when a holder is gone.
class Floor {
 public:
  /// Fences are above `fence_floor`.
  explicit Floor(std::uint64_t fence_floor = 0) : last_fence_(fence_floor) {}

  /// The hold, a new one or the one that the holder has; nothing where obstacle() names something.
  std::optional<Hold> request(const world::World& world, std::uint32_t holder, Item item);
  /// Queues a request behind those that wait already; grant_waiting() grants it one day.
  void wait(std::uint32_t holder, Item item);
  /// False where the holder did not have it. A request that waits is taken back as well.
  bool release(std::uint32_t holder, Item item);
  /// All that the holder had and waited for is free; gives what it had.
  std::vector<Hold> release_all(std::uint32_t holder);
  /// Takes a thing away from whoever has it.
  std::optional<Hold> take_away(Item item);
  /// Ends holds of and waiting for things that are no more in the world; gives the former.
  std::vector<Hold> drop_missing(const world::World& world);
  /// To be called after objects have got other parents.
  void objects_moved(const world::World& world);
  /// Grants what those who wait longest can have now. Call after each release and after each edit that moves
  /// objects or deletes them.
  std::vector<Hold> grant_waiting(const world::World& world);

  /// Who is in the way of a request for this thing; nothing where it would be granted.
  std::optional<Obstacle> obstacle(const world::World& world, std::uint32_t holder, Item item) const;
  /// Who is in the way of an edit.
  std::optional<Obstacle> obstacle(const world::World& world, std::uint32_t holder, const Needs& needs) const;
  /// Has the holder a hold with this fence now?
  bool is_held(std::uint32_t holder, std::uint64_t fence) const;

  const std::unordered_map<Item, Hold>& holds() const { return holds_; }
  const std::vector<Waiting>& waiting() const { return waiting_; }
  std::size_t count_of(std::uint32_t holder) const { return count_in(counts_, holder); }
  std::size_t waiting_of(std::uint32_t holder) const { return count_in(waiting_counts_, holder); }

 private:
  using Counts = std::unordered_map<std::uint32_t, std::size_t>;  // by holder
  static std::size_t count_in(const Counts& counts, std::uint32_t holder);
  std::optional<Obstacle> above(const world::World& world, std::uint32_t holder,
                                world::ObjectId object) const;
  std::optional<Obstacle> below(std::uint32_t holder, world::ObjectId object) const;
  std::vector<Hold> release_if(const auto& is_released);
  void erase_waiting(const auto& is_erased);
  void erase(const Hold& hold);
  void note_path(const world::World& world, const Hold& hold);
  void forget_path(const Hold& hold);

  std::unordered_map<Item, Hold> holds_;
  std::vector<Waiting> waiting_;  // the first has waited longest
  Counts counts_, waiting_counts_;
  // So that a request costs the depth of the object and not the number of holds: of each ancestor of held
  // objects what is held below it, by holder, and of each held object the ancestors that know it.
  std::unordered_map<world::ObjectId, std::map<std::uint32_t, std::set<Item>>> below_;
  std::unordered_map<Item, std::vector<world::ObjectId>> paths_;
  std::uint64_t last_fence_;
};

}  // namespace icome::collab
