#include "interaction/elements/element_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace icome::interaction {
namespace {

// In heights of a capital letter.
constexpr double kRow = 2.4;         // height of a row
constexpr double kBold = 1.15;       // times as wide are the bold letters of titles
constexpr double kPadding = 0.9;     // from the border to text
constexpr double kIconRoom = 2.2;    // for a square before the text
constexpr double kMarkRoom = 2.0;    // for a tick before it
constexpr double kArrowRoom = 1.6;   // for the arrow of a menu behind it
constexpr double kSeparator = 0.8;   // height of a separator
constexpr double kSliderRoom = 9.0;  // least width of a groove
constexpr double kGap = 0.5;         // between buttons, and between an item and its menu
constexpr double kLine = 1.7;        // height of a line of words
constexpr double kRoom = 0.4;        // above and below the rows of a menu, and the words of a dialog

const std::string& text_of(const Widget& widget, std::size_t language) {
  return language < widget.text.size() && !widget.text[language].empty() ? widget.text[language]
                                                                         : widget.name;
}

bool has_mark(const Widget& widget) {
  return widget.kind == WidgetKind::Check || widget.kind == WidgetKind::Radio;
}

/// Breaks text between words where it would be wider than `most`.
std::vector<std::string> broken(const std::string& text, double most, const TextMeasure& measure) {
  std::vector<std::string> lines(1);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::string word = text.substr(at, end - at);
    std::string& line = lines.back();
    std::string longer = line.empty() ? word : line + ' ' + word;
    if (line.empty() || measure(longer) <= most) {
      line = std::move(longer);
    } else {
      lines.push_back(word);
    }
    if (end < text.size() && text[end] == '\n') lines.emplace_back();
    at = end + 1;
  }
  return lines;
}

class Arranger {
 public:
  Arranger(const Element& element, std::size_t language, const TextMeasure& measure, ElementLayout& layout)
      : element_(element),
        language_(language),
        measure_(measure),
        layout_(layout),
        unit_(element.text_height) {}

  void arrange_element() {
    switch (element_.kind) {
      case ElementKind::Menu:
        return arrange_column(element_.widgets, nullptr, title(), Vector2::Zero());
      case ElementKind::Toolbar:
        return arrange_grid();
      case ElementKind::Dialog:
        return arrange_dialog();
      case ElementKind::Ring:
        return arrange_ring();
      case ElementKind::Pie:
        return arrange_pie();
      case ElementKind::Daisy:
        return arrange_daisy();
    }
  }

  /// The menu of an item that is laid out, to its right, its first row beside the item.
  void arrange_menu(const Widget& opener) {
    const auto found = std::ranges::find(layout_.widgets, &opener, &LaidWidget::widget);
    if (found == layout_.widgets.end()) return;
    const LaidSheet& sheet = layout_.sheets[found->sheet];
    const Vector2 corner(
        std::max(sheet.centre.x() + sheet.half.x(), found->centre.x() + found->half.x()) + kGap * unit_,
        found->centre.y() + found->half.y());
    const std::size_t first = layout_.widgets.size();
    arrange_column(opener.widgets, &opener, "", Vector2::Zero());
    LaidSheet& menu = layout_.sheets.back();
    const Vector2 shift = corner + Vector2(menu.half.x(), -menu.half.y()) - menu.centre;
    menu.centre += shift;
    for (std::size_t i = first; i < layout_.widgets.size(); ++i) layout_.widgets[i].centre += shift;
  }

 private:
  std::string title() const {
    return language_ < element_.title.size() ? element_.title[language_] : std::string();
  }
  double width_of(const std::string& text) const { return measure_(text) * unit_; }

  double width_of(const Widget& widget, bool marks, bool icons) const {
    if (widget.kind == WidgetKind::Separator) return 0.0;
    double width = width_of(text_of(widget, language_)) + 2.0 * kPadding * unit_;
    if (marks) width += kMarkRoom * unit_;
    if (icons) width += kIconRoom * unit_;
    if (!widget.widgets.empty()) width += kArrowRoom * unit_;
    if (widget.kind == WidgetKind::Slider) width += kSliderRoom * unit_;
    return width;
  }

  LaidWidget& add(const Widget& widget, const Vector2& centre, const Vector2& half) {
    return layout_.widgets.emplace_back(
        LaidWidget{&widget, layout_.sheets.size() - 1, centre, half, {}, {text_of(widget, language_)}});
  }

  void add_sheet(const Widget* opened_by, const Vector2& centre, const Vector2& half,
                 const std::string& title) {
    layout_.sheets.push_back({opened_by, centre, half, title, title.empty() ? 0.0 : kRow * unit_});
  }

  void arrange_column(const std::vector<Widget>& widgets, const Widget* opened_by, const std::string& title,
                      const Vector2& centre) {
    const bool marks = std::ranges::any_of(widgets, has_mark);
    const bool icons = std::ranges::any_of(widgets, [](const Widget& it) { return !it.icon.empty(); });
    const auto height_of = [&](const Widget& widget) {
      return (widget.kind == WidgetKind::Separator ? kSeparator : kRow) * unit_;
    };
    double width = title.empty() ? 0.0 : kBold * width_of(title) + 2.0 * kPadding * unit_;
    double height = (title.empty() ? 0.0 : kRow * unit_) + 2.0 * kRoom * unit_;
    for (const Widget& widget : widgets) {
      width = std::max(width, width_of(widget, marks, icons));
      height += height_of(widget);
    }
    add_sheet(opened_by, centre, 0.5 * Vector2(width, height), title);
    double top = centre.y() + 0.5 * height - layout_.sheets.back().title_height - kRoom * unit_;
    for (const Widget& widget : widgets) {
      const double own = height_of(widget);
      add(widget, {centre.x(), top - 0.5 * own}, 0.5 * Vector2(width, own));
      top -= own;
    }
  }

  void arrange_grid() {
    const std::size_t count = element_.widgets.size();
    const std::size_t columns =
        element_.columns == 0 ? count : std::min<std::size_t>(element_.columns, count);
    const std::size_t rows = (count + columns - 1) / columns;
    double width = 0.0;
    for (const Widget& widget : element_.widgets)
      width = std::max(width, width_of(widget, has_mark(widget), !widget.icon.empty()));
    const double height = (kRow + kPadding) * unit_, gap = kGap * unit_;
    const Vector2 cell(width + gap, height + gap);
    const double head = title().empty() ? 0.0 : kRow * unit_;
    const double whole =
        std::max(double(columns) * cell.x() + gap, kBold * width_of(title()) + 2.0 * kPadding * unit_);
    const Vector2 half = 0.5 * Vector2(whole, double(rows) * cell.y() + gap + head);
    add_sheet(nullptr, Vector2::Zero(), half, title());
    for (std::size_t i = 0; i < count; ++i) {
      const double x = (double(i % columns) - 0.5 * double(columns - 1)) * cell.x();
      const double y = half.y() - head - gap - (double(i / columns) + 0.5) * cell.y() + 0.5 * gap;
      add(element_.widgets[i], {x, y}, 0.5 * Vector2(width, height));
    }
  }

  /// Words below each other, then buttons beside each other.
  void arrange_dialog() {
    const double gap = kGap * unit_, row = kRow * unit_;
    double width = kBold * width_of(title()) + 2.0 * kPadding * unit_,
           height = (title().empty() ? 0.0 : row) + kRoom * unit_;
    double buttons = gap;
    std::vector<std::vector<std::string>> words;
    for (const Widget& widget : element_.widgets) {
      const bool is_button = widget.kind == WidgetKind::Item;
      words.push_back(broken(text_of(widget, language_), element_.width / unit_, measure_));
      double widest = 0.0;
      for (const std::string& line : words.back()) widest = std::max(widest, width_of(line));
      if (is_button) {
        buttons += width_of(widget, false, !widget.icon.empty()) + gap;
      } else {
        width = std::max({width, widest + 2.0 * kPadding * unit_, width_of(widget, has_mark(widget), false)});
        height += widget.kind == WidgetKind::Label ? double(words.back().size()) * kLine * unit_ + gap : row;
      }
    }
    const bool any_button = buttons > gap;
    width = std::max(width, buttons);
    if (any_button) height += row + 2.0 * gap;
    add_sheet(nullptr, Vector2::Zero(), 0.5 * Vector2(width, height), title());
    place_dialog(words, Vector2(width, height), buttons);
  }

  void place_dialog(const std::vector<std::vector<std::string>>& words, const Vector2& size, double buttons) {
    const double gap = kGap * unit_, row = kRow * unit_;
    double top = 0.5 * size.y() - layout_.sheets.back().title_height - kRoom * unit_;
    double left = 0.5 * size.x() - buttons + gap;
    for (std::size_t i = 0; i < element_.widgets.size(); ++i) {
      const Widget& widget = element_.widgets[i];
      if (widget.kind == WidgetKind::Item) {
        const double width = width_of(widget, false, !widget.icon.empty());
        add(widget, {left + 0.5 * width, -0.5 * size.y() + gap + 0.5 * row}, 0.5 * Vector2(width, row));
        left += width + gap;
        continue;
      }
      const bool is_label = widget.kind == WidgetKind::Label;
      const double height = is_label ? double(words[i].size()) * kLine * unit_ + gap : row;
      LaidWidget& laid = add(widget, {0.0, top - 0.5 * height}, 0.5 * Vector2(size.x(), height));
      if (is_label) laid.lines = words[i];
      top -= height;
    }
  }

  /// The size of the largest item, for those round a middle.
  Vector2 largest() const {
    double width = 0.0;
    for (const Widget& widget : element_.widgets)
      width = std::max(width, width_of(widget, has_mark(widget), !widget.icon.empty()));
    return {width, kRow * unit_};
  }

  static Vector2 clockwise(double angle) { return {std::sin(angle), std::cos(angle)}; }

  /// A radius, at least that, on which `count` rectangles round a circle keep apart from each other and from
  /// a rectangle in the middle: the least for as many as people choose from, else one on which even their
  /// diagonals fit between neighbours.
  double ring_radius(const Vector2& size, const Vector2& middle_half, std::size_t count, double least) const {
    constexpr std::size_t kMostTried = 64;
    const Vector2 apart = size + Vector2::Constant(kGap * unit_);
    const double step = 2.0 * std::numbers::pi / double(count);
    if (count > kMostTried)
      return std::max({least, 0.5 * apart.norm() / std::sin(0.5 * step), (0.5 * apart + middle_half).norm()});
    const auto clear = [](const Vector2& between, const Vector2& room) {
      return (between.cwiseAbs().array() >= room.array()).any();
    };
    const auto fits = [&](double radius) {
      for (std::size_t a = 0; a < count; ++a) {
        const Vector2 place = radius * clockwise(step * double(a));
        if (!clear(place, 0.5 * apart + middle_half)) return false;
        for (std::size_t b = a + 1; b < count; ++b)
          if (!clear(place - radius * clockwise(step * double(b)), apart)) return false;
      }
      return true;
    };
    double radius = std::max(least, size.y());
    while (!fits(radius)) radius *= 1.02;
    return radius;
  }

  /// Half the size of a title that stands in the middle; 0 without one.
  Vector2 middle_title() const {
    if (title().empty()) return Vector2::Zero();
    return 0.5 * Vector2(kBold * width_of(title()) + kPadding * unit_, kRow * unit_);
  }

  void arrange_ring(double least_radius = 0.0) {
    const Vector2 size = largest(), middle = middle_title();
    const std::size_t count = element_.widgets.size();
    const double radius = ring_radius(size, middle, count, least_radius);
    const Vector2 half = Vector2::Constant(radius) + 0.5 * size + Vector2::Constant(kGap * unit_);
    layout_.sheets.push_back({nullptr, Vector2::Zero(), half, title(), 0.0, middle});
    for (std::size_t i = 0; i < count; ++i)
      add(element_.widgets[i], radius * clockwise(2.0 * std::numbers::pi * double(i) / double(count)),
          0.5 * size);
  }

  void arrange_pie() {
    const double inner = std::max(kRow * unit_, middle_title().norm());
    arrange_ring(inner + 0.5 * largest().norm());
    const double step = 2.0 * std::numbers::pi / double(element_.widgets.size());
    LaidSheet& sheet = layout_.sheets.back();
    sheet.half = Vector2::Constant(sheet.half.maxCoeff());
    for (std::size_t i = 0; i < layout_.widgets.size(); ++i) {
      const double middle = step * double(i);
      layout_.widgets[i].sector = Sector{middle - 0.5 * step, middle + 0.5 * step, inner, sheet.half.x()};
    }
  }

  void arrange_daisy() {
    const Vector2 size = largest();
    const Vector2 tile = size + Vector2::Constant(kGap * unit_);
    const DaisyLayout daisy = daisy_layout(element_.widgets.size(), tile, element_.radius);
    Vector2 half = Vector2::Constant(daisy.radius);
    for (const Vector2& place : daisy.places) half = half.cwiseMax(place.cwiseAbs() + 0.5 * tile);
    LaidSheet& sheet = layout_.sheets.emplace_back(LaidSheet{nullptr, Vector2::Zero(), half, title(), 0.0});
    sheet.title_half = middle_title();
    sheet.sphere = DaisySphere{daisy.radius, element_.cone};
    for (std::size_t i = 0; i < daisy.places.size(); ++i)
      add(element_.widgets[i], daisy.places[i], 0.5 * size);
  }

  const Element& element_;
  std::size_t language_;
  const TextMeasure& measure_;
  ElementLayout& layout_;
  double unit_;
};

}  // namespace

bool Sector::contains(const Vector2& from_middle) const {
  const double r = from_middle.norm();
  if (r < inner || r > outer) return false;
  const double angle = std::atan2(from_middle.x(), from_middle.y());
  const double turn = 2.0 * std::numbers::pi;
  const double behind = angle - from;
  return behind - turn * std::floor(behind / turn) < to - from;
}

bool LaidWidget::contains(const Vector2& place) const {
  if (sector) return sector->contains(place);
  return ((place - centre).cwiseAbs().array() <= half.array()).all();
}

SliderGroove groove_of(const LaidWidget& slider, double text_height) {
  const double right = slider.centre.x() + slider.half.x() - kPadding * text_height;
  return {right - (kSliderRoom - kPadding) * text_height, right};
}

const LaidWidget* ElementLayout::at(const Vector2& place) const {
  for (std::size_t i = widgets.size(); i-- > 0;)
    if (!sheets[widgets[i].sheet].sphere && widgets[i].contains(place)) return &widgets[i];
  return sheets.empty() || !sheets.front().sphere ? nullptr : in_cone(place);
}

/// The nearest to the axis of the cone, while that place is in front.
const LaidWidget* ElementLayout::in_cone(const Vector2& front) const {
  const DaisySphere& sphere = *sheets.front().sphere;
  const LaidWidget* nearest = nullptr;
  double least = sphere.cone;
  for (const LaidWidget& it : widgets) {
    if (it.sheet != 0) continue;
    const double angle = sphere.angle_between(it.centre, front);
    if (angle > least) continue;
    least = angle;
    nearest = &it;
  }
  return nearest;
}

ElementLayout lay_out(const Element& element, std::size_t language, const TextMeasure& measure,
                      std::span<const Widget* const> open) {
  ElementLayout layout;
  layout.language = language;
  Arranger arranger(element, language, measure, layout);
  if (!element.widgets.empty()) arranger.arrange_element();
  for (const Widget* const opener : open) arranger.arrange_menu(*opener);
  return layout;
}

}  // namespace icome::interaction
