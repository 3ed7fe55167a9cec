#include "ui/tools/scene_tools.h"

#include <algorithm>
#include <utility>

namespace icome::ui {

using base::Vector3;

SceneTools::SceneTools(session::Session& session, Listener listener)
    : session_(session),
      listener_(std::move(listener)),
      move_tool_(session, [this](const std::string& why) { listener_.refused(why); }),
      part_tool_(session, [this](const std::string& why) { listener_.refused(why); }),
      touch_tool_(session),
      shape_tool_(session, [this](const std::string& why) { listener_.refused(why); }),
      view_drag_(session) {
  session_.on_change([this](const world::Changes* changes) {
    if (changes) return;
    move_tool_.drop();
    part_tool_.drop();
    shape_tool_.drop();
  });
}

void SceneTools::choose(Tool tool) {
  if (tool == tool_ || stays_) return;
  finish();
  tool_ = tool;
  if (tool_ == Tool::Touch) {
    touch_tool_.enter(size_);
  } else {
    touch_tool_.leave();
  }
  tool_ == Tool::Shape ? shape_tool_.enter() : shape_tool_.leave();
  listener_.chosen(tool_);
}

void SceneTools::stay_with(Tool tool) {
  choose(tool);
  stays_ = true;
}

std::optional<ViewMove> SceneTools::view_move(const SceneInput& input) const {
  if (stays_) return std::nullopt;
  const bool shift = input.modifiers & Qt::ShiftModifier;
  if (input.button == Qt::RightButton) return shift ? ViewMove::Pan : ViewMove::Orbit;
  if (input.button == Qt::MiddleButton) return ViewMove::Pan;
  if (input.button != Qt::LeftButton || tool_ != Tool::View) return std::nullopt;
  if (input.modifiers & Qt::ControlModifier) return ViewMove::Look;
  return shift ? ViewMove::Pan : ViewMove::Orbit;
}

void SceneTools::press(const SceneInput& input) {
  mouse_ = input;
  if (view_drag_.active() || busy()) return;  // a second button does not disturb the first
  if (input.button == Qt::LeftButton && tool_ != Tool::Touch) {
    presses_menu_ = true;
    if (point_at_menu(input)) return;
    presses_menu_ = false;
  }
  if (const auto how = view_move(input)) {
    view_drag_.begin(*how, input);
    view_button_ = input.button;
  } else if (input.button == Qt::LeftButton && tool_ == Tool::Select) {
    if (!part_tool_.press(input)) move_tool_.press(input);
  } else if (input.button == Qt::LeftButton && tool_ == Tool::Shape) {
    shape_tool_.press(input);
  } else if (input.button == Qt::LeftButton) {
    touch_tool_.follow(input);
    touch_tool_.press(TouchTool::kButton);
  }
}

void SceneTools::move(const SceneInput& input) {
  mouse_ = input;
  if (!view_drag_.active() && !busy() && point_at_menu(input)) return;
  view_drag_.follow(input);
  move_tool_.follow(input);
  part_tool_.follow(input);
  if (tool_ == Tool::Shape) shape_tool_.follow(input);
  if (!view_drag_.active()) touch_tool_.follow(input);
}

void SceneTools::release(const SceneInput& input) {
  mouse_ = input;
  if (input.button == Qt::LeftButton && std::exchange(presses_menu_, false)) {
    point_at_menu(input);
    return;
  }
  if (view_drag_.active() && input.button == view_button_) {
    view_drag_.follow(input);
    view_drag_.end();
    if (view_button_ == Qt::RightButton && !view_drag_.moved())
      listener_.asked(input.in_window.value_or(input.at));
  } else if (input.button == Qt::LeftButton) {
    if (const auto click = part_tool_.release(input)) move_tool_.press(*click);
    move_tool_.release(input);
    shape_tool_.release(input);
    touch_tool_.press(0.0);
  }
}

void SceneTools::double_click(const SceneInput& input) {
  const bool is_on_menu = session_.menu().met_by(input.ray(session_.view())).has_value();
  if (input.button != Qt::LeftButton || tool_ == Tool::Touch || is_on_menu) {
    press(input);
    return;
  }
  finish();
  if (const auto picked = session_.stage().pick_seen(input.ray(session_.view())))
    zoom_to(session_, picked->object, input.aspect());
}

void SceneTools::wheel(const SceneInput& input, double notches) {
  // A hand that the mouse leads goes away and comes back by the wheel, also before a menu.
  if (tool_ != Tool::Touch && session_.menu().turn_wheel(input.ray(session_.view()), notches)) return;
  if (tool_ == Tool::Touch && (touch_tool_.pressing() || touch_tool_.goes_freely())) {
    touch_tool_.turn_wheel(notches);
  } else if (!stays_) {
    zoom_at(session_, input, notches);
  }
}

bool SceneTools::pen(const SceneInput& input, double pressure) {
  if (tool_ != Tool::Touch) return false;
  mouse_ = input;
  touch_tool_.follow(input);
  touch_tool_.press(pressure);
  return true;
}

/// Is the mouse on the haptic menu, and not a hand's? The menu follows it then.
bool SceneTools::point_at_menu(const SceneInput& input) {
  return tool_ != Tool::Touch && session_.menu().point(input.ray(session_.view()), presses_menu_);
}

/// How far from the eye a menu at that place of the picture is before all that is around there, m.
double SceneTools::distance_before_things(const SceneInput& at) const {
  constexpr double kBefore = 0.8;  // of the way to the nearest thing
  constexpr double kAround = 0.4;  // of the picture's shorter side, to each side of the place
  constexpr int kSteps = 3;        // to each side
  const interaction::View& view = session_.view().now();
  double distance = view.distance;
  for (int x = -kSteps; x <= kSteps; ++x)
    for (int y = -kSteps; y <= kSteps; ++y) {
      SceneInput beside = at;
      beside.at += kAround / kSteps * at.shorter_side() * QPointF(x, y);
      if (const auto picked = session_.stage().pick(beside.ray(session_.view())))
        distance = std::min(distance, kBefore * picked->place.distance);
    }
  return distance;
}

/// Asks for the menu where the mouse is; without a mouse in the scene at the first hand.
void SceneTools::ask_for_menu() {
  session::MenuSpot spot;
  if (mouse_) {
    spot.way = mouse_->ray(session_.view());
    spot.distance = distance_before_things(*mouse_);
  } else if (session_.hands().pointers() > 0 && session_.hands().mouse() != std::size_t(0)) {
    spot.hand = 0;
  }
  listener_.menu(spot);
}

/// The second button of a stylus opens the menu there, and closes it, where it is not the clutch. A technique
/// travels with that button, and it may be the one to talk with.
void SceneTools::notice_menu_buttons() {
  constexpr int kButton = 1;
  const session::SessionHands& hands = session_.hands();
  for (std::size_t i = 0; i < std::min(hands.pointers(), menu_buttons_.size()); ++i) {
    bool down = hands.mouse() != i && (hands.pointer(i).buttons >> kButton & 1U) != 0;
    if (down) {
      const auto mapping = hands.use(i).mapping;
      down = !mapping || mapping->clutch_button != kButton;
    }
    if (down && !std::exchange(menu_buttons_[i], down) && !session_.techniques().current() &&
        !listener_.button_talks())
      listener_.menu({.hand = i});
    menu_buttons_[i] = down;
  }
}

/// The letter of a key that a number is typed with; 0: it is none.
char SceneTools::typed_letter(int key) {
  if (key >= Qt::Key_0 && key <= Qt::Key_9) return char('0' + key - Qt::Key_0);
  if (key == Qt::Key_Minus || key == Qt::Key_Plus) return key == Qt::Key_Minus ? '-' : '+';
  return key == Qt::Key_Period || key == Qt::Key_Comma ? '.' : '\0';
}

bool SceneTools::takes_key(int key, Qt::KeyboardModifiers modifiers) const {
  if (modifiers & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier)) return false;
  const auto* const menu = session_.menu().use();
  const auto* const lit = menu != nullptr ? menu->lit() : nullptr;
  if (lit == nullptr || lit->kind != interaction::WidgetKind::Number) return false;
  return key == Qt::Key_Backspace || typed_letter(key) != '\0';
}

/// A key for the haptic menu while it is open.
bool SceneTools::menu_key(int key) {
  using interaction::ElementKey;
  static constexpr std::pair<int, ElementKey> kKeys[] = {
      {Qt::Key_Up, ElementKey::Up},         {Qt::Key_Down, ElementKey::Down},
      {Qt::Key_Left, ElementKey::Left},     {Qt::Key_Right, ElementKey::Right},
      {Qt::Key_Return, ElementKey::Enter},  {Qt::Key_Enter, ElementKey::Enter},
      {Qt::Key_Escape, ElementKey::Escape}, {Qt::Key_Backspace, ElementKey::Backspace},
      {Qt::Key_PageUp, ElementKey::PageUp}, {Qt::Key_PageDown, ElementKey::PageDown}};
  if (const char letter = typed_letter(key); letter != '\0' && session_.menu().type(letter)) return true;
  const auto found = std::ranges::find(kKeys, key, &std::pair<int, ElementKey>::first);
  if (found == std::end(kKeys)) return false;
  session::SessionMenu& menu = session_.menu();
  const bool backs_out = !menu.use()->open().empty() || menu.use()->is_editing() ||
                         std::ranges::any_of(menu.use()->element().widgets, &interaction::Widget::is_cancel);
  found->second == ElementKey::Escape && !backs_out ? menu.close() : menu.press(found->second);
  return true;
}

bool SceneTools::escape() {
  if (move_tool_.busy()) {
    move_tool_.cancel();
  } else if (part_tool_.busy()) {
    part_tool_.cancel();
  } else if (shape_tool_.busy()) {
    shape_tool_.cancel();
  } else if (view_drag_.active()) {
    view_drag_.end();
  } else if (tool_ != Tool::Select) {
    choose(Tool::Select);
  } else if (!session_.selection().empty()) {
    session_.select({});
  }
  return true;
}

bool SceneTools::arrow(int key, Qt::KeyboardModifiers modifiers, bool repeats) {
  const bool shift = modifiers & Qt::ShiftModifier;
  if (tool_ == Tool::Touch) return touch_tool_.step(key, shift);
  if (tool_ == Tool::Select && !session_.selection().empty()) {
    const double step = shift ? 0.01 : 0.001;  // m
    Vector3 in_view = Vector3::Zero();
    switch (key) {
      case Qt::Key_Left:
        in_view.x() = -step;
        break;
      case Qt::Key_Right:
        in_view.x() = step;
        break;
      case Qt::Key_Up:
        in_view.y() = step;
        break;
      case Qt::Key_Down:
        in_view.y() = -step;
        break;
      case Qt::Key_PageUp:
        in_view.z() = -step;
        break;
      case Qt::Key_PageDown:
        in_view.z() = step;
        break;
      default:
        return false;
    }
    move_tool_.nudge(in_view, repeats);
    return true;
  }
  return !stays_ && step_view(session_, key, shift ? ViewMove::Pan : ViewMove::Orbit);
}

bool SceneTools::key_press(int key, Qt::KeyboardModifiers modifiers, bool repeats) {
  if (modifiers & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier)) return false;
  if (!stays_ && session_.menu().use() != nullptr && menu_key(key)) return true;
  switch (key) {
    case Qt::Key_Escape:
      return escape();
    case Qt::Key_X:
      keep_to(0);
      return true;
    case Qt::Key_Y:
      keep_to(1);
      return true;
    case Qt::Key_Z:
      keep_to(2);
      return true;
    case Qt::Key_Tab:
      choose(Tool((int(tool_) + 1) % kToolCount));
      return true;
    case Qt::Key_Backtab:
      choose(Tool((int(tool_) + kToolCount - 1) % kToolCount));
      return true;
    case Qt::Key_Space:
      if (!stays_) {
        if (!repeats && !busy()) ask_for_menu();
        return true;
      }
      [[fallthrough]];
    case Qt::Key_Return:
    case Qt::Key_Enter:
      if (tool_ == Tool::Touch) touch_tool_.press(TouchTool::kButton);
      return tool_ == Tool::Touch;
    default:
      return arrow(key, modifiers, repeats);
  }
}

bool SceneTools::key_release(int key) {
  switch (key) {
    case Qt::Key_X:
    case Qt::Key_Y:
    case Qt::Key_Z:
      if (move_tool_.axis() == key - Qt::Key_X) keep_to(std::nullopt);
      return true;
    case Qt::Key_Space:
      if (!stays_) return true;
      [[fallthrough]];
    case Qt::Key_Return:
    case Qt::Key_Enter:
      touch_tool_.press(0.0);
      return tool_ == Tool::Touch;
    default:
      return false;
  }
}

void SceneTools::keep_to(std::optional<int> axis) {
  move_tool_.keep_to(axis);
  part_tool_.keep_to(axis);
  shape_tool_.keep_to(axis);
}

void SceneTools::forget_keys() {
  keep_to(std::nullopt);
  touch_tool_.press(0.0);
}

void SceneTools::leave() {
  mouse_.reset();
  hovered_.reset();
  part_tool_.hover(std::nullopt);
  shape_tool_.forget_mouse();
}

void SceneTools::resize(const QSizeF& size) {
  if (size.width() > 0.0 && size.height() > 0.0) scene_size_ = size;
  size_ = eye_size(scene_size_, session_.view().stereo());
}

void SceneTools::look_for_hovered() {
  hovered_.reset();
  const bool looks = mouse_ && !view_drag_.active() && !busy() && !presses_menu_ &&
                     !session_.menu().met_by(mouse_->ray(session_.view()));
  const bool sees_parts = looks && tool_ == Tool::Select;
  if (part_tool_.hover(sees_parts ? mouse_ : std::nullopt) || !looks) return;
  if (tool_ == Tool::Touch) {
    hovered_ = session_.hands().touched(session_.hands().mouse().value_or(0));
  } else if (const auto picked = session_.stage().pick_seen(mouse_->ray(session_.view()))) {
    hovered_ = picked->object;
  }
}

void SceneTools::tick() {
  resize(scene_size_);  // the picture of an eye may have another size now
  if (!stays_) notice_menu_buttons();
  move_tool_.tick();
  part_tool_.tick();
  touch_tool_.tick();
  shape_tool_.tick();
  look_for_hovered();
}

std::optional<interaction::Ray> SceneTools::mouse_way() const {
  return mouse_ ? std::optional(mouse_->ray(session_.view())) : std::nullopt;
}

std::string SceneTools::drag_words() const {
  std::string words = part_tool_.words();
  return words.empty() ? move_tool_.words() : words;
}

void SceneTools::finish() {
  move_tool_.finish();
  part_tool_.finish();
  shape_tool_.finish();
  view_drag_.end();
  touch_tool_.press(0.0);
}

}  // namespace icome::ui
