#pragma once
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "haptics/effects/panel.h"
#include "interaction/elements/element_frame.h"
#include "interaction/elements/element_layout.h"
#include "interaction/elements/element_settings.h"
#include "interaction/navigation.h"

namespace icome::interaction {

/// The pointer at one moment, in the frame of the element's place.
struct ElementPointer {
  double time = 0.0;  // s, never falls
  base::Vector3 tip = base::Vector3::Zero();
  bool button = false;  // is it down?
};

enum class ChosenBy : std::uint8_t { Click, Push, Key, Name, Wheel, Look };

/// A widget that was chosen.
struct Choice {
  const Widget* widget = nullptr;  // never null; the element's
  ChosenBy by = ChosenBy::Click;
};

enum class ElementKey : std::uint8_t { Up, Down, Left, Right, Enter, Escape, PageUp, PageDown, Backspace };

/// A part of a widget that is lit or held; see LaidHandle.
struct HandleName {
  HandleKind kind = HandleKind::Less;
  const Widget* of = nullptr;

  bool operator==(const HandleName&) const = default;
};

/// An element in use: what is lit, open, ticked and set, as the pointer or keys have it. Refers to the
/// element and keeps it as it was written; ticks and values are its own.
class ElementUse {
 public:
  ElementUse(const Element& element, std::size_t language, TextMeasure measure);

  /// Puts the element elsewhere, such as along with the head.
  void place(const ElementFrame& frame) { frame_ = frame; }
  const ElementFrame& frame() const { return frame_; }
  /// Keeps menus in a part of its plane, such as the picture; see ShownParts::room.
  void keep_within(const LaidBox& room);

  /// Takes the pointer; called at any rate, also once a tick. Gives what it chose, which is told once: a push
  /// counts again only when the hand has come back nearly to the plane (hysteresis). What is held, such as a
  /// ring of hues or the target that makes a number more, is chosen when it is let go.
  std::optional<Choice> point(const ElementPointer& pointer);
  /// Takes the way that the eye looks, in the frame of the element's place, and whether the button is down:
  /// the look-at menu of CHIMP (thesis 2.3.1). What is looked at lights up, and is chosen when the button is
  /// released, also if it was down at the first call already.
  std::optional<Choice> look(const Ray& gaze, bool button, double time);
  /// Lets time pass without a pointer, or with one that rests. An element that somebody attends to, such as
  /// with keys, fades in.
  void rest(double time, bool attended);
  /// The next pointer is another one: a button that it holds is no click, and it comes from anywhere. Gives
  /// what the last one held, and lets it go.
  std::optional<Choice> change_pointer();
  /// Left and Right step a Slider or Number. In a Colour they turn the hue, and then Up and Down change the
  /// value, PageUp and PageDown the saturation; Enter chooses it, Escape gives up. Elsewhere Up and Down move
  /// the light, also among rows that are not seen; on the header of a page Left and Right show the next one.
  std::optional<Choice> press(ElementKey key);
  /// Types a digit, a point or a sign into the Number that is lit; Enter sets it, Escape gives up. False: it
  /// is none of these, or no Number is lit.
  bool type(char letter);
  /// Turns a wheel: > 0 is away from the person. Where the pointer is, else where the light is, rows scroll
  /// and Sliders and Numbers are stepped.
  std::optional<Choice> turn_wheel(double notches);
  /// Shows what the world has, such as the size of what is selected: ElementSettings::set(). What is held or
  /// being typed stays.
  void show_value(const Widget& widget, const Value& value);
  /// The widget whose value is being changed: that of a Slider, Number or Colour which is held, or of a
  /// Colour which keys change; it is chosen when that ends. Null: none is.
  const Widget* changing() const;
  /// Brings a widget into sight, its page, its menu, its row, and lights it. False: there is none of that
  /// name or text, or something that it is in is disabled.
  bool show(std::string_view name_or_text);
  /// Chooses a widget by its name, or by its text in any language, as speech does, also one of a menu that is
  /// not open; nothing where there is none, or it is disabled.
  std::optional<Choice> choose(std::string_view name_or_text);

  const Element& element() const { return element_; }
  /// The rows and pages that show.
  const ShownParts& shown() const { return shown_; }
  const ElementLayout& layout() const { return layout_; }
  /// The items whose menus are open, outermost first.
  const std::vector<const Widget*>& open() const { return open_; }
  /// The widget that the pointer or a key has lit up; null: none.
  const Widget* lit() const { return lit_; }
  /// The place of the element's own sheet that is in front, of a daisy: the pointer's, or that of a key's
  /// light.
  const Vector2& front() const { return front_; }
  /// Is the pointer near an element that is open (thesis 5.7.2)?
  bool is_near() const { return near_; }
  /// The distance of a place to the nearest sheet, in the element's metres.
  double distance_to(const base::Vector3& place) const;
  double opacity() const { return opacity_; }
  /// The side of its plane on which the pointer is; Unknown where it is not over a sheet.
  haptics::PanelSide side() const { return side_; }
  bool is_checked(const Widget& widget) const { return settings_.of(widget).checked; }
  double value_of(const Widget& widget) const { return settings_.of(widget).value; }
  const ElementSettings& settings() const { return settings_; }
  /// The handle that the pointer has lit up, or holds.
  std::optional<HandleName> lit_handle() const;
  /// Does the pointer hold something, such as a ring of hues? It is held wherever the pointer goes.
  bool is_holding() const { return held_.has_value(); }
  /// Is something being typed, or a colour changed by keys? Escape gives it up.
  bool is_editing() const { return edit_.has_value(); }
  /// The digits that are being typed into a Number; null: none are.
  const std::string* typed_into(const Widget& number) const;
  /// Says in a sentence why the digits that were typed last are refused; empty: they are not.
  const std::string& trouble() const { return trouble_; }
  /// Grows where the places of widgets, or what is felt of them, have changed.
  std::uint64_t layout_revision() const { return layout_revision_; }
  /// Time for which the pointer was near, s.
  double near_seconds() const { return near_seconds_; }
  /// Times that the ground was pushed in, whether or not something could be chosen there.
  std::uint64_t pushes() const { return pushes_; }

 private:
  /// Something that is held by the button or a push.
  struct Hold {
    HandleName handle;
    ChosenBy by = ChosenBy::Click;
    double since = 0.0, next = 0.0;  // s: when it began, and of its next step
  };
  /// A Number that is typed into, or a Colour that keys change.
  struct Edit {
    const Widget* widget;
    std::string typed = {};
    Hsv before = {};
  };

  void show_chosen_rows(const std::vector<Widget>& widgets);
  bool over_sheets(const Vector2& place) const;
  void fade(double distance, double time);
  void close_when_far(double distance, double time);
  bool pushed(double depth);
  bool is_enabled(const LaidHandle& handle) const;
  const LaidHandle* handle_under(const Vector2& place) const;
  void light_under_pointer(bool is_reached);
  void light_up(const Widget* widget);
  void light_by_key(const Widget& widget);
  std::optional<Choice> press_at(const Vector2& place, ChosenBy by);
  void hold(const HandleName& handle, ChosenBy by, const Vector2& place);
  std::optional<Choice> keep_holding(const Vector2& place);
  std::optional<Choice> let_go();
  void drag(const Vector2& place);
  void repeat(double time);
  void step_handle(const HandleName& handle);
  void step_value(const Widget& widget, double steps);
  std::optional<HandleKind> held_part(const LaidWidget& laid, const Vector2& place) const;
  std::optional<Choice> choose(const Widget& widget, ChosenBy by);
  bool show(const std::vector<const Widget*>& way);
  void show_page(const Widget& page);
  void bring_into_sight(const Widget& widget);
  void scroll(const Widget* of, std::ptrdiff_t first);
  void open_menu(const Widget& widget);
  void close_menus(std::size_t keep);
  void lay_out_again();
  void add_reachable(const std::vector<Widget>& widgets, std::vector<const Widget*>& way) const;
  std::vector<const Widget*> reachable() const;
  void move_light(std::ptrdiff_t by, bool goes_round = true);
  std::size_t rows_in_sight() const;
  std::optional<Choice> press_aside(bool right);
  std::optional<Choice> go_aside(bool onward);
  std::optional<Choice> press_page(bool onward);
  std::optional<Choice> choose_first(bool Widget::*which);
  std::optional<Choice> press_in_edit(ElementKey key, bool& used);
  std::optional<Choice> set_typed();
  void edit(const Widget& widget);
  void give_up_edit();
  void change_colour(const Widget& widget, ElementKey key);

  const Element& element_;
  TextMeasure measure_;
  ElementFrame frame_;
  ElementLayout layout_;
  std::vector<const Widget*> open_;
  ElementSettings settings_;
  ShownParts shown_;
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
  Vector2 front_ = Vector2::Zero();
  haptics::PanelSide side_ = haptics::PanelSide::Unknown;
  bool armed_ = true;                          // may a push count?
  std::optional<Vector2> pointed_place_ = {};  // where the pointer was near the last time
  std::optional<HandleName> lit_handle_ = {};  // by the pointer
  std::optional<Hold> held_ = {};
  std::optional<Edit> edit_ = {};
  std::string trouble_ = {};
  double wheel_ = 0.0;  // notches or rows that are not whole yet
  std::uint64_t layout_revision_ = 0;
  std::uint64_t pushes_ = 0;
};

/// The widget of that name, in any depth; null where there is none.
const Widget* find_widget(const std::vector<Widget>& widgets, std::string_view name);

}  // namespace icome::interaction
