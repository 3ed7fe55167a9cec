#include <utility>

#include "session/session_parts.h"

namespace icome::session {
/// Lets go of what a pointer holds: it may not be there to be held any more.
void SessionParts::let_go(std::size_t pointer) {
  PointerParts& it = pointers[pointer];
  if (it.grab.holds() || it.part_grab.holds() || it.point_grab.holds()) hands.grip(pointer, {});
  if (it.part_grab.holds()) mark_part(std::nullopt);
  it.grab = {};
  it.part_grab = {};
  it.point_grab = {};
  it.ungrabbed = true;
}

void SessionParts::let_go_of_technique() {
  if (!technique || !technique->holds()) return;
  technique->let_go();
  feel_held(false);
}

bool SessionParts::is_held(std::size_t pointer) const {
  const PointerParts& it = pointers[pointer];
  const bool by_technique = pointer == 0 && technique && technique->holds();
  return by_technique || it.grab.holds() || it.part_grab.holds() || it.point_grab.holds();
}

void SessionHands::set_grab(const GrabSettings& settings) { parts_.grab_settings = settings; }

const GrabSettings& SessionHands::grab() const { return parts_.grab_settings; }

Surroundings& SessionHands::surroundings() { return parts_.surroundings; }

bool SessionHands::holds(std::size_t index) const { return parts_.is_held(index); }

bool SessionHands::is_mouse_driven() const { return parts_.is_mouse(0); }

void SessionHands::hold_pointer(const std::optional<base::Vector3>& place) {
  haptics::GripFeel feel;
  if (place) {
    feel.holds = true;
    feel.start = *place;
    feel.freedom.setZero();
  }
  parts_.hands.grip(0, feel);
}

void SessionHands::give_forces(bool given) {
  for (std::size_t i = 0; i < parts_.hands.pointers(); ++i) parts_.hands.give_forces(i, given);
}

void SessionHands::trace(bool on) { parts_.hands.trace(on); }

SessionHands::Ticks SessionHands::take_trace() {
  return {parts_.hands.take_trace(), parts_.hands.lost_ticks(), parts_.felt.read().names};
}

base::Result<void> SessionHands::set_shaping(const std::optional<interaction::ShapingSettings>& settings) {
  if (settings) {
    interaction::Shaping fresh;
    if (const auto good = fresh.set(*settings); !good) return good;
    if (!parts_.shaping) parts_.shaping = std::move(fresh);
    (void)parts_.shaping->set(*settings);  // it keeps its knowledge of shapes
  } else {
    parts_.shaping.reset();
  }
  for (std::size_t i = 0; i < parts_.hands.pointers(); ++i) {
    if (holds(i)) parts_.hands.grip(i, {});
    const bool ungrabbed = parts_.pointers[i].ungrabbed;
    parts_.let_go(i);
    parts_.pointers[i].ungrabbed = ungrabbed;
  }
  if (parts_.technique) parts_.technique->let_go();
  parts_.mouse_marks.reset();
  parts_.mark_part(std::nullopt);
  return {};
}

interaction::Shaping* SessionHands::shaping() { return parts_.shaping ? &*parts_.shaping : nullptr; }

ServoHealth SessionHands::servo() const {
  const realtime::LoopRunner& loop = *parts_.hands.loop();
  ServoHealth health;
  health.running = loop.running();
  health.rate_hz = parts_.settings.servo.rate_hz;
  health.summary = loop.recorder().summary();
  health.load_histogram = loop.recorder().load_histogram();
  health.notice = loop.report().notice;
  return health;
}

void SessionHands::hold_buttons(std::uint32_t buttons) {
  if (parts_.mouse_hand) parts_.mouse_hand->hold_buttons(buttons);
}

std::size_t SessionHands::pointers() const { return parts_.hands.pointers(); }

const PointerView& SessionHands::pointer(std::size_t index) const { return parts_.hands.view(index); }

const devices::DeviceInfo& SessionHands::pointer_info(std::size_t index) const {
  return parts_.hands.info(index);
}

std::optional<world::ObjectId> SessionHands::touched(std::size_t index) const {
  const PointerView& view = parts_.hands.view(index);
  if (!view.touching) return std::nullopt;
  return parts_.felt.read().names->object(view.touched);
}

const std::vector<haptics::CappedEffect>& SessionHands::capped_effects() const {
  static const std::vector<haptics::CappedEffect> kNone;
  return parts_.capped ? *parts_.capped : kNone;
}

void SessionHands::aim(const base::Vector3& position) {
  if (!position.allFinite()) return;
  parts_.aim(position);
}

void SessionHands::put(const base::Vector3& position) {
  if (!position.allFinite()) return;
  parts_.put(position);
}

void SessionHands::park() {
  if (std::exchange(parts_.hand_is_aimed, false)) parts_.look_is_new = true;
}

std::vector<ForceSample> SessionHands::take_forces() { return parts_.hands.take_forces(); }

}  // namespace icome::session
