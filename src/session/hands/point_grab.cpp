#include "session/hands/point_grab.h"

#include <utility>

#include "session/session.h"

namespace icome::session {
namespace {

constexpr std::uint32_t kPointButton = 1;      // button 0
constexpr double kPointSlack = 0.0005;         // m: a press with less movement moves nothing
constexpr std::size_t kMostPointObjects = 64;  // of the selection

haptics::GripFeel point_feel(const base::Vector3& start, const GrabSettings& settings) {
  haptics::GripFeel feel;
  feel.holds = true;
  feel.start = start;
  if (!settings.pull_back) feel.least_pull = feel.most_pull = 0.0;
  return feel;
}

}  // namespace

std::optional<haptics::GripFeel> PointGrab::update(Session& session, std::size_t pointer,
                                                   const Revisions& revisions, const GrabSettings& settings,
                                                   std::string& refused) {
  const PointerView& hand = session.hands().pointer(pointer);
  const bool there = hand.status != devices::DeviceStatus::Lost && hand.tip.allFinite();
  const bool down = there && (hand.buttons & kPointButton) != 0;
  const bool pressed = down && !std::exchange(was_down_, down);
  if (!down) was_down_ = false;
  if (!pull_) {
    marked_.reset();
    if (there) look(session, pointer);
    if (pressed && begin(session, hand.tip, revisions.now(), refused)) return point_feel(hand.tip, settings);
    return std::nullopt;
  }
  if (down && revision_ == revisions.now() && follow(session, hand.tip, revisions, refused))
    return std::nullopt;
  if (revision_ == revisions.now()) {
    const auto done = pull_->finish(session);
    if (!done) refused = done.error().message;
  }
  pull_.reset();
  marked_.reset();
  return haptics::GripFeel{};
}

/// Finds the handle that the tip would take hold of.
void PointGrab::look(Session& session, std::size_t pointer) {
  const world::World& world = session.world();
  auto objects = interaction::draggable_objects(world, session.selection(), kMostPointObjects);
  if (const auto touched = session.hands().touched(pointer)) objects.push_back(*touched);
  const auto probe = interaction::probe_round(session.hands().pointer(pointer).tip, kReach);
  auto found = session.hands().shaping()->find(world, objects, probe);
  if (found) marked_ = interaction::MarkedHandle{.handle = std::move(*found)};
}

bool PointGrab::begin(Session& session, const base::Vector3& tip, std::uint64_t revision,
                      std::string& refused) {
  if (!marked_) return false;
  auto pull = PointPull::take(session, marked_->handle);
  if (!pull) {
    refused = pull.error().message;
    return false;
  }
  pull_ = std::move(*pull);
  marked_ = pull_->marked();
  start_ = tip;
  revision_ = revision;
  return true;
}

/// Follows the tip; false when it could not go on.
bool PointGrab::follow(Session& session, const base::Vector3& tip, const Revisions& revisions,
                       std::string& refused) {
  const base::Vector3 offset = tip - start_;
  if (!pull_->performed() && offset.norm() < kPointSlack) return true;
  const auto done = pull_->to(session, offset);
  revision_ = revisions.now();
  if (!done) refused = done.error().message;
  return done.has_value();
}

}  // namespace icome::session
