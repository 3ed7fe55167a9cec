#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "interaction/elements/colour_wheel.h"
#include "interaction/elements/daisy.h"
#include "interaction/elements/element.h"

namespace icome::interaction {

/// Measures text: its width for capital letters of height 1.
using TextMeasure = std::function<double(const std::string& utf8)>;

/// A part of a disc round a pie's middle, clockwise from straight up.
struct Sector {
  double from = 0.0, to = 0.0;      // rad, from < to
  double inner = 0.0, outer = 0.0;  // m

  bool contains(const Vector2& from_middle) const;
};

/// A rectangle in the plane of the element: m to the right of its centre, and up.
struct LaidBox {
  Vector2 centre = Vector2::Zero();
  Vector2 half = Vector2::Zero();  // half its width and height

  bool contains(const Vector2& place) const;
};

/// A widget at its place. Lengths in the plane of the element: m to the right of its centre, and up.
struct LaidWidget {
  const Widget* widget = nullptr;  // the element's
  std::size_t sheet = 0;
  Vector2 centre = Vector2::Zero();
  Vector2 half = Vector2::Zero();  // half its width and height
  std::optional<Sector> sector = {};
  std::vector<std::string> lines = {};                // its text, broken where it must be
  bool has_mark_room = false, has_icon_room = false;  // before its text
  bool stands_alone = false;                          // has a border, as a button
  bool leftward = false;                              // begins at its right; see writes_leftward()

  bool contains(const Vector2& place) const;
};

/// The groove of a slider, m to the right of the element's centre. Values rise to the right in all languages.
struct SliderGroove {
  double left = 0.0, right = 0.0;

  /// The value that a place stands for; beyond the ends that of the end.
  double value_at(const Widget& slider, double place) const;
  double place_of(const Widget& slider, double value) const;
};
/// The groove of a laid slider in an element whose text is that high.
SliderGroove groove_of(const LaidWidget& slider, double text_height);

/// The ring and triangle of a laid Colour in an element whose text is that high.
ColourWheel wheel_of(const LaidWidget& picker, double text_height);

/// The parts of widgets that are clicked, pushed and held.
enum class HandleKind : std::uint8_t {
  Less,  // one step back: of a Number, or up among rows
  More,
  Bar,       // of rows that scroll, between the two
  Ring,      // of a Colour; see ColourWheel
  Triangle,  // of a Colour
  Groove     // of a Slider
};

/// A Less, More or Bar at its place.
struct LaidHandle {
  HandleKind kind = HandleKind::Less;
  const Widget* of = nullptr;  // the Number, the List, or the Item that opened the menu; null: the element
  std::size_t sheet = 0;
  LaidBox box = {};
};

/// Rows of which not all are seen.
struct LaidColumn {
  const Widget* of = nullptr;  // the List, or the Item that opened the menu; null: the element
  std::size_t sheet = 0;
  LaidBox box = {};  // of all, with the bar
  std::size_t first = 0, seen = 0, count = 0;

  std::size_t last_first() const { return count - seen; }
};

/// The rows of a List, or the page of Tabs.
struct LaidFrame {
  const Widget* of = nullptr;
  std::size_t sheet = 0;
  LaidBox box = {};
};

/// The rows and pages that show of an element where not all of it does.
struct ShownParts {
  /// The first row that is seen, by the List, or the Item that opens the menu; null: the element's own.
  std::unordered_map<const Widget*, std::size_t> first_rows = {};
  std::unordered_map<const Widget*, const Widget*> pages = {};  // by their Tabs
  /// Menus stay in there as far as they can: they open to the left where there is no room to the right, and
  /// scroll where they are too high. Nothing: they open to the right, whole.
  std::optional<LaidBox> room = {};

  /// The page that shows; null: there is none.
  const Widget* page_of(const Widget& tabs) const;
};

/// The ground of the element itself or of an open menu.
struct LaidSheet {
  const Widget* opened_by = nullptr;  // null: the element's own
  Vector2 centre = Vector2::Zero();
  Vector2 half = Vector2::Zero();
  std::string title = {};
  double title_height = 0.0;               // m, of its row along the upper edge; 0: none
  Vector2 title_half = Vector2::Zero();    // where it stands in the middle: half its width and height
  std::optional<DaisySphere> sphere = {};  // that is laid flat on it; of the element's own only
};

/// An element with all its widgets at their places. It refers to the element.
struct ElementLayout {
  std::vector<LaidSheet> sheets;  // the element's own first, then what is open
  std::vector<LaidWidget> widgets;
  std::vector<LaidHandle> handles;
  std::vector<LaidColumn> columns;
  std::vector<LaidFrame> frames;
  std::size_t language = 0;
  bool leftward = false;  // columns, menus and texts go from right to left

  /// The widget there, topmost sheet first; null: none. On a sphere it is the nearest in its cone.
  const LaidWidget* at(const Vector2& place) const;
  // Null: there is none.
  const LaidHandle* handle_at(const Vector2& place) const;
  const LaidColumn* column_at(const Vector2& place) const;
  const LaidWidget* widget(const Widget& widget) const;
  const LaidHandle* handle(HandleKind kind, const Widget* of) const;
  const LaidColumn* column(const Widget* of) const;

 private:
  const LaidWidget* in_cone(const Vector2& front) const;
};

/// The field of a laid Number, between its handles.
LaidBox field_of(const ElementLayout& layout, const Widget& number);
/// A value as people read and type it.
std::string number_text(double value);

/// The number of the element's language for a person who reads that one: the same or, where it has not got
/// it, its first.
std::size_t language_of(const Element& element, std::string_view language);
/// Is the language of that code ("ar", "he-IL") written from right to left?
bool writes_leftward(std::string_view language);

/// Lays the element out, in one of its languages, with the menus of `open` beside the items that open them,
/// each of which is in the menu before; those whose item does not show are left out. Nobody places anything
/// by hand: sizes follow from the text. In a language that is written from right to left, menus, toolbars and
/// dialogs are the other way round, and open to the left.
ElementLayout lay_out(const Element& element, std::size_t language, const TextMeasure& measure,
                      std::span<const Widget* const> open = {}, const ShownParts& shown = {});

}  // namespace icome::interaction
