#include "session/hands/hand_grab.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "interaction/object_move.h"
#include "session/session.h"

namespace icome::session {
namespace {

constexpr std::uint32_t kGrabButton = 1;  // button 0
/// A press with less movement only selects.
constexpr double kGrabSlack = 0.0005;  // m

std::string move_name(const world::World& world, const std::vector<world::ObjectId>& objects) {
  if (objects.size() != 1) return fmt::format("Move {} objects", objects.size());
  const world::PhysicalObject* object = world.find(objects.front());
  return object && !object->name.empty() ? "Move " + object->name : "Move object";
}

}  // namespace

std::optional<haptics::GripFeel> HandGrab::update(Session& session, std::size_t pointer,
                                                  const Revisions& revisions, std::string& refused) {
  const PointerView& hand = session.hands().pointer(pointer);
  const bool down =
      hand.status != devices::DeviceStatus::Lost && (hand.buttons & kGrabButton) != 0 && hand.tip.allFinite();
  const bool was_down = std::exchange(was_down_, down);
  if (down && !was_down) begin(session, pointer, revisions.now());
  if (!held_) {
    arrive(session, revisions);
    return std::nullopt;
  }
  const bool goes_on = down && held_->revision == revisions.now();
  if (goes_on && follow(session, hand.tip, revisions, refused))
    return feel_of(held_->drag, held_->start, session.hands().grab());
  if (!down && held_->revision == revisions.now() && held_->drag.pending()) let_go_ = std::move(held_);
  held_.reset();
  return haptics::GripFeel{};
}

void HandGrab::begin(Session& session, std::size_t pointer, std::uint64_t revision) {
  let_go_.reset();
  const auto touched = session.hands().touched(pointer);
  if (!touched || !session.world().find(*touched)) return;
  const bool is_selected = std::ranges::any_of(
      session.selection(), [&](world::ObjectId id) { return is_within(session.world(), *touched, id); });
  if (!is_selected) session.select({*touched});
  const auto objects = interaction::topmost(session.world(), session.selection());
  ObjectDrag drag(session, objects, move_name(session.world(), objects));
  if (drag.empty()) return;
  held_.emplace(Held{std::move(drag), session.hands().pointer(pointer).tip, revision});
}

/// Brings released objects to where the hand had them, as soon as it is known how far they come.
void HandGrab::arrive(Session& session, const Revisions& revisions) {
  if (!let_go_) return;
  const bool goes_on = let_go_->revision == revisions.now() && let_go_->drag.go_on(session).has_value();
  let_go_->revision = revisions.now();
  if (!goes_on || !let_go_->drag.pending()) let_go_.reset();
}

/// Follows the tip; false when it could not go on.
bool HandGrab::follow(Session& session, const base::Vector3& tip, const Revisions& revisions,
                      std::string& refused) {
  const base::Vector3 offset = tip - held_->start;
  auto done = held_->drag.go_on(session);
  const bool is_new = offset != held_->drag.wish().offset;
  if (done && is_new && (held_->drag.moved() || offset.norm() >= kGrabSlack))
    done = held_->drag.to(session, {.offset = offset});
  if (!done) {
    refused = done.error().message;
    return false;
  }
  held_->revision = revisions.now();
  return true;
}

}  // namespace icome::session
