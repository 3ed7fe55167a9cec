#include "session/speech/spoken_stage.h"

#include <algorithm>

#include "base/decompositions.h"
#include "interaction/elements/element_use.h"

namespace icome::session {
namespace {

using base::Result;
using base::Vector3;
using interaction::Widget;
using speech::MenuWords;

constexpr double kRemembered = 10.0;  // s

/// The place of English among an element's languages, or of its first one.
std::size_t spoken_language(const interaction::Element& element) {
  const auto found = std::ranges::find(element.languages, "en");
  return found == element.languages.end() ? 0 : std::size_t(found - element.languages.begin());
}

void add_words(const Widget& widget, std::size_t language, std::vector<MenuWords>& words) {
  if (widget.can_be_chosen() && widget.enabled && language < widget.text.size())
    words.push_back({widget.text[language], widget.name, widget.opens_menu()});
}

/// Rows that are not seen and other pages too: they come into sight when they are chosen.
void add_items(const std::vector<Widget>& widgets, std::size_t language, std::vector<MenuWords>& words) {
  for (const Widget& widget : widgets) {
    add_words(widget, language, words);
    if (widget.enabled && !widget.opens_menu()) add_items(widget.widgets, language, words);
  }
}

/// All that open others, at any depth.
void add_submenus(const std::vector<Widget>& widgets, std::size_t language, std::vector<MenuWords>& words) {
  for (const Widget& widget : widgets) {
    if (widget.opens_menu()) add_words(widget, language, words);
    add_submenus(widget.widgets, language, words);
  }
}

}  // namespace

std::optional<speech::Pointer> SpokenStage::pointer_now() const {
  speech::Pointer pointer;
  const SessionHands& hands = session_.hands();
  if (hands.pointers() > 0 && !hands.is_mouse_driven()) {
    const PointerView& hand = hands.pointer(0);
    if (hand.status == devices::DeviceStatus::Lost) return std::nullopt;
    pointer.world_from_pointer.linear() = hand.orientation.toRotationMatrix();
    pointer.world_from_pointer.translation() = hand.scp;
    return pointer;
  }
  const auto way = hooks_.mouse();
  if (!way) return std::nullopt;
  const auto met = session_.stage().pick_seen(*way);
  const Vector3 ahead = interaction::looked_at(session_.view().now());
  const double distance = (ahead - way->origin).dot(way->direction);
  pointer.world_from_pointer.linear() =
      base::rotation_between(-Vector3::UnitZ(), way->direction).toRotationMatrix();
  pointer.world_from_pointer.translation() =
      met ? met->place.point : Vector3(way->origin + distance * way->direction);
  return pointer;
}

void SpokenStage::keep_hand(double time) {
  while (!hand_.empty() && hand_.front().time < time - kRemembered) hand_.pop_front();
  if (const auto pointer = pointer_now()) hand_.push_back({time, *pointer});
}

std::optional<speech::Pointer> SpokenStage::pointer(double time) const {
  const auto next = std::ranges::upper_bound(hand_, time, {}, &Moment::time);
  return next == hand_.begin() ? std::nullopt : std::optional(std::prev(next)->pointer);
}

speech::StageAbilities SpokenStage::abilities() const {
  return {.saves = bool(hooks_.save),
          .closes = bool(hooks_.close_design),
          .goes = true,
          .has_menu = bool(hooks_.menu),
          .has_window = true};
}

Result<void> SpokenStage::save() {
  hooks_.save();
  return {};
}

Result<void> SpokenStage::close_design() {
  hooks_.close_design();
  return {};
}

Result<void> SpokenStage::go_to(world::ObjectId id) {
  const world::PhysicalObject* const object = session_.world().find(id);
  if (object == nullptr) return base::fail("it is not there any more");
  interaction::View view = session_.view().now();
  const base::Affine3 place = world::world_from_object(session_.world(), id);
  if (object->fixture && std::holds_alternative<world::Viewpoint>(*object->fixture)) {
    const Vector3 back = place.linear().col(2).normalized();
    const Vector3 right = place.linear().col(1).cross(back).normalized();
    view.world_from_eye.linear() << right, back.cross(right), back;
    view.world_from_eye.translation() = place.translation();
    view.field = std::get<world::Viewpoint>(*object->fixture).field_of_view;
    session_.view().fly_to(interaction::usable(view));
    return {};
  }
  const base::Bounds bounds = world::bounds(session_.world(), id);
  if (bounds.isEmpty()) return base::fail("it has no place to be seen at");
  const Vector3 back = view.world_from_eye.linear().col(2), up = view.world_from_eye.linear().col(1);
  session_.view().fly_to(interaction::fitted(view, bounds, back, up, session_.view().aspect()));
  return {};
}

std::vector<MenuWords> SpokenStage::menu_items() const {
  std::vector<MenuWords> words;
  const interaction::ElementUse* const use = session_.menu().use();
  if (use == nullptr) return words;
  const std::size_t language = spoken_language(use->element());
  add_items(use->element().widgets, language, words);
  for (const Widget* const open : use->open()) add_items(open->widgets, language, words);
  return words;
}

std::vector<MenuWords> SpokenStage::submenus() const {
  std::vector<MenuWords> words;
  if (const interaction::ElementUse* const use = session_.menu().use()) {
    add_submenus(use->element().widgets, spoken_language(use->element()), words);
  } else if (hooks_.menu) {
    if (const auto menu = hooks_.menu()) add_submenus(menu->widgets, spoken_language(*menu), words);
  }
  return words;
}

Result<void> SpokenStage::open_menu(const std::string& item) {
  if (session_.menu().use() == nullptr) hooks_.open_menu();
  if (session_.menu().use() == nullptr) return base::fail("the menu does not open");
  return item.empty() ? Result<void>() : choose_item(item);
}

Result<void> SpokenStage::choose_item(const std::string& item) {
  return session_.menu().choose(item) ? Result<void>() : base::fail("that cannot be chosen now");
}

bool SpokenStage::close_menu() {
  const bool is_open = session_.menu().use() != nullptr;
  session_.menu().close();
  return is_open;
}

}  // namespace icome::session
