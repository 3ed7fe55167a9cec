#include "interaction/elements/element_use.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "interaction/elements/element_feel.h"

namespace icome::interaction {
namespace {

constexpr double kClosesAfter = 0.4;   // s, for which the pointer has been far from all menus
constexpr double kArmedShare = 0.2;    // of a push: the hand must come back so far for another
constexpr double kSliderShare = 0.05;  // of its range, by which a key moves a slider without steps

bool is_named(const Widget& widget, std::string_view said) {
  return widget.name == said || std::ranges::find(widget.text, said) != widget.text.end();
}

/// The way to a widget: the items that open menus down to it, and itself last; empty where there is none.
std::vector<const Widget*> way_to(const std::vector<Widget>& widgets, std::string_view said) {
  for (const Widget& widget : widgets) {
    if (is_named(widget, said)) return {&widget};
    std::vector<const Widget*> below = way_to(widget.widgets, said);
    if (below.empty()) continue;
    below.insert(below.begin(), &widget);
    return below;
  }
  return {};
}

double smooth(double x) {
  const double clamped = std::clamp(x, 0.0, 1.0);
  return clamped * clamped * (3.0 - 2.0 * clamped);
}

double stepped(const Widget& slider, double value) {
  if (slider.step > 0.0)
    value = slider.least + slider.step * std::round((value - slider.least) / slider.step);
  return std::clamp(value, slider.least, slider.most);
}

}  // namespace

const Widget* find_widget(const std::vector<Widget>& widgets, std::string_view name) {
  for (const Widget& widget : widgets) {
    if (widget.name == name) return &widget;
    if (const Widget* const below = find_widget(widget.widgets, name)) return below;
  }
  return nullptr;
}

ElementUse::ElementUse(const Element& element, std::size_t language, TextMeasure measure)
    : element_(element),
      measure_(std::move(measure)),
      frame_{element.centre, element.turn},
      layout_(lay_out(element, language, measure_)),
      opacity_(element.fading.least),
      ground_(ground_of(element)) {
  keep_settings(element.widgets);
}

void ElementUse::keep_settings(const std::vector<Widget>& widgets) {
  for (const Widget& widget : widgets) {
    settings_.push_back({&widget, widget.checked, widget.value});
    keep_settings(widget.widgets);
  }
}

const ElementUse::Setting* ElementUse::setting_of(const Widget& widget) const {
  return &*std::ranges::find(settings_, &widget, &Setting::widget);
}

ElementUse::Setting* ElementUse::setting_of(const Widget& widget) {
  return &*std::ranges::find(settings_, &widget, &Setting::widget);
}

bool ElementUse::is_checked(const Widget& widget) const { return setting_of(widget)->checked; }
double ElementUse::value_of(const Widget& widget) const { return setting_of(widget)->value; }

double ElementUse::distance_to(const base::Vector3& place) const {
  const Vector2 on_plane = frame_.projected(place);
  double aside = std::numeric_limits<double>::infinity();
  for (const LaidSheet& sheet : layout_.sheets)
    aside = std::min(aside, ((on_plane - sheet.centre).cwiseAbs() - sheet.half).cwiseMax(0.0).norm());
  return std::hypot(aside, frame_.front_distance(place));
}

/// Equation 5.6: does the projection lie in a rectangle that is slightly larger than the element?
bool ElementUse::over_sheets(const Vector2& place) const {
  return std::ranges::any_of(layout_.sheets, [&](const LaidSheet& sheet) {
    const Vector2 larger = sheet.half + Vector2::Constant(element_.choosing.margin);
    return ((place - sheet.centre).cwiseAbs().array() <= larger.array()).all();
  });
}

/// Fades on to that time.
void ElementUse::fade(double distance, double time) {
  const double dt = started_ ? std::max(0.0, time - time_) : 0.0;
  started_ = true;
  time_ = time;
  const FadingSettings& fading = element_.fading;
  const double share = smooth((fading.begins - distance) / (fading.begins - fading.opaque));
  const double aim = fading.least + (1.0 - fading.least) * share;
  opacity_ += (aim - opacity_) * (fading.seconds > 0.0 ? -std::expm1(-dt / fading.seconds) : 1.0);
}

void ElementUse::close_when_far(double distance, double time) {
  if (distance <= element_.choosing.recede) far_since_ = time;
  if (!open_.empty() && time - far_since_ > kClosesAfter) close_menus(0);
}

bool ElementUse::pushed(double depth) {
  const double needed = element_.choosing.push_depth;
  const bool from_front = side_ == haptics::PanelSide::Front;
  if (!from_front || depth < kArmedShare * needed) armed_ = true;
  if (!from_front || !armed_ || depth < needed) return false;
  armed_ = false;
  ++pushes_;
  return true;
}

void ElementUse::set_by_place(const Widget& widget, const Vector2& place) {
  if (widget.kind != WidgetKind::Slider) return;
  const auto laid = std::ranges::find(layout_.widgets, &widget, &LaidWidget::widget);
  const SliderGroove groove = groove_of(*laid, element_.text_height);
  const double share = std::clamp((place.x() - groove.left) / (groove.right - groove.left), 0.0, 1.0);
  setting_of(widget)->value = stepped(widget, widget.least + share * (widget.most - widget.least));
}

void ElementUse::rest(double time, bool attended) {
  fade(attended ? 0.0 : std::numeric_limits<double>::infinity(), time);
  far_since_ = time;
  near_ = false;
}

void ElementUse::change_pointer() {
  side_ = haptics::PanelSide::Unknown;
  button_ = true;
  pointed_at_ = nullptr;
}

std::optional<Choice> ElementUse::point(const ElementPointer& pointer) {
  if (!pointed_) far_since_ = pointer.time;
  const Vector2 place = frame_.projected(pointer.tip);
  const double front = frame_.front_distance(pointer.tip);
  const double distance = distance_to(pointer.tip);
  const bool over = over_sheets(place);
  near_ = over && std::abs(front) < element_.choosing.near;
  if (near_ && pointed_) near_seconds_ += std::max(0.0, pointer.time - time_);
  if (near_) front_ = place;
  fade(distance, pointer.time);
  close_when_far(distance, pointer.time);
  side_ = over ? haptics::next_side(side_, front, 0.0, ground_) : haptics::PanelSide::Unknown;
  const LaidWidget* const under = over ? layout_.at(place) : nullptr;
  const bool can_light =
      near_ && under != nullptr && under->widget->can_be_chosen() && under->widget->enabled;
  // A pointer that rests leaves the light to the keys.
  const Widget* const pointed_at = can_light ? under->widget : nullptr;
  const bool is_reached = near_ || distance <= element_.choosing.recede;
  if (std::exchange(pointed_at_, pointed_at) != pointed_at && is_reached) lit_ = pointed_at;
  const bool clicked = pointed_ && pointer.button && !button_ && element_.choosing.by_click;
  const bool pushed_in = pushed(-front) && element_.choosing.by_push;
  pointed_ = true;
  button_ = pointer.button;
  if (!can_light || (!clicked && !pushed_in)) return std::nullopt;
  set_by_place(*under->widget, place);
  return choose(*under->widget, clicked ? ChosenBy::Click : ChosenBy::Push);
}

std::optional<Choice> ElementUse::look(const Ray& gaze, bool button, double time) {
  const double towards = gaze.direction.dot(frame_.normal());
  const double away = towards < 0.0 ? (frame_.centre - gaze.origin).dot(frame_.normal()) / towards : -1.0;
  const Vector2 place = frame_.projected(gaze.origin + std::max(away, 0.0) * gaze.direction);
  near_ = away > 0.0 && over_sheets(place);
  if (near_) {
    front_ = place;
    if (started_) near_seconds_ += std::max(0.0, time - time_);
  }
  fade(near_ ? 0.0 : std::numeric_limits<double>::infinity(), time);
  far_since_ = time;
  const LaidWidget* const under = near_ ? layout_.at(place) : nullptr;
  const bool can_light = under != nullptr && under->widget->can_be_chosen() && under->widget->enabled;
  const Widget* const pointed_at = can_light ? under->widget : nullptr;
  if (std::exchange(pointed_at_, pointed_at) != pointed_at) lit_ = pointed_at;
  const bool was_released = std::exchange(button_, button) && !button;
  if (!can_light || !was_released) return std::nullopt;
  set_by_place(*under->widget, place);
  return choose(*under->widget, ChosenBy::Look);
}

std::optional<Choice> ElementUse::choose(const Widget& widget, ChosenBy by) {
  if (!widget.enabled || !widget.can_be_chosen()) return std::nullopt;
  Setting& setting = *setting_of(widget);
  if (widget.kind == WidgetKind::Check) setting.checked = !setting.checked;
  if (widget.kind == WidgetKind::Radio) {
    for (Setting& other : settings_)
      if (other.widget->kind == WidgetKind::Radio && other.widget->group == widget.group)
        other.checked = false;
    setting.checked = true;
  }
  if (!widget.widgets.empty()) {
    open_menu(widget);
  } else if (widget.kind == WidgetKind::Item) {
    close_menus(0);
  }
  return Choice{&widget, by};
}

std::optional<Choice> ElementUse::choose(std::string_view name_or_text) {
  const std::vector<const Widget*> way = way_to(element_.widgets, name_or_text);
  if (way.empty() || !std::ranges::all_of(way, &Widget::enabled)) return std::nullopt;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) open_menu(*way[i]);
  return choose(*way.back(), ChosenBy::Name);
}

/// Opens the menu of an item; others that are open beside it close.
void ElementUse::open_menu(const Widget& widget) {
  const auto laid = std::ranges::find(layout_.widgets, &widget, &LaidWidget::widget);
  const std::size_t depth = laid == layout_.widgets.end() ? 0 : laid->sheet;
  open_.resize(std::min(depth, open_.size()));
  open_.push_back(&widget);
  lay_out_again();
}

void ElementUse::close_menus(std::size_t keep) {
  if (open_.size() <= keep) return;
  open_.resize(keep);
  lay_out_again();
}

void ElementUse::lay_out_again() {
  layout_ = lay_out(element_, layout_.language, measure_, open_);
  const auto is_lit = [&](const LaidWidget& laid) { return laid.widget == lit_; };
  if (std::ranges::none_of(layout_.widgets, is_lit)) lit_ = pointed_at_ = nullptr;
}

/// Lights the next widget of the newest menu that can be chosen, going round.
void ElementUse::move_light(int by) {
  std::vector<const Widget*> way;
  const std::size_t sheet = layout_.sheets.size() - 1;
  for (const LaidWidget& laid : layout_.widgets)
    if (laid.sheet == sheet && laid.widget->can_be_chosen() && laid.widget->enabled)
      way.push_back(laid.widget);
  if (way.empty()) return;
  const auto found = std::ranges::find(way, lit_);
  const auto count = std::ptrdiff_t(way.size());
  std::ptrdiff_t next = by > 0 ? 0 : count - 1;
  if (found != way.end()) next = ((found - way.begin()) + by + count) % count;
  lit_ = way[std::size_t(next)];
  if (sheet == 0) front_ = std::ranges::find(layout_.widgets, lit_, &LaidWidget::widget)->centre;
}

/// The light goes to the menu that the lit item opens, or back to the item that opened its own.
std::optional<Choice> ElementUse::press_aside(bool right) {
  if (lit_ != nullptr && lit_->kind == WidgetKind::Slider) {
    const double step = lit_->step > 0.0 ? lit_->step : kSliderShare * (lit_->most - lit_->least);
    setting_of(*lit_)->value = stepped(*lit_, value_of(*lit_) + (right ? step : -step));
    return choose(*lit_, ChosenBy::Key);
  }
  if (right && lit_ != nullptr && !lit_->widgets.empty()) {
    const auto choice = choose(*lit_, ChosenBy::Key);
    move_light(1);
    return choice;
  }
  if (!right && !open_.empty()) {
    const Widget* const opener = open_.back();
    close_menus(open_.size() - 1);
    lit_ = opener;
  } else if (element_.kind != ElementKind::Menu) {
    move_light(right ? 1 : -1);
  }
  return std::nullopt;
}

std::optional<Choice> ElementUse::choose_first(bool Widget::*which) {
  const auto found = std::ranges::find(element_.widgets, true, which);
  return found == element_.widgets.end() ? std::nullopt : choose(*found, ChosenBy::Key);
}

std::optional<Choice> ElementUse::press(ElementKey key) {
  switch (key) {
    case ElementKey::Up:
    case ElementKey::Down:
      move_light(key == ElementKey::Down ? 1 : -1);
      return std::nullopt;
    case ElementKey::Left:
    case ElementKey::Right:
      return press_aside(key == ElementKey::Right);
    case ElementKey::Enter:
      if (lit_ != nullptr && !lit_->widgets.empty()) return press_aside(true);
      return lit_ != nullptr ? choose(*lit_, ChosenBy::Key) : choose_first(&Widget::is_default);
    case ElementKey::Escape:
      if (open_.empty()) return choose_first(&Widget::is_cancel);
      close_menus(open_.size() - 1);
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace icome::interaction
