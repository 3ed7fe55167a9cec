#include <utility>

#include "base/clock.h"
#include "render/views.h"
#include "session/session_parts.h"

namespace icome::session {
namespace {

constexpr double kFlightSeconds = 0.35;

}  // namespace

void Session::Parts::move_view() {
  if (!flight) return;
  const double time = double(base::steady_nanoseconds() - flight_began) * 1e-9;
  view = flight->at(time);
  if (flight->over(time)) flight.reset();
  look_is_new = true;
}

void Session::Parts::publish_wish() {
  if (!std::exchange(look_is_new, false)) return;
  DisplayWish wish = look;
  wish.view = view;
  wish.look.selected = selection;
  display.wish(wish);
}

const interaction::View& Session::view() const { return parts_->view; }

void Session::set_view(const interaction::View& view) {
  parts_->flight.reset();
  parts_->view = view;
  parts_->look_is_new = true;
}

void Session::fly_to(const interaction::View& view) {
  parts_->flight.emplace(parts_->view, view, kFlightSeconds);
  parts_->flight_began = base::steady_nanoseconds();
}

void Session::home(double aspect) {
  const render::ViewDirection iso = *render::view_direction("iso");
  const world::World& world = parts_->world;
  const world::Scene* scene = world.find(parts_->shown_scene);
  base::Bounds bounds;
  for (const world::ObjectId id : scene ? scene->roots : world.roots())
    bounds.extend(world::bounds(world, id));
  if (!bounds.isEmpty()) bounds = bounds.transformed(base::Affine3(parts_->stage_from_world));
  fly_to(interaction::fitted(parts_->view, bounds, iso.toward_eye, iso.up, aspect));
}

interaction::NavigationMode Session::navigation_mode() const { return parts_->navigation_mode; }

void Session::set_navigation_mode(interaction::NavigationMode mode) { parts_->navigation_mode = mode; }

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
  if (!parts_->mouse_hand || !position.allFinite()) return;
  parts_->mouse_hand->set_target(parts_->hands.stage_from_device(0).inverse() * position);
}

std::optional<Session::Picked> Session::pick(const interaction::Ray&) const { return std::nullopt; }

std::vector<ForceSample> Session::take_forces() { return parts_->hands.take_forces(); }

}  // namespace icome::session
