#include <cmath>
#include <utility>

#include "base/clock.h"
#include "interaction/object_move.h"
#include "render/views.h"
#include "session/picking.h"
#include "session/session_parts.h"

namespace icome::session {

/// Moves the user on, with the workspaces of all pointers.
void Session::Parts::move_user() {
  const std::int64_t now = base::steady_nanoseconds();
  const double dt = moved_at == 0 ? 0.0 : double(now - moved_at) * 1e-9;
  moved_at = now;
  const UserInteraction::News news = user.update(dt);
  for (const auto& it : news.devices)
    tell(it.lost ? SessionEvent::Kind::DeviceLost : SessionEvent::Kind::DeviceBack, it.text);
  if (news.home) go_home();
  for (std::size_t i = 0; i < hands.pointers(); ++i) hands.carry(i, user.stage_from_device());
  if (!hand_is_aimed) park();
}

void Session::Parts::aim(const base::Vector3& position) {
  if (!mouse_hand) return;
  hand_is_aimed = true;
  // It is taken up where it lies.
  if (parked_at) mouse_hand->put(*std::exchange(parked_at, std::nullopt));
  mouse_hand->set_target(hands.stage_from_device(0).inverse() * position);
}

void Session::Parts::put(const base::Vector3& position) {
  aim(position);
  if (mouse_hand) mouse_hand->put(hands.stage_from_device(0).inverse() * position);
}

/// Put, not led: something may stand in the way.
void Session::Parts::park() {
  if (!mouse_hand) return;
  const base::Vector3 eye = hands.stage_from_device(0).inverse() * user.view().world_from_eye.translation();
  if (parked_at == eye) return;
  parked_at = eye;
  mouse_hand->set_target(eye);
  mouse_hand->park(eye);
}

/// A group has no shape of its own: what is selected shows by all that moves along with it.
void Session::Parts::renew_outline() {
  if (!std::exchange(outline_is_new, false)) return;
  std::vector<world::ObjectId> all;
  for (const world::ObjectId root : interaction::topmost(world, selection)) {
    const auto below = world::subtree(world, root);
    all.insert(all.end(), below.begin(), below.end());
  }
  if (all == outlined) return;
  outlined = std::move(all);
  look_is_new = true;
}

void Session::Parts::publish_wish() {
  renew_outline();
  const interaction::View& now = user.drawn_view();
  if (now.world_from_eye.matrix() != drawn_view.world_from_eye.matrix() || now.field != drawn_view.field ||
      now.distance != drawn_view.distance)
    look_is_new = true;
  if (!std::exchange(look_is_new, false)) return;
  drawn_view = now;
  DisplayWish wish = look;
  wish.view = now;
  wish.look.selected = outlined;
  display.wish(wish);
}

void Session::Parts::go_home() {
  const render::ViewDirection iso = *render::view_direction("iso");
  const world::Scene* scene = world.find(shown_scene);
  base::Bounds bounds;
  for (const world::ObjectId id : scene ? scene->roots : world.roots())
    bounds.extend(world::bounds(world, id));
  user.fly_to(interaction::fitted(user.view(), bounds, iso.toward_eye, iso.up, aspect));
}

const interaction::View& Session::view() const { return parts_->user.view(); }

void Session::set_view(const interaction::View& view) { parts_->user.set_view(view); }

void Session::fly_to(const interaction::View& view) { parts_->user.fly_to(view); }

void Session::home() { parts_->go_home(); }

void Session::set_aspect(double aspect) {
  if (aspect > 0.0 && std::isfinite(aspect)) parts_->aspect = aspect;
}

interaction::NavigationMode Session::navigation_mode() const { return parts_->user.mode(); }

void Session::set_navigation_mode(interaction::NavigationMode mode) { parts_->user.set_mode(mode); }

void Session::set_look(const DisplayWish& look) {
  parts_->look = look;
  parts_->look_is_new = true;
}

std::size_t Session::pointers() const { return parts_->hands.pointers(); }

const PointerView& Session::pointer(std::size_t index) const { return parts_->hands.view(index); }

const devices::DeviceInfo& Session::pointer_info(std::size_t index) const {
  return parts_->hands.info(index);
}

std::optional<world::ObjectId> Session::touched(std::size_t index) const {
  const PointerView& view = pointer(index);
  if (!view.touching) return std::nullopt;
  return parts_->felt.read().names->object(view.touched);
}

void Session::aim_hand(const base::Vector3& position) {
  if (!position.allFinite()) return;
  parts_->aim(position);
}

void Session::put_hand(const base::Vector3& position) {
  if (!position.allFinite()) return;
  parts_->put(position);
}

void Session::park_hand() { parts_->hand_is_aimed = false; }

std::optional<Session::Picked> Session::pick(const interaction::Ray& ray) const {
  const FeltVersion& felt = parts_->felt.read();
  const auto thing = session::pick(*felt.scene, ray);
  if (!thing) return std::nullopt;
  const auto object = felt.names->object(thing->object);
  if (!object) return std::nullopt;
  return Picked{*object, thing->place};
}

std::vector<ForceSample> Session::take_forces() { return parts_->hands.take_forces(); }

}  // namespace icome::session
