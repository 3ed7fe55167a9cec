#include "session/hands/part_grab.h"

#include <utility>

#include "session/session.h"

namespace icome::session {
namespace {

constexpr std::uint32_t kPartButton = 1;  // button 0
constexpr double kPartSlack = 0.0005;     // m: a press with less movement moves nothing

}  // namespace

std::optional<haptics::GripFeel> PartGrab::update(Session& session, std::size_t pointer,
                                                  const Revisions& revisions, std::string& refused) {
  const PointerView& hand = session.hands().pointer(pointer);
  const bool there = hand.status != devices::DeviceStatus::Lost && hand.tip.allFinite();
  const bool down = there && (hand.buttons & kPartButton) != 0;
  const bool pressed = down && !std::exchange(was_down_, down);
  if (!down) was_down_ = false;
  if (!held_) return pressed ? begin(session, pointer, revisions, refused) : std::nullopt;
  if (held_->revision == revisions.now()) {
    const auto done = down ? follow(session, hand) : held_->pull.finish(session);
    held_->revision = revisions.now();
    if (down && done) return std::nullopt;
    if (!done) refused = done.error().message;
  }
  session.stage().mark_part(std::nullopt);
  held_.reset();
  return haptics::GripFeel{};
}

std::optional<haptics::GripFeel> PartGrab::begin(Session& session, std::size_t pointer,
                                                 const Revisions& revisions, std::string& refused) {
  if (session.hands().touched(pointer)) return std::nullopt;
  const PointerView& hand = session.hands().pointer(pointer);
  const auto part = session.stage().part_near(hand.tip, kReach);
  if (!part) return std::nullopt;
  auto pull = PartPull::take(session, *part);
  if (!pull) {
    refused = pull.error().message;
    return std::nullopt;
  }
  held_.emplace(Held{std::move(*pull), hand.tip, hand.orientation, revisions.now()});
  haptics::GripFeel feel;
  feel.holds = true;
  feel.start = hand.tip;
  if (!session.hands().grab().pull_back) feel.least_pull = feel.most_pull = 0.0;
  return feel;
}

base::Result<void> PartGrab::follow(Session& session, const PointerView& hand) {
  base::Affine3 motion = base::Affine3::Identity();
  motion.translate(hand.tip);
  motion.rotate(hand.orientation * held_->turned.conjugate());
  motion.translate(-held_->start);
  const bool rests = !held_->pull.performed() && (hand.tip - held_->start).norm() < kPartSlack;
  return rests ? base::Result<void>() : held_->pull.to(session, motion);
}

}  // namespace icome::session
