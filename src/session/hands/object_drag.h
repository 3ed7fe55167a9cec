#pragma once
#include <optional>
#include <span>
#include <string>

#include "haptics/effects/grip.h"
#include "interaction/snapping/snapped_move.h"
#include "session/hands/surroundings.h"

namespace icome::session {

class Session;

/// Settings of moving things by hand or mouse, and of their feel.
struct GrabSettings {
  bool takes_hold = true;  // hands do; otherwise their buttons do nothing by themselves
  bool pull_back = true;   // they resist being taken away, the more the farther (thesis equation 4.14)
  double weight = 0.0;     // N, downwards; usually 0 to 2
  bool stop = true;        // at surfaces, and slide along them
  interaction::SnapSettings snaps = interaction::SnapSettings::none();
  double snap_strength = 0.6;  // N, the strongest pull of a snap; usually 0.3 to 2
};

/// Things that a hand or the mouse drags through a session's world, as its settings have it: they stop at
/// surfaces and snap. One action to undo. Nobody waits for it: where it takes long to tell how far they come,
/// a thread works it out, and they stay at the last place where they are known to be allowed. The session
/// outlives it.
class ObjectDrag {
 public:
  /// The action is called `name`. With `goes_on` it is more of the last one.
  ObjectDrag(const Session& session, std::span<const world::ObjectId> objects, std::string name,
             bool goes_on = false);

  bool empty() const { return drag_.empty(); }

  /// The place that the hand wants for them.
  struct Wish {
    base::Vector3 offset = base::Vector3::Zero();  // m, world frame, off where it took them
    std::optional<base::Vector3> axis = {};        // unit: they keep to the line along it
    bool snap = true;                              // to what the settings say
    bool operator==(const Wish&) const = default;
  };
  /// Brings them as near to that as they come, with an edit if they move at all, at once or by go_on(). Fails
  /// with the reason why they could not be moved.
  base::Result<void> to(Session& session, const Wish& wish);
  /// Brings them to the place that has been worked out meanwhile; to be called for each update of the
  /// session. Fails as to() does.
  base::Result<void> go_on(Session& session);
  /// Is it still being worked out how far they come?
  bool pending() const { return claim_.work || waits_; }
  /// The last wish, whether they are there or not.
  const Wish& wish() const { return wish_; }

  /// The effort of main at once, in units of world::Effort: some 20 ms at most.
  static constexpr std::uint64_t kAtOnce = 150'000;

  /// Have they been moved?
  bool moved() const { return moved_; }
  /// Their place, the contacts that stop them and their snap.
  const interaction::StoppedDrag& state() const { return drag_; }
  /// "Stopped at wall", "Snapped to a corner of table"; empty where neither is so.
  std::string words(const Session& session) const;

 private:
  /// Gives the work up when the drag ends.
  struct Claim {
    Claim() = default;
    Claim(Claim&&) = default;
    Claim& operator=(Claim&& other) noexcept {
      std::swap(work, other.work);
      return *this;
    }
    ~Claim() {
      if (work) work->give_up();
    }
    std::shared_ptr<Surroundings::Work> work = nullptr;
  };
  base::Result<void> ask(Session& session);
  base::Result<void> take(Session& session, const interaction::StoppedDrag::Found& found);

  interaction::StoppedDrag drag_;
  std::string name_;
  bool moved_ = false;
  bool goes_on_;
  Wish wish_ = {}, asked_ = {};
  Claim claim_ = {};
  bool waits_ = false;  // the wish could not be asked yet
  bool slow_ = false;   // it took longer than main has time for once: threads do the rest
};

/// The feel of a hand whose tip was at `start` (m, stage frame) when it took them.
haptics::GripFeel feel_of(const ObjectDrag& drag, const base::Vector3& start, const GrabSettings& settings);

}  // namespace icome::session
