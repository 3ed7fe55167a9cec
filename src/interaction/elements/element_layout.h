#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

/// A widget at its place. Lengths in the plane of the element: m to the right of its centre, and up.
struct LaidWidget {
  const Widget* widget = nullptr;  // the element's
  std::size_t sheet = 0;
  Vector2 centre = Vector2::Zero();
  Vector2 half = Vector2::Zero();  // half its width and height
  std::optional<Sector> sector = {};
  std::vector<std::string> lines = {};  // its text, broken where it must be

  bool contains(const Vector2& place) const;
};

/// The groove of a slider, m to the right of the element's centre.
struct SliderGroove {
  double left = 0.0, right = 0.0;
};
/// The groove of a laid slider in an element whose text is that high.
SliderGroove groove_of(const LaidWidget& slider, double text_height);

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
  std::size_t language = 0;

  /// The widget there, topmost sheet first; null: none. On a sphere it is the nearest in its cone.
  const LaidWidget* at(const Vector2& place) const;

 private:
  const LaidWidget* in_cone(const Vector2& front) const;
};

/// Lays the element out, in one of its languages, with the menus of `open` beside the items that open them,
/// each of which is in the menu before. Nobody places anything by hand: sizes follow from the text.
ElementLayout lay_out(const Element& element, std::size_t language, const TextMeasure& measure,
                      std::span<const Widget* const> open = {});

}  // namespace icome::interaction
