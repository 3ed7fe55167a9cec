#pragma once
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "haptics/effects/panel.h"
#include "interaction/elements/element_frame.h"
#include "interaction/elements/element_layout.h"

namespace icome::interaction {

/// The pointer at one moment, in the frame of the element's place.
struct ElementPointer {
  double time = 0.0;  // s, never falls
  base::Vector3 tip = base::Vector3::Zero();
  bool button = false;  // is it down?
};

enum class ChosenBy : std::uint8_t { Click, Push, Key, Name };

/// A widget that was chosen.
struct Choice {
  const Widget* widget = nullptr;  // never null; the element's
  ChosenBy by = ChosenBy::Click;
};

enum class ElementKey : std::uint8_t { Up, Down, Left, Right, Enter, Escape };

/// An element in use: what is lit, open, ticked and set, as the pointer or keys have it. Refers to the
/// element and keeps it as it was written; ticks and values are its own.
class ElementUse {
 public:
  ElementUse(const Element& element, std::size_t language, TextMeasure measure);

  /// Puts the element elsewhere, such as along with the head.
  void place(const ElementFrame& frame) { frame_ = frame; }
  const ElementFrame& frame() const { return frame_; }

  /// Takes the pointer; called at any rate, also once a tick. Gives what it chose, which is told once: a push
  /// counts again only when the hand has come back nearly to the plane (hysteresis).
  std::optional<Choice> point(const ElementPointer& pointer);
  /// Lets time pass without a pointer. An element that somebody attends to, such as with keys, fades in.
  void rest(double time, bool attended);
  /// The next pointer is another one: a button that it holds is no click, and it comes from anywhere.
  void change_pointer();
  std::optional<Choice> press(ElementKey key);
  /// Chooses a widget by its name, or by its text in any language, as speech does, also one of a menu that is
  /// not open; nothing where there is none, or it is disabled.
  std::optional<Choice> choose(std::string_view name_or_text);

  const Element& element() const { return element_; }
  const ElementLayout& layout() const { return layout_; }
  /// The items whose menus are open, outermost first.
  const std::vector<const Widget*>& open() const { return open_; }
  /// The widget that the pointer or a key has lit up; null: none.
  const Widget* lit() const { return lit_; }
  /// Is the pointer near an element that is open (thesis 5.7.2)?
  bool is_near() const { return near_; }
  /// The distance of a place to the nearest sheet, in the element's metres.
  double distance_to(const base::Vector3& place) const;
  double opacity() const { return opacity_; }
  /// The side of its plane on which the pointer is; Unknown where it is not over a sheet.
  haptics::PanelSide side() const { return side_; }
  bool is_checked(const Widget& widget) const;
  double value_of(const Widget& widget) const;
  /// Time for which the pointer was near, s.
  double near_seconds() const { return near_seconds_; }
  /// Times that the ground was pushed in, whether or not something could be chosen there.
  std::uint64_t pushes() const { return pushes_; }

 private:
  struct Setting {
    const Widget* widget;
    bool checked;
    double value;
  };

  void keep_settings(const std::vector<Widget>& widgets);
  const Setting* setting_of(const Widget& widget) const;
  Setting* setting_of(const Widget& widget);
  bool over_sheets(const Vector2& place) const;
  void fade(double distance, double time);
  void close_when_far(double distance, double time);
  bool pushed(double depth);
  void set_by_place(const Widget& widget, const Vector2& place);
  std::optional<Choice> choose(const Widget& widget, ChosenBy by);
  void open_menu(const Widget& widget);
  void close_menus(std::size_t keep);
  void lay_out_again();
  void move_light(int by);
  std::optional<Choice> press_aside(bool right);
  std::optional<Choice> choose_first(bool Widget::*which);

  const Element& element_;
  TextMeasure measure_;
  ElementFrame frame_;
  ElementLayout layout_;
  std::vector<const Widget*> open_;
  std::vector<Setting> settings_;
  const Widget* lit_ = nullptr;
  const Widget* pointed_at_ = nullptr;  // by the pointer, when it came there
  bool started_ = false;                // has it been told a time?
  bool pointed_ = false;                // has there been a pointer?
  bool near_ = false;
  double opacity_;
  haptics::PanelSettings ground_;
  double time_ = 0.0;          // s, of the last pointer
  double far_since_ = 0.0;     // s
  double near_seconds_ = 0.0;  // s
  bool button_ = false;
  haptics::PanelSide side_ = haptics::PanelSide::Unknown;
  bool armed_ = true;  // may a push count?
  std::uint64_t pushes_ = 0;
};

/// The widget of that name, in any depth; null where there is none.
const Widget* find_widget(const std::vector<Widget>& widgets, std::string_view name);

}  // namespace icome::interaction
