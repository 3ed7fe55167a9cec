#include "interaction/elements/element_use.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <unordered_map>
#include <utility>

#include "interaction/elements/element_feel.h"

namespace icome::interaction {
namespace {

constexpr double kClosesAfter = 0.4;   // s, for which the pointer has been far from all menus
constexpr double kArmedShare = 0.2;    // of a push: the hand must come back so far for another
constexpr double kSliderShare = 0.05;  // of its range, by which a key moves a slider without steps
// While something is held, s.
constexpr double kRepeatsAfter = 0.4;
constexpr double kRepeatSeconds = 0.12;
constexpr double kQuickAfter = 1.0;
constexpr double kQuickSeconds = 0.03;
constexpr double kWholeCircle = 2.0 * std::numbers::pi;
constexpr double kHueStep = kWholeCircle / 72.0;  // of a key, rad
constexpr double kShadeStep = 0.05;               // of a key
constexpr std::size_t kMostTyped = 20;            // digits
constexpr std::size_t kRowsANotch = 3;            // of a wheel

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

/// Measures every text once.
TextMeasure remembering(TextMeasure measure) {
  const auto known = std::make_shared<std::unordered_map<std::string, double>>();
  return [known, measure = std::move(measure)](const std::string& text) {
    const auto found = known->find(text);
    return found != known->end() ? found->second : known->emplace(text, measure(text)).first->second;
  };
}

/// A row of a list or of a menu that scrolls, among its own.
std::ptrdiff_t place_in(const std::vector<Widget>& widgets, const Widget& widget) {
  return &widget - widgets.data();
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
      measure_(remembering(std::move(measure))),
      frame_{element.centre, element.turn},
      layout_(lay_out(element, language, measure_)),
      settings_(element),
      opacity_(element.fading.least),
      ground_(ground_of(element)) {
  show_chosen_rows(element.widgets);
}

/// Lists begin where their chosen rows are seen.
void ElementUse::show_chosen_rows(const std::vector<Widget>& widgets) {
  for (const Widget& widget : widgets) {
    const Widget* const chosen = settings_.of(widget).chosen;
    if (widget.kind == WidgetKind::List && chosen != nullptr && widget.rows > 0) {
      const std::ptrdiff_t behind = place_in(widget.widgets, *chosen) + 1 - std::ptrdiff_t(widget.rows);
      if (behind > 0) shown_.first_rows[&widget] = std::size_t(behind);
    }
    show_chosen_rows(widget.widgets);
  }
  if (&widgets == &element_.widgets && !shown_.first_rows.empty()) lay_out_again();
}

void ElementUse::keep_within(const LaidBox& room) {
  shown_.room = room;
  lay_out_again();
}

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

/// The part of a Colour or Slider that is held at that place; none: another one, or its text.
std::optional<HandleKind> ElementUse::held_part(const LaidWidget& laid, const Vector2& place) const {
  if (laid.widget->kind == WidgetKind::Slider) {
    const SliderGroove groove = groove_of(laid, element_.text_height);
    const bool is_beside = laid.leftward ? place.x() > groove.right + element_.text_height
                                         : place.x() < groove.left - element_.text_height;
    return is_beside ? std::nullopt : std::optional(HandleKind::Groove);
  }
  if (laid.widget->kind != WidgetKind::Colour) return std::nullopt;
  const auto part = wheel_of(laid, element_.text_height).part_at(place);
  if (part == ColourWheel::Part::None) return std::nullopt;
  return part == ColourWheel::Part::Ring ? HandleKind::Ring : HandleKind::Triangle;
}

void ElementUse::rest(double time, bool attended) {
  fade(attended ? 0.0 : std::numeric_limits<double>::infinity(), time);
  far_since_ = time;
  near_ = false;
  if (held_) repeat(time);
}

std::optional<Choice> ElementUse::change_pointer() {
  auto choice = held_ ? let_go() : std::nullopt;
  side_ = haptics::PanelSide::Unknown;
  button_ = true;
  pointed_at_ = nullptr;
  pointed_place_.reset();
  lit_handle_.reset();
  return choice;
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
  pointed_place_ = near_ ? std::optional(place) : std::nullopt;
  const bool clicked = pointed_ && pointer.button && !button_ && element_.choosing.by_click;
  const bool pushed_in = pushed(-front) && element_.choosing.by_push;
  pointed_ = true;
  button_ = pointer.button;
  if (held_) return keep_holding(place);
  light_under_pointer(near_ || distance <= element_.choosing.recede);
  if (!near_ || (!clicked && !pushed_in)) return std::nullopt;
  return press_at(place, clicked ? ChosenBy::Click : ChosenBy::Push);
}

bool ElementUse::is_enabled(const LaidHandle& handle) const {
  if (handle.of == nullptr || handle.of->kind == WidgetKind::Item) return true;
  return handle.of->kind == WidgetKind::List ? handle.of->enabled : settings_.is_usable(*handle.of);
}

const LaidHandle* ElementUse::handle_under(const Vector2& place) const {
  const LaidHandle* const handle = layout_.handle_at(place);
  return handle != nullptr && is_enabled(*handle) ? handle : nullptr;
}

std::optional<HandleName> ElementUse::lit_handle() const {
  return held_ ? std::optional(held_->handle) : lit_handle_;
}

/// A pointer that rests leaves the light to the keys.
void ElementUse::light_under_pointer(bool is_reached) {
  const LaidHandle* const handle = pointed_place_ ? handle_under(*pointed_place_) : nullptr;
  const LaidWidget* const under = pointed_place_ ? layout_.at(*pointed_place_) : nullptr;
  lit_handle_ = handle != nullptr ? std::optional(HandleName{handle->kind, handle->of}) : std::nullopt;
  const Widget* const now = under != nullptr && settings_.is_usable(*under->widget) ? under->widget : nullptr;
  if (std::exchange(pointed_at_, now) == now || !is_reached) return;
  // Who types need not keep the pointer where it was.
  if (now != nullptr || !edit_) light_up(now);
}

void ElementUse::light_up(const Widget* widget) {
  if (edit_ && edit_->widget != widget) give_up_edit();
  lit_ = widget;
}

std::optional<Choice> ElementUse::press_at(const Vector2& place, ChosenBy by) {
  trouble_.clear();
  if (const LaidHandle* const handle = handle_under(place)) {
    hold({handle->kind, handle->of}, by, place);
    return std::nullopt;
  }
  const LaidWidget* const under = layout_.at(place);
  if (under == nullptr || !settings_.is_usable(*under->widget)) return std::nullopt;
  const Widget& widget = *under->widget;
  if (const auto part = held_part(*under, place)) {
    hold({*part, &widget}, by, place);
    return std::nullopt;
  }
  // Its text, which sets nothing.
  if (widget.kind == WidgetKind::Colour || widget.kind == WidgetKind::Slider) return std::nullopt;
  return choose(widget, by);
}

void ElementUse::hold(const HandleName& handle, ChosenBy by, const Vector2& place) {
  if (edit_ && edit_->widget != handle.of) give_up_edit();
  edit_.reset();
  held_ = Hold{handle, by, time_, time_ + kRepeatsAfter};
  if (handle.of != nullptr && handle.of->can_be_chosen() && handle.of->kind != WidgetKind::Item)
    lit_ = handle.of;
  if (handle.kind == HandleKind::Ring) {
    Hsv& colour = settings_.of(*handle.of).colour;
    colour = with_seen_hue(colour);
  }
  const bool steps = handle.kind == HandleKind::Less || handle.kind == HandleKind::More;
  steps ? step_handle(handle) : drag(place);
}

std::optional<Choice> ElementUse::keep_holding(const Vector2& place) {
  // A push ends where the hand may push again.
  const bool is_held = held_->by == ChosenBy::Click ? button_ : !armed_;
  if (!is_held) return let_go();
  drag(place);
  repeat(time_);
  return std::nullopt;
}

std::optional<Choice> ElementUse::let_go() {
  const Widget* const set = changing();
  const Hold was = *std::exchange(held_, std::nullopt);
  return set != nullptr ? choose(*set, was.by) : std::nullopt;
}

const Widget* ElementUse::changing() const {
  const Widget* const it = held_ ? held_->handle.of : edit_ ? edit_->widget : nullptr;
  if (it == nullptr) return nullptr;
  const bool is_dragged = it->kind == WidgetKind::Slider || it->kind == WidgetKind::Number;
  return it->kind == WidgetKind::Colour || (held_ && is_dragged) ? it : nullptr;
}

void ElementUse::show_value(const Widget& widget, const Value& value) {
  const bool is_typed = edit_ && edit_->widget == &widget;
  if (&widget == changing() || is_typed || !settings_.set(widget, value)) return;
  if (const Widget* const row = settings_.of(widget).chosen; row && widget.kind == WidgetKind::List)
    bring_into_sight(*row);
  ++layout_revision_;
}

void ElementUse::drag(const Vector2& place) {
  const auto [kind, of] = held_->handle;
  if (kind == HandleKind::Ring || kind == HandleKind::Triangle) {
    const LaidWidget* const laid = layout_.widget(*of);
    if (laid == nullptr) return;
    const ColourWheel wheel = wheel_of(*laid, element_.text_height);
    Hsv& colour = settings_.of(*of).colour;
    colour = kind == HandleKind::Ring ? wheel.with_hue_at(colour, place) : wheel.with_shade_at(colour, place);
  } else if (kind == HandleKind::Groove) {
    const LaidWidget* const laid = layout_.widget(*of);
    if (laid == nullptr) return;
    const SliderGroove groove = groove_of(*laid, element_.text_height);
    settings_.of(*of).value = within(*of, groove.value_at(*of, place.x()));
  } else if (kind == HandleKind::Bar) {
    const LaidColumn* const column = layout_.column(of);
    const LaidHandle* const bar = layout_.handle(kind, of);
    if (column == nullptr || bar == nullptr) return;
    const double share = (bar->box.centre.y() + bar->box.half.y() - place.y()) / (2.0 * bar->box.half.y());
    scroll(of, std::lround(std::clamp(share, 0.0, 1.0) * double(column->count) - 0.5 * double(column->seen)));
  }
}

/// Steps on while the pointer is on what it holds, quicker after a second.
void ElementUse::repeat(double time) {
  const auto [kind, of] = held_->handle;
  if ((kind != HandleKind::Less && kind != HandleKind::More) || time < held_->next) return;
  const LaidHandle* const handle = layout_.handle(kind, of);
  const bool is_there = handle != nullptr && pointed_place_ && handle->box.contains(*pointed_place_);
  // Also where the clock leaps.
  constexpr int kMostAtOnce = 20;
  for (int i = 0; i < kMostAtOnce && time >= held_->next; ++i) {
    if (is_there) step_handle({kind, of});
    held_->next += held_->next - held_->since < kQuickAfter ? kRepeatSeconds : kQuickSeconds;
  }
  held_->next = std::max(held_->next, time);
}

void ElementUse::step_handle(const HandleName& handle) {
  const int by = handle.kind == HandleKind::Less ? -1 : 1;
  if (handle.of != nullptr && handle.of->kind == WidgetKind::Number) return step_value(*handle.of, by);
  if (const LaidColumn* const column = layout_.column(handle.of))
    scroll(handle.of, std::ptrdiff_t(column->first) + by);
}

void ElementUse::step_value(const Widget& widget, double steps) {
  const double step = widget.step > 0.0 ? widget.step : kSliderShare * (widget.most - widget.least);
  double& value = settings_.of(widget).value;
  value = within(widget, rounded_value(value + steps * step));
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
  pointed_place_ = near_ ? std::optional(place) : std::nullopt;
  light_under_pointer(true);
  const bool was_released = std::exchange(button_, button) && !button;
  if (!near_ || !was_released) return std::nullopt;
  const auto choice = press_at(place, ChosenBy::Look);
  return held_ ? let_go() : choice;
}

std::optional<Choice> ElementUse::choose(const Widget& widget, ChosenBy by) {
  if (!settings_.is_usable(widget)) return std::nullopt;
  if (edit_ && edit_->widget != &widget) give_up_edit();
  edit_.reset();
  settings_.choose(widget);
  // The well of a hue or a value goes to where that is now.
  if (widget.kind == WidgetKind::Colour || widget.kind == WidgetKind::Slider) ++layout_revision_;
  if (widget.opens_menu()) {
    open_menu(widget);
  } else if (widget.kind == WidgetKind::Page) {
    show_page(widget);
  } else if (widget.kind == WidgetKind::Item) {
    close_menus(0);
  }
  return Choice{&widget, by};
}

std::optional<Choice> ElementUse::choose(std::string_view name_or_text) {
  const std::vector<const Widget*> way = way_to(element_.widgets, name_or_text);
  if (way.empty() || !settings_.is_usable(*way.back()) || !show(way)) return std::nullopt;
  return choose(*way.back(), ChosenBy::Name);
}

bool ElementUse::show(std::string_view name_or_text) {
  const std::vector<const Widget*> way = way_to(element_.widgets, name_or_text);
  if (!show(way)) return false;
  if (settings_.is_usable(*way.back())) light_by_key(*way.back());
  return true;
}

/// Lights a widget that is in sight, wherever the pointer is; a daisy turns to it.
void ElementUse::light_by_key(const Widget& widget) {
  light_up(&widget);
  if (const LaidWidget* const laid = layout_.widget(widget); laid != nullptr && laid->sheet == 0)
    front_ = laid->centre;
}

/// Shows what lies on the way, and the last one.
bool ElementUse::show(const std::vector<const Widget*>& way) {
  if (way.empty()) return false;
  const auto above = std::span(way).first(way.size() - 1);
  if (!std::ranges::all_of(above, &Widget::enabled)) return false;
  for (const Widget* const it : above) {
    bring_into_sight(*it);
    if (it->opens_menu()) open_menu(*it);
    if (it->kind == WidgetKind::Page) show_page(*it);
  }
  bring_into_sight(*way.back());
  return true;
}

void ElementUse::show_page(const Widget& page) {
  const Widget* const tabs = settings_.of(page).parent;
  if (tabs == nullptr || std::exchange(shown_.pages[tabs], &page) == &page) return;
  settings_.choose(page);
  lay_out_again();
}

/// Scrolls the rows of which it is one by as little as shows it.
void ElementUse::bring_into_sight(const Widget& widget) {
  const Widget* const of = settings_.of(widget).parent;
  const LaidColumn* const column = layout_.column(of);
  if (column == nullptr) return;
  const auto row = place_in(of != nullptr ? of->widgets : element_.widgets, widget);
  const auto first = std::ptrdiff_t(column->first), seen = std::ptrdiff_t(column->seen);
  scroll(of, std::clamp(first, row + 1 - seen, row));
}

/// Scrolls rows, if they can be, to where that one is the first.
void ElementUse::scroll(const Widget* of, std::ptrdiff_t first) {
  const LaidColumn* const column = layout_.column(of);
  if (column == nullptr) return;
  const auto now = std::size_t(std::clamp(first, std::ptrdiff_t(0), std::ptrdiff_t(column->last_first())));
  if (now == column->first) return;
  shown_.first_rows[of] = now;
  lay_out_again();
}

/// Opens the menu of an item; others that are open beside it close.
void ElementUse::open_menu(const Widget& widget) {
  const LaidWidget* const laid = layout_.widget(widget);
  const std::size_t depth = laid == nullptr ? 0 : laid->sheet;
  open_.resize(std::min(depth, open_.size()));
  open_.push_back(&widget);
  lay_out_again();
}

void ElementUse::close_menus(std::size_t keep) {
  if (open_.size() <= keep) return;
  open_.resize(keep);
  lay_out_again();
}

/// Menus close whose items show no more.
void ElementUse::lay_out_again() {
  layout_ = lay_out(element_, layout_.language, measure_, open_, shown_);
  open_.resize(std::min(open_.size(), layout_.sheets.size() - 1));
  ++layout_revision_;
  if (lit_ != nullptr && layout_.widget(*lit_) == nullptr) {
    if (edit_ && edit_->widget == lit_) give_up_edit();
    lit_ = pointed_at_ = nullptr;
  }
}

void ElementUse::add_reachable(const std::vector<Widget>& widgets, std::vector<const Widget*>& way) const {
  for (const Widget& widget : widgets) {
    if (settings_.is_usable(widget)) way.push_back(&widget);
    if (widget.kind == WidgetKind::List) add_reachable(widget.widgets, way);
    if (widget.kind != WidgetKind::Tabs) continue;
    const Widget* const page = settings_.of(widget).chosen;
    if (page == nullptr) continue;
    if (settings_.is_usable(*page)) way.push_back(page);
    add_reachable(page->widgets, way);
  }
}

/// All of the newest menu that keys come to, in order.
std::vector<const Widget*> ElementUse::reachable() const {
  std::vector<const Widget*> way;
  add_reachable(open_.empty() ? element_.widgets : open_.back()->widgets, way);
  return way;
}

/// Lights the next widget of the newest menu that can be chosen, going round.
void ElementUse::move_light(std::ptrdiff_t by, bool goes_round) {
  const std::vector<const Widget*> way = reachable();
  if (way.empty()) return;
  const auto found = std::ranges::find(way, lit_);
  const auto count = std::ptrdiff_t(way.size());
  std::ptrdiff_t next = by > 0 ? 0 : count - 1;
  if (found != way.end()) {
    next = found - way.begin() + by;
    next = goes_round ? (next + count) % count : std::clamp(next, std::ptrdiff_t(0), count - 1);
  }
  const Widget* const widget = way[std::size_t(next)];
  bring_into_sight(*widget);
  light_by_key(*widget);
}

/// Rows that are seen at once of those among which the light is.
std::size_t ElementUse::rows_in_sight() const {
  const LaidColumn* column = nullptr;
  if (lit_ != nullptr) column = layout_.column(settings_.of(*lit_).parent);
  return column != nullptr ? column->seen : 1;
}

/// The page beside the one whose header is lit.
std::optional<Choice> ElementUse::press_page(bool onward) {
  const std::vector<Widget>& pages = settings_.of(*lit_).parent->widgets;
  const std::ptrdiff_t step = onward ? 1 : -1, end = onward ? std::ptrdiff_t(pages.size()) : -1;
  for (auto i = place_in(pages, *lit_) + step; i != end; i += step) {
    const Widget& page = pages[std::size_t(i)];
    if (!settings_.is_usable(page)) continue;
    const auto choice = choose(page, ChosenBy::Key);
    light_up(&page);
    return choice;
  }
  return std::nullopt;
}

/// The light goes to the menu that the lit item opens, or back to the item that opened its own.
std::optional<Choice> ElementUse::press_aside(bool right) {
  if (lit_ != nullptr && (lit_->kind == WidgetKind::Slider || lit_->kind == WidgetKind::Number)) {
    step_value(*lit_, right ? 1.0 : -1.0);
    return choose(*lit_, ChosenBy::Key);
  }
  if (lit_ != nullptr && lit_->kind == WidgetKind::Colour) {
    edit(*lit_);
    change_colour(*lit_, right ? ElementKey::Right : ElementKey::Left);
    return std::nullopt;
  }
  return go_aside(right != layout_.leftward);
}

/// The light goes on as texts run, or back.
std::optional<Choice> ElementUse::go_aside(bool onward) {
  if (lit_ != nullptr && lit_->kind == WidgetKind::Page) return press_page(onward);
  if (onward && lit_ != nullptr && lit_->opens_menu()) {
    const auto choice = choose(*lit_, ChosenBy::Key);
    move_light(1);
    return choice;
  }
  if (!onward && !open_.empty()) {
    const Widget* const opener = open_.back();
    close_menus(open_.size() - 1);
    light_up(opener);
  } else if (element_.kind != ElementKind::Menu) {
    move_light(onward ? 1 : -1);
  }
  return std::nullopt;
}

std::optional<Choice> ElementUse::choose_first(bool Widget::*which) {
  const auto found = std::ranges::find(element_.widgets, true, which);
  return found == element_.widgets.end() ? std::nullopt : choose(*found, ChosenBy::Key);
}

std::optional<Choice> ElementUse::press(ElementKey key) {
  trouble_.clear();
  bool used = false;
  if (edit_ && edit_->widget == lit_)
    if (auto choice = press_in_edit(key, used); used) return choice;
  switch (key) {
    case ElementKey::Up:
    case ElementKey::Down:
      move_light(key == ElementKey::Down ? 1 : -1);
      return std::nullopt;
    case ElementKey::PageUp:
    case ElementKey::PageDown: {
      const auto by = std::ptrdiff_t(rows_in_sight());
      move_light(key == ElementKey::PageDown ? by : -by, false);
      return std::nullopt;
    }
    case ElementKey::Left:
    case ElementKey::Right:
      return press_aside(key == ElementKey::Right);
    case ElementKey::Enter:
      if (lit_ != nullptr && lit_->opens_menu()) return go_aside(true);
      if (lit_ != nullptr && lit_->kind == WidgetKind::Colour) {
        edit(*lit_);
        return std::nullopt;
      }
      return lit_ != nullptr ? choose(*lit_, ChosenBy::Key) : choose_first(&Widget::is_default);
    case ElementKey::Escape:
      if (open_.empty()) return choose_first(&Widget::is_cancel);
      close_menus(open_.size() - 1);
      return std::nullopt;
    case ElementKey::Backspace:
      return std::nullopt;
  }
  return std::nullopt;
}

void ElementUse::edit(const Widget& widget) { edit_ = Edit{&widget, {}, settings_.of(widget).colour}; }

void ElementUse::give_up_edit() {
  if (edit_->widget->kind == WidgetKind::Colour) settings_.of(*edit_->widget).colour = edit_->before;
  edit_.reset();
}

void ElementUse::change_colour(const Widget& widget, ElementKey key) {
  Hsv& colour = settings_.of(widget).colour;
  const auto changed = [](double share, bool more) {
    return std::clamp(rounded_value(share + (more ? kShadeStep : -kShadeStep)), 0.0, 1.0);
  };
  switch (key) {
    case ElementKey::Left:
    case ElementKey::Right: {
      colour = with_seen_hue(colour);
      const double hue = colour.hue + (key == ElementKey::Right ? kHueStep : -kHueStep);
      colour.hue = hue - kWholeCircle * std::floor(hue / kWholeCircle);
      return;
    }
    case ElementKey::Up:
    case ElementKey::Down:
      colour.value = changed(colour.value, key == ElementKey::Up);
      return;
    default:
      colour.saturation = changed(colour.saturation, key == ElementKey::PageUp);
  }
}

std::optional<Choice> ElementUse::press_in_edit(ElementKey key, bool& used) {
  const Widget& widget = *edit_->widget;
  const bool is_number = widget.kind == WidgetKind::Number;
  used = true;
  if (key == ElementKey::Escape) {
    give_up_edit();
    return std::nullopt;
  }
  if (key == ElementKey::Enter) return is_number ? set_typed() : choose(widget, ChosenBy::Key);
  if (key == ElementKey::Backspace) {
    if (is_number && !edit_->typed.empty()) edit_->typed.pop_back();
    return std::nullopt;
  }
  if (!is_number) {
    change_colour(widget, key);
    return std::nullopt;
  }
  give_up_edit();
  used = false;
  return std::nullopt;
}

bool ElementUse::type(char letter) {
  if (lit_ == nullptr || lit_->kind != WidgetKind::Number || !settings_.is_usable(*lit_)) return false;
  const bool is_digit = letter >= '0' && letter <= '9';
  const bool is_point = letter == '.' || letter == ',', is_sign = letter == '-' || letter == '+';
  if (!is_digit && !is_point && !is_sign) return false;
  trouble_.clear();
  if (!edit_) edit(*lit_);
  std::string& typed = edit_->typed;
  const bool fits = typed.size() < kMostTyped && (!is_sign || typed.empty()) &&
                    (!is_point || typed.find('.') == std::string::npos);
  if (fits) typed += is_point ? '.' : letter;
  return true;
}

const std::string* ElementUse::typed_into(const Widget& number) const {
  return edit_ && edit_->widget == &number && number.kind == WidgetKind::Number ? &edit_->typed : nullptr;
}

/// Sets the number that was typed. Digits that make no number in range stay, so that they can be mended.
std::optional<Choice> ElementUse::set_typed() {
  const Widget& number = *edit_->widget;
  const std::string digits = edit_->typed.starts_with('+') ? edit_->typed.substr(1) : edit_->typed;
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    trouble_ = fmt::format("{}: '{}' is no number.", number.name, edit_->typed);
    return std::nullopt;
  }
  if (value < number.least || value > number.most) {
    trouble_ = fmt::format("{}: {} is not between {} and {}{}.", number.name, number_text(value),
                           number_text(number.least), number_text(number.most),
                           number.unit.empty() ? "" : " " + number.unit);
    return std::nullopt;
  }
  settings_.of(number).value = value;
  return choose(number, ChosenBy::Key);
}

std::optional<Choice> ElementUse::turn_wheel(double notches) {
  if (held_) return std::nullopt;
  const LaidWidget* const under = pointed_place_ ? layout_.at(*pointed_place_) : nullptr;
  const Widget* const widget = under != nullptr ? under->widget : pointed_place_ ? nullptr : lit_;
  const auto whole = [&](double more) {
    wheel_ += more;
    return std::trunc(wheel_);
  };
  const bool is_number =
      widget != nullptr && (widget->kind == WidgetKind::Number || widget->kind == WidgetKind::Slider);
  if (is_number && settings_.is_usable(*widget)) {
    const double steps = whole(notches);
    wheel_ -= steps;
    if (steps == 0.0) return std::nullopt;
    if (edit_) give_up_edit();
    step_value(*widget, steps);
    return choose(*widget, ChosenBy::Wheel);
  }
  const LaidColumn* column = nullptr;
  if (pointed_place_) {
    column = layout_.column_at(*pointed_place_);
  } else if (lit_ != nullptr) {
    column = layout_.column(settings_.of(*lit_).parent);
  }
  if (column == nullptr) return std::nullopt;
  const double rows = whole(-notches * double(std::min(kRowsANotch, column->seen)));
  wheel_ -= rows;
  scroll(column->of, std::ptrdiff_t(column->first) + std::ptrdiff_t(rows));
  if (pointed_place_) light_under_pointer(true);
  return std::nullopt;
}

}  // namespace icome::interaction
