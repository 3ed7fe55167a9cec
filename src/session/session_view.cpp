#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/clock.h"
#include "interaction/object_move.h"
#include "render/model/views.h"
#include "session/session_parts.h"

namespace icome::session {
namespace {

constexpr charts::Colour kHandleColour{0.10, 0.35, 0.80};
constexpr charts::Colour kHandleLineColour{0.30, 0.40, 0.60, 0.7};
constexpr charts::Colour kMarkedHandleColour{1.0, 0.55, 0.10};
constexpr std::size_t kMostHandledObjects = 32;

/// Compares bit by bit: places that are not finite equal themselves.
bool same_bits(const std::vector<base::Vector3>& one, const std::vector<base::Vector3>& other) {
  return one.size() == other.size() &&
         (one.empty() || std::memcmp(one.data(), other.data(), one.size() * sizeof(base::Vector3)) == 0);
}

bool same_handles(const interaction::ShapingPicture& one, const interaction::ShapingPicture& other) {
  return same_bits(one.dots, other.dots) && same_bits(one.lines, other.lines) &&
         same_bits(one.marked_dots, other.marked_dots) && same_bits(one.marked_lines, other.marked_lines);
}

/// `line`: the thickness in pixels.
void add_handles(const interaction::ShapingPicture& handles, double line, render::SceneOverlay& overlay) {
  overlay.lines.push_back({handles.lines, kHandleLineColour, 0.75 * line});
  overlay.lines.push_back({handles.marked_lines, kMarkedHandleColour, 1.5 * line});
  overlay.dots.push_back({handles.dots, kHandleColour, 3.5 * line});
  overlay.dots.push_back({handles.marked_dots, kMarkedHandleColour, 5.5 * line});
}

void add_marks(render::SceneOverlay& overlay, const render::SceneOverlay& more) {
  overlay.balls.insert(overlay.balls.end(), more.balls.begin(), more.balls.end());
  overlay.arrows.insert(overlay.arrows.end(), more.arrows.begin(), more.arrows.end());
  overlay.lines.insert(overlay.lines.end(), more.lines.begin(), more.lines.end());
  overlay.panels.insert(overlay.panels.end(), more.panels.begin(), more.panels.end());
}

}  // namespace

/// Moves the user on, with the workspaces of all pointers.
void SessionParts::move_user() {
  const std::int64_t now = base::steady_nanoseconds();
  const double dt = moved_at == 0 ? 0.0 : double(now - moved_at) * 1e-9;
  moved_at = now;
  const UserInteraction::News news = user.update(dt);
  for (const auto& it : news.devices)
    tell(it.lost ? SessionEvent::Kind::DeviceLost : SessionEvent::Kind::DeviceBack, it.text);
  if (news.home) go_home();
  follow_person();
  for (std::size_t i = 0; i < hands.pointers(); ++i) hands.carry(i, user.stage_from_device());
  follow_view_scale(dt);
  if (!hand_is_aimed) park();
}

void SessionParts::aim(const base::Vector3& position) {
  if (!mouse_hand) return;
  if (!std::exchange(hand_is_aimed, true)) look_is_new = true;
  // A hand that lies aside is taken up where it lies.
  if (parked_at) mouse_hand->put(*std::exchange(parked_at, std::nullopt));
  mouse_hand->set_target(hands.stage_from_device(*mouse()).inverse() * position);
}

void SessionParts::put(const base::Vector3& position) {
  aim(position);
  if (mouse_hand) mouse_hand->put(hands.stage_from_device(*mouse()).inverse() * position);
}

/// Puts the hand at the eye instead of leading it there: something may stand in the way.
void SessionParts::park() {
  if (!mouse_hand) return;
  const base::Vector3 eye =
      hands.stage_from_device(*mouse()).inverse() * user.view().world_from_eye.translation();
  if (parked_at == eye) return;
  parked_at = eye;
  mouse_hand->set_target(eye);
  mouse_hand->park(eye);
}

/// A group has no shape of its own: the selection shows by all that moves along with it.
void SessionParts::renew_outline() {
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

/// Renews the handles by which shapes can be dragged, at their present places.
void SessionParts::renew_handles() {
  interaction::ShapingPicture now;
  if (shaping) {
    std::vector<interaction::MarkedHandle> marked;
    if (mouse_marks) marked.push_back(*mouse_marks);
    for (const PointerParts& it : pointers) {
      if (it.point_grab.marked()) marked.push_back(*it.point_grab.marked());
    }
    const auto objects = interaction::draggable_objects(world, selection, kMostHandledObjects);
    now = shaping->picture(world, objects, marked);
  }
  if (same_handles(now, handles)) return;
  handles = std::move(now);
  look_is_new = true;
}

/// Renews the symbols of effects, at their present places.
void SessionParts::renew_symbols() {
  if (!std::exchange(symbols_are_new, false)) return;
  symbols = effects.overlay(world, shown_scene);
  look_is_new = true;
}

/// Renews the operands and projectors of the selection, at their present places.
void SessionParts::renew_parts() {
  if (!std::exchange(parts_are_new, false)) return;
  const bool had_parts = !part_outlines.empty();
  part_outlines.renew(world, shown_scene, selection);
  if (had_parts || !part_outlines.empty()) look_is_new = true;
}

/// Renews the workspaces that are shown, at their present places.
void SessionParts::renew_workspaces() {
  const double now = session_seconds();
  std::vector<WorkspaceMark> shown;
  for (std::size_t i = 0; i < hands.pointers(); ++i) {
    devices::MappedDevice* const device = hands.mapped(i);
    if (!device || hands.view(i).status == devices::DeviceStatus::Lost) continue;
    const devices::ClutchState& clutch = device->clutch();
    if (!pointers[i].shows_workspace && !clutch.held && now > pointers[i].seen_until) continue;
    shown.push_back({hands.stage_from_device(i) * clutch.shift, hands.stage_from_device(i).linear(),
                     device->info().workspace_radius});
  }
  if (shown == workspaces) return;
  workspaces = std::move(shown);
  look_is_new = true;
}

void SessionParts::mark_part(const std::optional<MarkedPart>& marked) {
  const auto& now = marked_part;
  const bool same = now.has_value() == marked.has_value() &&
                    (!now || (now->part == marked->part && !now->motion && !marked->motion));
  if (same) return;
  marked_part = marked;
  look_is_new = true;
}

interaction::StereoSettings SessionParts::stereo_now() const {
  using interaction::StereoKind;
  interaction::StereoSettings now = stereo;
  if (asked_stereo == false) now.kind = StereoKind::Off;
  if (asked_stereo == true && now.kind == StereoKind::Off) now.kind = StereoKind::Anaglyph;
  return now;
}

void SessionParts::renew_fish_tank() { user.set_fish_tank(fish_tank ? std::optional(screen) : std::nullopt); }

void SessionParts::publish_wish() {
  renew_people();
  renew_outline();
  renew_handles();
  renew_symbols();
  renew_parts();
  renew_workspaces();
  using interaction::Eye;
  const interaction::View& now = user.drawn_view();
  if (!is_same_view(now, drawn_view) || !is_same_view(user.drawn_view(Eye::Left), drawn_left))
    look_is_new = true;
  if (!std::exchange(look_is_new, false)) return;
  drawn_view = now;
  drawn_left = user.drawn_view(Eye::Left);
  DisplayWish wish = look;
  wish.view = now;
  wish.stereo = stereo_now();
  wish.left = drawn_left;
  wish.right = user.drawn_view(Eye::Right);
  if (!outlined.empty()) wish.look.outlines.push_back({outlined, look.selection});
  wish.look.outlines.insert(wish.look.outlines.end(), held_outlines.begin(), held_outlines.end());
  add_marks(wish.look.overlay, symbols);
  add_marks(wish.look.overlay, part_outlines.overlay(marked_part));
  add_marks(wish.look.overlay, people_marks(people, now));
  if (mouse_hand && !hand_is_aimed) wish.aside = mouse();
  add_marks(wish.look.overlay, workspace_marks(workspaces, look.workspace));
  wish.in_sight = workspace_ends(workspaces, now);
  if (shaping) add_handles(handles, wish.look.outline_width, wish.look.overlay);
  wish.miniature = marks ? miniature : std::nullopt;
  if (marks) add_marks(wish.look.overlay, *marks);
  wish.look.overlay.panels.insert(wish.look.overlay.panels.end(), menu.panels().begin(), menu.panels().end());
  display.wish(wish);
}

void SessionParts::go_home() {
  const render::ViewDirection iso = *render::view_direction("iso");
  const world::Scene* scene = world.find(shown_scene);
  base::Bounds bounds;
  for (const world::ObjectId id : scene ? scene->roots : world.roots())
    bounds.extend(world::bounds(world, id));
  bounds.extend(effects.bounds(world, shown_scene));
  user.fly_to(interaction::fitted(user.view(), bounds, iso.toward_eye, iso.up, aspect));
}

const render::RenderScenePointer& SessionView::drawn() const { return parts_.seen.read(); }

DisplayFeed& SessionView::display() { return parts_.display; }

const interaction::View& SessionView::now() const { return parts_.user.view(); }

void SessionView::set(const interaction::View& view) {
  parts_.followed.reset();
  parts_.user.set_view(view);
}

void SessionView::fly_to(const interaction::View& view) {
  parts_.followed.reset();
  parts_.user.fly_to(view);
}

void SessionView::home() {
  parts_.followed.reset();
  parts_.go_home();
}

void SessionView::set_aspect(double aspect) {
  if (aspect > 0.0 && std::isfinite(aspect)) parts_.aspect = aspect;
}

double SessionView::aspect() const { return parts_.aspect; }

interaction::NavigationMode SessionView::navigation_mode() const { return parts_.user.mode(); }

const interaction::View& SessionView::drawn_view(interaction::Eye eye) const {
  return parts_.user.drawn_view(eye);
}

void SessionView::set_stereo(const interaction::StereoSettings& stereo) {
  if (stereo == parts_.stereo) return;
  parts_.stereo = stereo;
  parts_.user.set_eye_distance(stereo.eye_distance);
  parts_.look_is_new = true;
}

void SessionView::ask_for_stereo(std::optional<bool> wanted) {
  parts_.asked_stereo = wanted;
  parts_.look_is_new = true;
}

interaction::StereoSettings SessionView::stereo() const { return parts_.stereo_now(); }

void SessionView::set_fish_tank(bool on) {
  parts_.fish_tank = on;
  parts_.renew_fish_tank();
}

std::optional<base::Vector2> SessionView::display_size() const { return parts_.settings.display_size; }

bool SessionView::is_fish_tank() const { return parts_.fish_tank; }

void SessionView::set_screen(const base::Vector2& size) {
  if (!(size.minCoeff() > 0.0) || !size.allFinite()) return;
  parts_.screen.size = size;
  parts_.renew_fish_tank();
}

bool SessionView::has_head() const { return parts_.user.has_head(); }

void SessionView::follow_head(bool follows) { parts_.user.follow_head(follows); }

void SessionView::recentre_head() { parts_.user.recentre_head(); }

void SessionView::set_navigation_mode(interaction::NavigationMode mode) { parts_.user.set_mode(mode); }

void SessionView::set_look(const DisplayWish& look) {
  parts_.look = look;
  parts_.look_is_new = true;
}

}  // namespace icome::session
