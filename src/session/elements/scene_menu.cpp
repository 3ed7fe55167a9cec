#include "session/elements/scene_menu.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "world/hasher.h"

namespace icome::session {
namespace {

using interaction::Choice;
using interaction::ElementUse;
using interaction::LaidSheet;
using interaction::Widget;

constexpr double kResolution = 10'000.0;  // pixels a metre of the element: 40 for a capital of 4 mm
constexpr double kSilence = 0.1;          // s without a tick, after which a hand is gone
constexpr double kMouseShare = 0.25;      // of the near distance, at which the mouse points

void enable_widgets(std::vector<Widget>& widgets,
                    const std::function<std::optional<bool>(const Widget&)>& is_enabled, bool& changed) {
  for (Widget& widget : widgets) {
    const bool now = is_enabled(widget).value_or(widget.enabled);
    changed = std::exchange(widget.enabled, now) != now || changed;
    enable_widgets(widget.widgets, is_enabled, changed);
  }
}

void show_values_of(const std::vector<Widget>& widgets, ElementUse& use,
                    const std::function<interaction::Value(const Widget&)>& value_of) {
  for (const Widget& widget : widgets) {
    if (const interaction::Value value = value_of(widget); !value.is_null()) use.show_value(widget, value);
    show_values_of(widget.widgets, use, value_of);
  }
}

bool is_same_panel(const render::SceneOverlay::Panel& one, const render::SceneOverlay::Panel& other) {
  return one.picture == other.picture && one.alpha == other.alpha && one.at == other.at &&
         one.lying == other.lying;
}

void add_settings(const std::vector<Widget>& widgets, const ElementUse& use, world::Hasher& hasher) {
  for (const Widget& widget : widgets) {
    hasher.add(widget.enabled);
    hasher.add(use.is_checked(widget));
    hasher.add(use.value_of(widget));
    const interaction::Hsv& colour = use.settings().of(widget).colour;
    hasher.add(colour.hue);
    hasher.add(colour.saturation);
    hasher.add(colour.value);
    const Widget* const chosen = use.settings().of(widget).chosen;
    hasher.add(chosen != nullptr ? std::string_view(chosen->name) : std::string_view());
    add_settings(widget.widgets, use, hasher);
  }
}

}  // namespace

void SceneMenu::open(interaction::Element element, std::size_t language, interaction::TextMeasure measure,
                     const interaction::ElementFrame& frame) {
  close();
  element_ = std::move(element);
  use_.emplace(element_, language, std::move(measure));
  use_->place(frame);
  attended_ = element_.place == interaction::ElementPlace::Pointer;
}

void SceneMenu::close() {
  // The sheets that fade are known by widgets of the element that goes.
  sheets_.let_go();
  use_.reset();
  hand_.reset();
  presses_ = false;
}

std::optional<MenuChoice> SceneMenu::told(const std::optional<Choice>& choice) const {
  if (!choice) return std::nullopt;
  const Widget& widget = *choice->widget;
  return MenuChoice{widget, choice->by, use_->is_checked(widget), use_->value_of(widget),
                    use_->settings().call_of(widget)};
}

/// The hand that uses the menu after these ticks.
std::optional<std::size_t> SceneMenu::nearest_hand(std::span<const MenuTick> ticks) const {
  std::optional<std::size_t> nearest;
  double least = element_.choosing.recede;
  for (const MenuTick& tick : ticks) {
    const double distance = use_->distance_to(tick.at.tip);
    if (tick.hand == hand_ && distance <= element_.choosing.near) return hand_;
    if (distance > least) continue;
    least = distance;
    nearest = tick.hand;
  }
  return nearest;
}

std::vector<MenuChoice> SceneMenu::take(std::span<const MenuTick> ticks, double now) {
  std::vector<MenuChoice> chosen;
  // Whoever asks more often than the hand ticks does not take it away.
  if (ticks.empty() && hand_ && now < heard_ + kSilence) return chosen;
  if (!ticks.empty()) heard_ = ticks.back().at.time;
  if (const auto hand = nearest_hand(ticks); hand != hand_) {
    hand_ = hand;
    if (auto choice = told(use_->change_pointer())) chosen.push_back(std::move(*choice));
  }
  if (hand_) attended_ = false;
  for (const MenuTick& tick : ticks)
    if (tick.hand == hand_)
      if (auto choice = told(use_->point(tick.at))) chosen.push_back(std::move(*choice));
  if (!hand_) use_->rest(now, attended_);
  return chosen;
}

std::optional<base::Vector3> SceneMenu::plane_met_by(const interaction::Ray& way) const {
  const interaction::ElementFrame& frame = use_->frame();
  const double along = way.direction.dot(frame.normal());
  if (!(std::abs(along) > 1e-9)) return std::nullopt;
  const double distance = (frame.centre - way.origin).dot(frame.normal()) / along;
  if (!(distance > 0.0)) return std::nullopt;
  return way.origin + distance * way.direction;
}

std::optional<base::Vector3> SceneMenu::met_by(const interaction::Ray& way) const {
  const auto place = plane_met_by(way);
  if (!place) return std::nullopt;
  const base::Vector2 on_plane = use_->frame().projected(*place);
  const bool is_on_sheet = std::ranges::any_of(use_->layout().sheets, [&](const LaidSheet& sheet) {
    return ((on_plane - sheet.centre).cwiseAbs().array() <= sheet.half.array()).all();
  });
  return is_on_sheet ? place : std::nullopt;
}

std::optional<MenuChoice> SceneMenu::point_by_mouse(const interaction::Ray& way, bool button, double now) {
  if (is_looked_at()) {
    if (!met_by(way)) return std::nullopt;
    attended_ = true;
    return told(use_->look(way, presses_ = button, now));
  }
  const bool holds = is_held_by_mouse();
  const auto met = holds ? plane_met_by(way) : met_by(way);
  if (!met) {
    if (!holds || button) return std::nullopt;
    presses_ = false;
    return told(use_->change_pointer());
  }
  const interaction::ElementFrame& frame = use_->frame();
  if (!std::exchange(attended_, true)) (void)use_->change_pointer();
  hand_.reset();
  const double before = kMouseShare * element_.choosing.near * frame.size;
  interaction::ElementPointer at{now, *met + before * frame.normal(), false};
  // A press is a click also where no motion of the mouse was told before it.
  if (std::exchange(presses_, button) != button && button) (void)use_->point(at);
  at.button = button;
  return told(use_->point(at));
}

std::vector<MenuChoice> SceneMenu::look(const interaction::Ray& gaze, std::span<const MenuTick> ticks,
                                        double now) {
  const bool looks_elsewhere = gaze.origin != gaze_.origin || gaze.direction != gaze_.direction;
  gaze_ = gaze;
  if (looks_elsewhere) attended_ = false;
  std::vector<MenuChoice> chosen;
  for (const MenuTick& tick : ticks) {
    if (!hand_ && tick.at.button) hand_ = tick.hand;
    if (tick.hand != hand_ || tick.at.button == presses_) continue;
    attended_ = false;
    presses_ = tick.at.button;
    if (auto choice = told(use_->look(gaze, presses_, tick.at.time))) chosen.push_back(std::move(*choice));
  }
  if (attended_) {
    use_->rest(now, true);
  } else {
    use_->look(gaze, presses_, now);
  }
  return chosen;
}

std::optional<MenuChoice> SceneMenu::press(interaction::ElementKey key) {
  attended_ = true;
  return told(use_->press(key));
}

bool SceneMenu::type(char letter) {
  if (!use_->type(letter)) return false;
  attended_ = true;
  return true;
}

std::optional<MenuChoice> SceneMenu::turn_wheel(double notches) { return told(use_->turn_wheel(notches)); }

std::optional<MenuChoice> SceneMenu::choose(std::string_view name_or_text) {
  return told(use_->choose(name_or_text));
}

void SceneMenu::enable(const std::function<std::optional<bool>(const Widget&)>& is_enabled) {
  bool changed = false;
  enable_widgets(element_.widgets, is_enabled, changed);
  if (changed) sheets_.outdate();
}

void SceneMenu::show_values(const std::function<interaction::Value(const Widget&)>& value_of) {
  show_values_of(element_.widgets, *use_, value_of);
}

std::optional<MenuChoice> SceneMenu::changing() const {
  const Widget* const widget = use_ ? use_->changing() : nullptr;
  return widget != nullptr ? told(Choice{widget, interaction::ChosenBy::Click}) : std::nullopt;
}

/// A number for all that the pictures of the sheets show.
std::uint64_t SceneMenu::looks(ElementTheme theme) const {
  world::Hasher hasher;
  hasher.add(theme);
  for (const Widget* const open : use_->open()) hasher.add(std::string_view(open->name));
  hasher.add(use_->lit() ? std::string_view(use_->lit()->name) : std::string_view());
  add_settings(element_.widgets, *use_, hasher);
  hasher.add(use_->layout_revision());
  if (const auto handle = use_->lit_handle()) {
    hasher.add(handle->kind);
    hasher.add(handle->of != nullptr ? std::string_view(handle->of->name) : std::string_view());
  }
  hasher.add(use_->is_editing());
  hasher.add(std::string_view(use_->trouble()));
  if (const Widget* const lit = use_->lit())
    if (const std::string* const typed = use_->typed_into(*lit)) hasher.add(std::string_view(*typed));
  return hasher.value();
}

bool SceneMenu::draw(ElementTheme theme) {
  if (!use_) {
    drawn_ = 0;
    const bool had_panels = !panels_.empty();
    parts_.clear();
    panels_.clear();
    return had_panels;
  }
  const std::uint64_t now = looks(theme);
  if (std::exchange(drawn_, now) != now) {
    parts_ = draw_parts(*use_, theme, kResolution);
    mark_.picture = is_looked_at() ? std::make_shared<charts::Image>(draw_look_mark(theme)) : nullptr;
  }
  std::vector<render::SceneOverlay::Panel> placed = placed_parts(*use_, parts_);
  if (mark_.picture) placed.push_back(mark_);
  const bool changed = !std::ranges::equal(placed, panels_, is_same_panel);
  panels_ = std::move(placed);
  return changed;
}

}  // namespace icome::session
