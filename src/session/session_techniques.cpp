#include <algorithm>

#include "session/display/technique_marks.h"
#include "session/session_parts.h"
#include "world/hasher.h"

namespace icome::session {
namespace {

using base::Pose;
using base::Vector3;

/// A hand at the place that points away from the eye, as upright as the eye is: it points as the mouse does.
Pose pointing_from_eye(const Pose& eye, const Vector3& place) {
  const Vector3 back = eye.translation() - place;
  Pose hand = eye;
  hand.translation() = place;
  const Vector3 right = Vector3(eye.linear().col(1)).cross(back);
  if (!(right.norm() > 1e-9 * back.norm())) return hand;
  hand.linear().col(2) = back.normalized();
  hand.linear().col(0) = right.normalized();
  hand.linear().col(1) = hand.linear().col(2).cross(hand.linear().col(0));
  return hand;
}

}  // namespace

bool SessionParts::is_hand_there(std::size_t pointer) const {
  if (pointer >= hands.pointers()) return false;
  const PointerView& view = hands.view(pointer);
  if (is_mouse(pointer) && !hand_is_aimed) return false;
  return view.time != 0 && view.status != devices::DeviceStatus::Lost &&
         view.device_from_stylus.matrix().allFinite();
}

/// The hand's pose with its workspace where the user now is, which the servo gets to softly.
Pose SessionParts::stage_from_hand(std::size_t pointer) const {
  const Pose hand = user.stage_from_device() * hands.view(pointer).device_from_stylus;
  if (!is_mouse(pointer)) return hand;
  return pointing_from_eye(user.view().world_from_eye, hand.translation());
}

TechniqueMoment SessionParts::technique_moment() const {
  TechniqueMoment moment;
  moment.time = double(moved_at - technique_since) * 1e-9;
  moment.stage_from_eye = user.drawn_view().world_from_eye;
  moment.stage_from_workspace = user.stage_from_device();
  moment.distance = user.view().distance;
  for (std::size_t i = 0; i < std::min(hands.pointers(), moment.hands.size()); ++i) {
    if (!is_hand_there(i)) continue;
    const std::uint32_t buttons = is_at_menu(i) && !is_held(i) ? 0 : hands.view(i).buttons;
    moment.hands[i] = {true, stage_from_hand(i), buttons};
  }
  return moment;
}

void SessionParts::carry_user(const Pose& by) {
  user.carry(by);
  for (std::size_t i = 0; i < hands.pointers(); ++i) hands.carry(i, user.stage_from_device());
}

/// Sets the feel of a hand that holds something: nothing holds it back.
void SessionParts::feel_held(bool held) {
  haptics::GripFeel feel;
  feel.holds = held;
  feel.least_pull = feel.most_pull = 0.0;
  for (std::size_t i = 0; i < hands.pointers(); ++i) hands.grip(i, feel);
}

void SessionParts::hold_by_technique(Session& session) {
  const std::shared_ptr<TechniqueHand> at_work = technique;
  const bool held = at_work->holds();
  std::string refused;
  const auto by = at_work->update(session, technique_moment(), revisions, refused);
  if (technique != at_work) return;  // a listener has chosen another
  if (technique->holds() != held) feel_held(technique->holds());
  if (by) {
    carry_user(*by);
  } else if (!at_work->resting()) {
    user.keep_hands();
  }
  if (!refused.empty()) tell(SessionEvent::Kind::Notice, refused);
}

/// Renews the drawing of the technique, where it has changed.
void SessionParts::renew_marks(const Session& session) {
  std::optional<base::Affine3> copy;
  std::uint64_t now = 0;
  const bool is_at_work = technique && !shaping;
  if (is_at_work) {
    world::Hasher hasher;
    hasher.add(interaction::hash({&technique->outcome(), 1}));
    hasher.add(revisions.now());
    now = hasher.value();
    copy = technique->copy_from_stage(session);
  }
  const bool same_copy =
      copy.has_value() == miniature.has_value() && (!copy || copy->matrix() == miniature->matrix());
  if (same_copy && marks.has_value() == is_at_work && marks_of == now) return;
  marks.reset();
  if (is_at_work) marks = technique_marks(*technique, session);
  marks_of = now;
  miniature = copy;
  look_is_new = true;
}

base::Result<void> SessionTechniques::set(const std::optional<interaction::Technique>& technique) {
  if (technique) {
    if (const auto possible = check(*technique); !possible) return possible;
  }
  SessionParts& parts = parts_;
  bool held = parts.technique && parts.technique->holds();
  for (PointerParts& it : parts.pointers) {
    held = held || it.grab.holds() || it.part_grab.holds();
    it.grab = {};
    it.part_grab = {};
    it.ungrabbed = true;
  }
  parts_.mark_part(std::nullopt);
  if (held) parts.feel_held(false);
  parts.technique.reset();
  if (technique) parts.technique = std::make_shared<TechniqueHand>(*technique, parts.target_maker);
  parts.technique_since = parts.moved_at;
  return {};
}

const TechniqueHand* SessionTechniques::current() const { return parts_.technique.get(); }

std::optional<base::Affine3> SessionTechniques::miniature() const {
  if (!parts_.technique) return std::nullopt;
  return parts_.technique->copy_from_stage(session_);
}

base::Result<void> SessionTechniques::record() {
  if (!parts_.technique)
    return base::fail("What is done by touch is not recorded: choose another technique first.");
  if (parts_.technique->holds()) parts_.feel_held(false);
  parts_.technique->record(parts_.world);
  return {};
}

std::optional<TechniqueHand::Recorded> SessionTechniques::stop_recording() {
  if (!parts_.technique) return std::nullopt;
  return parts_.technique->stop_recording();
}

}  // namespace icome::session
