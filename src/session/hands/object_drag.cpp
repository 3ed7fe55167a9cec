#include "session/hands/object_drag.h"

#include <fmt/format.h>

#include <utility>

#include "interaction/snapping/snap_feel.h"
#include "session/session.h"

namespace icome::session {
namespace {

using base::Matrix3;
using base::Vector3;
using interaction::Contact;
using interaction::SnapKind;

/// The contacts by which the hand feels stopped.
std::vector<Contact> felt_contacts(const interaction::StoppedDrag& drag) {
  return interaction::holding(drag.contacts(), drag.wanted() - drag.free());
}

/// The directions in which a snap holds.
Matrix3 across(const interaction::Snap& snap) {
  const Matrix3 along = snap.direction * snap.direction.transpose();
  if (snap.kind == SnapKind::Face) return along;
  if (snap.kind == SnapKind::Edge) return Matrix3::Identity() - along;
  return Matrix3::Identity();
}

std::string spoken_name(const world::World& world, world::ObjectId id) {
  const world::PhysicalObject* object = world.find(id);
  return object && !object->name.empty() ? object->name : "an object without a name";
}

}  // namespace

ObjectDrag::ObjectDrag(const Session& session, std::span<const world::ObjectId> objects, std::string name,
                       bool goes_on)
    : drag_(session.world(), objects), name_(std::move(name)), goes_on_(goes_on) {}

base::Result<void> ObjectDrag::to(Session& session, const Wish& wish) {
  wish_ = wish;
  if (claim_.work) return {};  // go_on() sees to it
  return ask(session);
}

base::Result<void> ObjectDrag::ask(Session& session) {
  constexpr std::uint64_t kByThread =
      30'000'000;  // then they go as far as is known, and it goes on from there
  Surroundings& around = session.hands().surroundings();
  waits_ = around.are_lent();
  if (waits_) return {};
  const GrabSettings& settings = session.hands().grab();
  interaction::DragRules rules;
  rules.stops.stop = settings.stop;
  rules.snaps = wish_.snap ? settings.snaps : interaction::SnapSettings::none();
  rules.axis = wish_.axis;
  asked_ = wish_;
  if (!slow_) {
    world::Effort effort(kAtOnce);
    const auto found =
        drag_.find(session.world(), around.index(), around.finder(), wish_.offset, rules, &effort);
    if (!found) return tl::unexpected(found.error());
    slow_ = effort.is_spent();
    if (!slow_) return take(session, *found);
  }
  claim_.work = around.work_out(drag_, wish_.offset, rules, kByThread);
  return {};
}

base::Result<void> ObjectDrag::take(Session& session, const interaction::StoppedDrag::Found& found) {
  const Vector3 before = drag_.offset();
  const world::Edit edit = drag_.take(found);
  if (drag_.offset() == before) return {};
  const auto done =
      moved_ || goes_on_ ? session.history().extend(edit) : session.history().perform(edit, name_);
  moved_ = moved_ || done.has_value();
  return done;
}

base::Result<void> ObjectDrag::go_on(Session& session) {
  if (waits_) return ask(session);
  if (!claim_.work || !claim_.work->is_done()) return {};
  const auto work = std::exchange(claim_.work, nullptr);
  const auto found = work->take();
  if (!found) return tl::unexpected(found.error());
  if (work->is_stale()) return ask(session);
  const Vector3 before = drag_.offset();
  if (const auto taken = take(session, *found); !taken) return taken;
  const bool gets_on = found->spent && drag_.offset() != before;
  return gets_on || wish_ != asked_ ? ask(session) : base::Result<void>();
}

std::string ObjectDrag::words(const Session& session) const {
  if (const auto& snap = drag_.snap()) {
    const world::ObjectId to = snap->snap.object;
    return fmt::format("Snapped to {}{}", name_of(snap->snap.kind),
                       to ? " of " + spoken_name(session.world(), to) : std::string());
  }
  const auto contacts = felt_contacts(drag_);
  if (contacts.empty() && pending()) return "Finding out how far it can go\u2026";
  if (contacts.empty()) return {};
  return fmt::format("Stopped at {}", spoken_name(session.world(), contacts.front().other));
}

haptics::GripFeel feel_of(const ObjectDrag& drag, const Vector3& start, const GrabSettings& settings) {
  haptics::GripFeel feel;
  feel.holds = true;
  feel.start = start;
  if (!settings.pull_back) feel.least_pull = feel.most_pull = 0.0;
  feel.weight = -settings.weight * Vector3::UnitY();
  const interaction::StoppedDrag& state = drag.state();
  for (const Contact& it : felt_contacts(state))
    feel.stops[feel.stop_count++] = {start + state.free(), it.normal};
  if (const auto& snap = state.snap()) {
    const double radius = settings.snaps.radius;
    feel.well =
        haptics::GripFeel::Well{.centre = start + state.offset(),
                                .radius = radius,
                                .stiffness = interaction::stiffness_of({settings.snap_strength, radius}),
                                .across = across(snap->snap)};
  }
  return feel;
}

}  // namespace icome::session
