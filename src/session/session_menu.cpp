#include "session/session_menu.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "charts/lettering.h"
#include "session/session_parts.h"

namespace icome::session {
namespace {

using base::Vector2;
using base::Vector3;
using interaction::Element;
using interaction::ElementFrame;
using interaction::ElementPlace;

constexpr double kBehindHand = 0.012;  // m of the hand, from it to a menu that pops up
constexpr double kPicture = 0.24;      // m of a menu that the picture's shorter side is long
constexpr double kRoomForMenus = 2.0;  // widths of the menu, for those that open beside it

/// The clock of the ticks, s.
double menu_seconds() { return 1e-9 * double(base::steady_nanoseconds()); }

/// The heading of a pose: alpha of an element that faces it.
double heading_of(const base::Pose& pose) {
  const Vector3 right = pose.linear().col(0);
  return std::hypot(right.x(), right.z()) > 1e-9 ? std::atan2(right.z(), right.x()) : 0.0;
}

/// A frame that faces the eye of a view, at the point where it looks.
ElementFrame facing(const interaction::View& view, double size) {
  const double lean = std::asin(std::clamp(view.world_from_eye.linear()(1, 2), -1.0, 1.0));
  return {interaction::looked_at(view), heading_of(view.world_from_eye), lean, size};
}

/// Shifts a menu of that half size in the picture's plane so that all of it is seen, with room for others on
/// its right where there is some.
Vector3 kept_in_sight(const Vector3& centre, const interaction::View& view, double aspect,
                      const Vector2& half) {
  Vector3 in_eye = view.world_from_eye.inverse() * centre;
  const double depth = -in_eye.z();
  if (!(depth > 0.0)) return centre;
  const Vector2 seen = depth * interaction::half_picture(view, aspect);
  const double right =
      std::max(seen.x() - (1.0 + kRoomForMenus) * half.x(), std::min(0.0, seen.x() - half.x()));
  in_eye.x() = std::max(std::min(in_eye.x(), right), std::min(half.x() - seen.x(), 0.0));
  const double top = std::max(seen.y() - half.y(), 0.0);
  in_eye.y() = std::clamp(in_eye.y(), -top, top);
  return view.world_from_eye * in_eye;
}

/// The part of a pop-up menu's plane that the picture shows, less a margin; nothing behind the eye.
std::optional<interaction::LaidBox> seen_of(const ElementFrame& frame, const interaction::View& view,
                                            double aspect) {
  const Vector3 in_eye = view.world_from_eye.inverse() * frame.centre;
  if (!(in_eye.z() < 0.0)) return std::nullopt;
  constexpr double kShare = 0.97;
  const Vector2 seen = -in_eye.z() * interaction::half_picture(view, aspect);
  return interaction::LaidBox{-in_eye.head<2>() / frame.size, kShare * seen / frame.size};
}

}  // namespace

/// Metres of the stage for each of a menu: as the hand that uses it moves, or, with the mouse, to be read.
double SessionParts::menu_size(std::optional<std::size_t> hand) const {
  if (hand && !is_mouse(*hand)) {
    const devices::MappedDevice* const mapped = hands.mapped(*hand);
    return mapped ? mapped->mapping().scale.value_or(1.0) : 1.0;
  }
  const interaction::View& view = user.view();
  return 2.0 * view.distance * std::tan(0.5 * view.field) / kPicture;
}

/// The place of the open menu now.
ElementFrame SessionParts::menu_frame() const {
  const Element& element = menu.use()->element();
  base::Pose rest = base::Pose::Identity();
  double size = 1.0;
  switch (element.place) {
    case ElementPlace::World:
      break;
    case ElementPlace::Head:
      size = menu_size({});
      rest.translation() = interaction::looked_at(user.view());
      rest.linear() =
          base::Pose(Eigen::AngleAxisd(-heading_of(user.view().world_from_eye), Vector3::UnitY())).linear();
      break;
    case ElementPlace::Hand: {
      if (!is_hand_there(1)) return menu.use()->frame();
      size = menu_size(1);
      const base::Pose hand = stage_from_hand(1);
      rest.translation() = hand.translation();
      rest.linear() = base::Pose(Eigen::AngleAxisd(-heading_of(hand), Vector3::UnitY())).linear();
      break;
    }
    case ElementPlace::Pointer:
      return menu_pops_up;
  }
  return {rest * Vector3(size * element.centre), heading_of(rest) + element.turn, 0.0, size};
}

/// The way that the eye looks: through the middle of the picture, wherever the head has turned that.
interaction::Ray SessionParts::gaze() const {
  const base::Pose& eye = user.drawn_view().world_from_eye;
  return {eye.translation(), -eye.linear().col(2)};
}

/// Is that pointer the hand that uses the menu, and near it, or is the menu looked at? Its button is the
/// menu's then.
bool SessionParts::is_at_menu(std::size_t pointer) const {
  if (menu.use() == nullptr || !menu.use()->is_near()) return false;
  return menu.is_looked_at() || menu.hand() == pointer;
}

void SessionParts::use_menu() {
  const double now = menu_seconds();
  if (menu.use() != nullptr) {
    menu.place(menu_frame());
    std::vector<MenuTick> ticks;
    for (const PointerTick& it : hands.take_watched())
      if (!is_mouse(it.pointer) || hand_is_aimed)
        ticks.push_back({it.pointer, {double(it.time) * 1e-9, it.tip, (it.buttons & 1U) != 0}});
    for (MenuChoice& it : menu.is_looked_at() ? menu.look(gaze(), ticks, now) : menu.take(ticks, now))
      menu_chosen.push_back(std::move(it));
  }
  if (menu.follow(now)) hands.felt().publish_menu(menu.effects());
  if (menu.draw(menu_theme)) look_is_new = true;
}

/// Tells what is being changed in the menu, if that is another value than before.
void SessionParts::tell_menu_changes() {
  std::optional<MenuChoice> now = menu.changing();
  const bool is_same = now ? menu_changing && now->widget.name == menu_changing->widget.name &&
                                 now->call.arguments == menu_changing->call.arguments
                           : !menu_changing;
  if (is_same) return;
  menu_changing = std::move(now);
  for (const auto& listener : menu_change_listeners) listener(menu_changing ? &*menu_changing : nullptr);
}

void SessionParts::tell_menu_choices() {
  for (const MenuChoice& it : std::exchange(menu_chosen, {}))
    for (const auto& listener : menu_listeners) listener(it);
  tell_menu_changes();
  for (const std::string& it : std::exchange(menu_troubles, {}))
    for (const auto& listener : menu_trouble_listeners) listener(it);
}

base::Result<void> SessionMenu::open(Element element, std::string_view language, const MenuSpot& spot) {
  if (element.place == ElementPlace::Hand && !parts_.is_hand_there(1))
    return base::fail("This menu lies on the second hand, and there is none: connect another device.");
  const interaction::View& view = parts_.user.view();
  const std::size_t index = interaction::language_of(element, language);
  ElementFrame frame = facing(view, parts_.menu_size(spot.hand));
  if (spot.hand) {
    frame.centre = parts_.hands.view(*spot.hand).tip - kBehindHand * frame.size * frame.normal();
  } else {
    if (spot.way) {
      frame.centre = spot.way->origin + spot.distance * spot.way->direction;
      frame.size *= spot.distance / view.distance;
    }
    interaction::ShownParts shown;
    if (const auto seen = seen_of(frame, view, parts_.aspect))
      shown.room = interaction::LaidBox{Vector2::Zero(), seen->half};
    const auto laid = interaction::lay_out(element, index, charts::line_width, {}, shown);
    frame.centre = kept_in_sight(frame.centre, view, parts_.aspect, frame.size * laid.sheets.front().half);
  }
  parts_.menu_pops_up = frame;
  parts_.menu.open(std::move(element), index, charts::line_width, frame);
  parts_.menu.place(parts_.menu_frame());
  if (parts_.menu.use()->element().place == ElementPlace::Pointer)
    if (const auto seen = seen_of(frame, view, parts_.aspect)) parts_.menu.keep_within(*seen);
  (void)parts_.hands.take_watched();
  parts_.hands.watch(true);
  return {};
}

void SessionMenu::close() {
  parts_.menu.close();
  parts_.hands.watch(false);
}

const interaction::ElementUse* SessionMenu::use() const { return parts_.menu.use(); }

void SessionMenu::on_choice(std::function<void(const MenuChoice&)> listener) {
  parts_.menu_listeners.push_back(std::move(listener));
}

void SessionMenu::on_changing(std::function<void(const MenuChoice*)> listener) {
  parts_.menu_change_listeners.push_back(std::move(listener));
}

void SessionMenu::on_trouble(std::function<void(const std::string&)> listener) {
  parts_.menu_trouble_listeners.push_back(std::move(listener));
}

void SessionMenu::set_theme(ElementTheme theme) { parts_.menu_theme = theme; }

bool SessionMenu::point(const interaction::Ray& way, bool button) {
  if (!use() || (!parts_.menu.is_held_by_mouse() && !met_by(way))) return false;
  if (auto choice = parts_.menu.point_by_mouse(way, button, menu_seconds()))
    parts_.menu_chosen.push_back(std::move(*choice));
  return true;
}

std::optional<Vector3> SessionMenu::met_by(const interaction::Ray& way) const {
  return use() ? parts_.menu.met_by(way) : std::nullopt;
}

void SessionMenu::press(interaction::ElementKey key) {
  if (!use()) return;
  if (auto choice = parts_.menu.press(key)) parts_.menu_chosen.push_back(std::move(*choice));
  if (!use()->trouble().empty()) parts_.menu_troubles.push_back(use()->trouble());
}

bool SessionMenu::type(char letter) { return use() && parts_.menu.type(letter); }

bool SessionMenu::turn_wheel(const interaction::Ray& way, double notches) {
  if (!met_by(way)) return false;
  if (auto choice = parts_.menu.turn_wheel(notches)) parts_.menu_chosen.push_back(std::move(*choice));
  return true;
}

bool SessionMenu::choose(std::string_view name_or_text) {
  if (!use()) return false;
  auto choice = parts_.menu.choose(name_or_text);
  if (!choice) return false;
  parts_.menu_chosen.push_back(std::move(*choice));
  return true;
}

void SessionMenu::enable(const std::function<std::optional<bool>(const interaction::Widget&)>& is_enabled) {
  if (use()) parts_.menu.enable(is_enabled);
}

void SessionMenu::show_values(const std::function<interaction::Value(const interaction::Widget&)>& value_of) {
  if (use()) parts_.menu.show_values(value_of);
}

}  // namespace icome::session
