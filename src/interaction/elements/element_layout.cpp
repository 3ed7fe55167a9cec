#include "interaction/elements/element_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace icome::interaction {
namespace {

// In heights of a capital letter.
constexpr double kRow = 2.4;         // height of a row
constexpr double kBold = 1.15;       // times as wide are bold letters, of titles and of what is chosen
constexpr double kPadding = 0.9;     // from the border to text
constexpr double kIconRoom = 2.2;    // for a square before the text
constexpr double kMarkRoom = 2.0;    // for a tick before it
constexpr double kArrowRoom = 1.6;   // for the arrow of a menu behind it
constexpr double kSeparator = 0.8;   // height of a separator
constexpr double kSliderRoom = 9.0;  // least width of a groove
constexpr double kHandle = 2.2;      // width of what makes a number less or more, and of a bar that scrolls
constexpr double kFieldRoom = 4.0;   // least width of a field of digits
constexpr double kWheel = 15.0;      // diameter of a ring of hues
constexpr double kRingWidth = 1.9;   // of that ring
constexpr double kCodeRoom = 8.5;    // for the code and the square of a colour, behind its name
constexpr double kGap = 0.5;         // between buttons, and between an item and its menu
constexpr double kWords = 30.0;      // width at which words of a menu are broken, at least
constexpr double kLine = 1.7;        // height of a line of words
constexpr double kRoom = 0.4;        // above and below the rows of a menu, and the words of a dialog

constexpr std::uint32_t kLeastRows = 3;  // seen of a menu for which there is no room

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

/// The room before the texts of widgets below each other, and for the digits of their numbers.
struct TextRoom {
  bool marks = false, icons = false;
  double field = 0.0;  // m
};

/// Widgets below each other, of which not all need be seen.
struct Rows {
  const std::vector<Widget>& widgets;
  const Widget* of = nullptr;  // the List or the Item that opens the menu; null: the element
  std::uint32_t most = 0;      // seen; 0: all

  bool scroll() const { return most > 0 && widgets.size() > most; }
};

/// Things that lie beside each other; those round a middle have no side.
bool has_sides(ElementKind kind) {
  return kind == ElementKind::Menu || kind == ElementKind::Toolbar || kind == ElementKind::Dialog;
}

class Arranger {
 public:
  Arranger(const Element& element, std::size_t language, const TextMeasure& measure, const ShownParts& shown,
           ElementLayout& layout)
      : element_(element),
        language_(language),
        measure_(measure),
        shown_(shown),
        layout_(layout),
        unit_(element.text_height) {}

  void arrange_element() {
    switch (element_.kind) {
      case ElementKind::Menu:
        return arrange_menu_sheet(fitted({element_.widgets, nullptr, element_.rows}, title()), title(),
                                  std::nullopt);
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

  /// The menu of an item that is laid out, to its right, its first row beside the item. False: it is not.
  bool arrange_menu(const Widget& opener) {
    const LaidWidget* const found = layout_.widget(opener);
    if (found == nullptr) return false;
    const Rows rows = fitted({opener.widgets, &opener, opener.rows}, "");
    arrange_menu_sheet(rows, "", corner_beside(*found, size_of_menu(rows, "")));
    return true;
  }

 private:
  std::string title() const {
    return language_ < element_.title.size() ? element_.title[language_] : std::string();
  }
  double width_of(const std::string& text) const { return measure_(text) * unit_; }
  double width_of_title(const std::string& title) const {
    return title.empty() ? 0.0 : kBold * width_of(title) + 2.0 * kPadding * unit_;
  }

  TextRoom room_of(const Widget& widget) const {
    const bool is_number = widget.kind == WidgetKind::Number;
    return {has_mark(widget), !widget.icon.empty(), is_number ? width_of_field(widget) : 0.0};
  }

  void widen(TextRoom& room, const Widget& widget) const {
    const TextRoom own = room_of(widget);
    room.marks = room.marks || own.marks;
    room.icons = room.icons || own.icons;
    room.field = std::max(room.field, own.field);
  }

  TextRoom room_of(const std::vector<Widget>& widgets) const {
    TextRoom room;
    for (const Widget& widget : widgets) widen(room, widget);
    return room;
  }

  /// The width of a field that holds every value of a Number.
  double width_of_field(const Widget& number) const {
    const std::string behind = number.unit.empty() ? "" : " " + number.unit;
    double width = kFieldRoom * unit_;
    for (const double value : {number.least, number.most, number.value})
      width = std::max(width, width_of(number_text(value) + behind) + kPadding * unit_);
    return width;
  }

  /// The width of a widget that is one row high.
  double width_of(const Widget& widget, const TextRoom& room) const {
    if (widget.kind == WidgetKind::Separator) return 0.0;
    const bool may_be_bold = widget.kind == WidgetKind::Row || widget.kind == WidgetKind::Page;
    const double text = (may_be_bold ? kBold : 1.0) * width_of(text_of(widget, language_));
    double width = text + 2.0 * kPadding * unit_;
    if (room.marks) width += kMarkRoom * unit_;
    if (room.icons) width += kIconRoom * unit_;
    if (widget.opens_menu()) width += kArrowRoom * unit_;
    if (widget.kind == WidgetKind::Slider) width += kSliderRoom * unit_;
    if (widget.kind == WidgetKind::Number) width += 2.0 * kHandle * unit_ + room.field;
    return width;
  }

  /// The size of a widget of a column.
  Vector2 size_of(const Widget& widget, const TextRoom& room) const {
    switch (widget.kind) {
      case WidgetKind::Separator:
        return {0.0, kSeparator * unit_};
      case WidgetKind::List:
        return size_of_list(widget);
      case WidgetKind::Tabs:
        return size_of_tabs(widget);
      case WidgetKind::Label:
        return size_of_words(words_of(widget));
      case WidgetKind::Colour: {
        const double text = width_of(text_of(widget, language_)) + kCodeRoom * unit_;
        return {std::max(text, kWheel * unit_) + 2.0 * kPadding * unit_, (kRow + kWheel + kPadding) * unit_};
      }
      default:
        return {width_of(widget, room), kRow * unit_};
    }
  }

  Vector2 size_of_rows(const Rows& rows) const {
    const TextRoom room = room_of(rows.widgets);
    Vector2 size = Vector2::Zero();
    for (const Widget& widget : rows.widgets) {
      const Vector2 own = rows.scroll() ? Vector2(width_of(widget, room), 0.0) : size_of(widget, room);
      size = Vector2(std::max(size.x(), own.x()), size.y() + own.y());
    }
    if (rows.scroll()) size = Vector2(size.x() + kHandle * unit_, rows.most * kRow * unit_);
    return size;
  }

  static Rows rows_of(const Widget& list) { return {list.widgets, &list, list.rows}; }
  double heading_of(const Widget& list) const { return list.text.empty() ? 0.0 : kRow * unit_; }

  Vector2 size_of_list(const Widget& list) const {
    const Vector2 rows = size_of_rows(rows_of(list));
    const double text = list.text.empty() ? 0.0 : width_of(list, TextRoom());
    return {std::max(text, rows.x() + 2.0 * kRoom * unit_),
            heading_of(list) + rows.y() + 2.0 * kRoom * unit_};
  }

  double width_of_header(const Widget& page) const { return width_of(page, room_of(page)); }

  Vector2 size_of_tabs(const Widget& tabs) const {
    double headers = 0.0;
    Vector2 largest = Vector2::Zero();
    for (const Widget& page : tabs.widgets) {
      headers += width_of_header(page);
      largest = largest.cwiseMax(size_of_rows({page.widgets, &page}));
    }
    return {std::max(headers, largest.x()) + 2.0 * kRoom * unit_,
            kRow * unit_ + largest.y() + 3.0 * kRoom * unit_};
  }

  std::size_t sheet() const { return layout_.sheets.size() - 1; }

  LaidWidget& add(const Widget& widget, const Vector2& centre, const Vector2& half, const TextRoom& room) {
    LaidWidget laid{&widget, sheet(), centre, half, {}, {text_of(widget, language_)}};
    laid.has_mark_room = room.marks;
    laid.has_icon_room = room.icons;
    return layout_.widgets.emplace_back(std::move(laid));
  }

  void add_handle(HandleKind kind, const Widget* of, const Vector2& centre, const Vector2& half) {
    layout_.handles.push_back({kind, of, sheet(), {centre, half}});
  }

  void add_sheet(const Widget* opened_by, const Vector2& centre, const Vector2& half,
                 const std::string& title) {
    layout_.sheets.push_back({opened_by, centre, half, title, title.empty() ? 0.0 : kRow * unit_});
  }

  /// A widget that is one row high.
  LaidWidget& place_row(const Widget& widget, const Vector2& centre, const Vector2& half,
                        const TextRoom& room) {
    if (widget.kind == WidgetKind::Number) {
      const Vector2 handle(0.5 * kHandle * unit_, std::min(half.y(), 0.5 * kRow * unit_));
      const double right = centre.x() + half.x() - handle.x();
      const double left = right - room.field - 2.0 * handle.x();
      add_handle(HandleKind::Less, &widget, {left, centre.y()}, handle);
      add_handle(HandleKind::More, &widget, {right, centre.y()}, handle);
    }
    return add(widget, centre, half, room);
  }

  /// A widget of a column, with its upper left corner there.
  void place(const Widget& widget, const Vector2& corner, const Vector2& size, const TextRoom& room) {
    if (widget.kind == WidgetKind::List) return place_list(widget, corner, size);
    if (widget.kind == WidgetKind::Tabs) return place_tabs(widget, corner, size);
    const Vector2 half = 0.5 * size;
    LaidWidget& laid = place_row(widget, corner + Vector2(half.x(), -half.y()), half, room);
    if (widget.kind == WidgetKind::Label) laid.lines = words_of(widget);
  }

  void place_list(const Widget& list, const Vector2& corner, const Vector2& size) {
    const double heading = heading_of(list), room = kRoom * unit_;
    if (heading > 0.0)
      add(list, corner + 0.5 * Vector2(size.x(), -heading), 0.5 * Vector2(size.x(), heading), TextRoom());
    const Vector2 inner = corner + Vector2(room, -heading - room);
    const Vector2 rows(size.x() - 2.0 * room, size.y() - heading - 2.0 * room);
    layout_.frames.push_back({&list, sheet(), box_of(inner, rows)});
    place_rows(rows_of(list), inner, rows.x());
  }

  void place_tabs(const Widget& tabs, const Vector2& corner, const Vector2& size) {
    const double room = kRoom * unit_, row = kRow * unit_;
    double left = corner.x() + room;
    for (const Widget& page : tabs.widgets) {
      const double width = width_of_header(page);
      add(page, {left + 0.5 * width, corner.y() - 0.5 * row}, 0.5 * Vector2(width, row), room_of(page));
      left += width;
    }
    const Vector2 inner = corner + Vector2(room, -row), all(size.x() - 2.0 * room, size.y() - row - room);
    layout_.frames.push_back({&tabs, sheet(), box_of(inner, all)});
    if (const Widget* const page = shown_.page_of(tabs))
      place_rows({page->widgets, page}, inner - Vector2(0.0, room), all.x());
  }

  static LaidBox box_of(const Vector2& corner, const Vector2& size) {
    return {corner + 0.5 * Vector2(size.x(), -size.y()), 0.5 * size};
  }

  void place_rows(const Rows& rows, const Vector2& corner, double width) {
    if (rows.scroll()) return place_scrolled(rows, corner, width);
    const TextRoom room = room_of(rows.widgets);
    Vector2 at = corner;
    for (const Widget& widget : rows.widgets) {
      const Vector2 size(width, size_of(widget, room).y());
      place(widget, at, size, room);
      at.y() -= size.y();
    }
  }

  void place_scrolled(const Rows& rows, const Vector2& corner, double width) {
    const double row = kRow * unit_, bar = kHandle * unit_, height = rows.most * row;
    LaidColumn column{rows.of, sheet(), box_of(corner, {width, height}), 0, rows.most, rows.widgets.size()};
    if (const auto found = shown_.first_rows.find(rows.of); found != shown_.first_rows.end())
      column.first = std::min(found->second, column.last_first());
    const TextRoom room = room_of(rows.widgets);
    const Vector2 half = 0.5 * Vector2(width - bar, row);
    for (std::size_t i = 0; i < column.seen; ++i)
      place_row(rows.widgets[column.first + i],
                corner + Vector2(half.x(), -(2.0 * double(i) + 1.0) * half.y()), half, room);
    const double arrow = std::min(row, height / 3.0), middle = corner.x() + width - 0.5 * bar;
    const Vector2 end = 0.5 * Vector2(bar, arrow);
    add_handle(HandleKind::Less, rows.of, {middle, corner.y() - 0.5 * arrow}, end);
    add_handle(HandleKind::More, rows.of, {middle, corner.y() - height + 0.5 * arrow}, end);
    add_handle(HandleKind::Bar, rows.of, {middle, corner.y() - 0.5 * height},
               0.5 * Vector2(bar, height - 2.0 * arrow));
    layout_.columns.push_back(column);
  }

  double height_of_head(const std::string& title) const { return title.empty() ? 0.0 : kRow * unit_; }

  Vector2 size_of_menu(const Rows& rows, const std::string& title) const {
    const Vector2 inner = size_of_rows(rows);
    return {std::max(inner.x(), width_of_title(title)),
            inner.y() + height_of_head(title) + 2.0 * kRoom * unit_};
  }

  /// The rows of a menu, of which no more are seen than there is room for.
  Rows fitted(Rows rows, const std::string& title) const {
    if (!shown_.room || rows.most > 0) return rows;
    const bool can_scroll = std::ranges::none_of(rows.widgets, [](const Widget& widget) {
      return widget.kind == WidgetKind::List || widget.kind == WidgetKind::Tabs ||
             widget.kind == WidgetKind::Colour;
    });
    const double room = 2.0 * shown_.room->half.y();
    if (!can_scroll || size_of_menu(rows, title).y() <= room) return rows;
    const double free = room - height_of_head(title) - 2.0 * kRoom * unit_;
    rows.most = std::uint32_t(std::max(double(kLeastRows), std::floor(free / (kRow * unit_))));
    return rows;
  }

  /// The upper left corner of a menu beside the item that opens it: to the right of its sheet, to the left of
  /// an item in the left half of those round a middle, or on the other side where only there is room.
  Vector2 corner_beside(const LaidWidget& opener, const Vector2& size) const {
    const LaidSheet& sheet = layout_.sheets[opener.sheet];
    const double gap = kGap * unit_, top = opener.centre.y() + opener.half.y();
    const double right =
        std::max(sheet.centre.x() + sheet.half.x(), opener.centre.x() + opener.half.x()) + gap;
    const double left = sheet.centre.x() - sheet.half.x() - gap - size.x();
    const bool is_left = opener.sheet == 0 && !has_sides(element_.kind) && opener.centre.x() < -0.5 * unit_;
    if (!shown_.room) return {is_left ? left : right, top};
    const Vector2 low = shown_.room->centre - shown_.room->half,
                  high = shown_.room->centre + shown_.room->half;
    const double last = high.x() - size.x();
    const bool fits_right = right <= last, fits_left = left >= low.x();
    const double x = fits_right && !(is_left && fits_left) ? right
                     : fits_left                           ? left
                                                           : std::max(last, low.x());
    return {x, std::min(std::max(top, low.y() + size.y()), high.y())};
  }

  /// A sheet with rows below each other: the element's own in its middle, another one with its corner there.
  void arrange_menu_sheet(const Rows& rows, const std::string& title, const std::optional<Vector2>& corner) {
    const double head = height_of_head(title), room = kRoom * unit_;
    const Vector2 size = size_of_menu(rows, title);
    const Vector2 half = 0.5 * size, at = corner.value_or(Vector2(-half.x(), half.y()));
    add_sheet(rows.of, at + Vector2(half.x(), -half.y()), half, title);
    place_rows(rows, at - Vector2(0.0, head + room), size.x());
  }

  void arrange_grid() {
    const std::size_t count = element_.widgets.size();
    const std::size_t columns =
        element_.columns == 0 ? count : std::min<std::size_t>(element_.columns, count);
    const std::size_t rows = (count + columns - 1) / columns;
    const double width = largest().x(), height = (kRow + kPadding) * unit_, gap = kGap * unit_;
    const Vector2 cell(width + gap, height + gap);
    const double head = title().empty() ? 0.0 : kRow * unit_;
    const double whole =
        std::max(double(columns) * cell.x() + gap, kBold * width_of(title()) + 2.0 * kPadding * unit_);
    const Vector2 half = 0.5 * Vector2(whole, double(rows) * cell.y() + gap + head);
    add_sheet(nullptr, Vector2::Zero(), half, title());
    for (std::size_t i = 0; i < count; ++i) {
      const double x = (double(i % columns) - 0.5 * double(columns - 1)) * cell.x();
      const double y = half.y() - head - gap - (double(i / columns) + 0.5) * cell.y() + 0.5 * gap;
      place_alone(element_.widgets[i], {x, y}, 0.5 * Vector2(width, height));
    }
  }

  LaidWidget& place_alone(const Widget& widget, const Vector2& centre, const Vector2& half) {
    LaidWidget& laid = place_row(widget, centre, half, room_of(widget));
    laid.stands_alone = true;
    return laid;
  }

  Vector2 size_of_words(const std::vector<std::string>& words) const {
    double widest = 0.0;
    for (const std::string& line : words) widest = std::max(widest, width_of(line));
    return {widest + 2.0 * kPadding * unit_, double(words.size()) * kLine * unit_ + kGap * unit_};
  }

  std::vector<std::string> words_of(const Widget& widget) const {
    const bool is_dialog = element_.kind == ElementKind::Dialog;
    const double width = element_.width / unit_;
    return broken(text_of(widget, language_), is_dialog ? width : std::max(width, kWords), measure_);
  }

  /// The buttons of a dialog, as many beside each other as its words are wide at most.
  std::vector<std::vector<const Widget*>> rows_of_buttons() const {
    const double gap = kGap * unit_;
    std::vector<std::vector<const Widget*>> rows;
    double width = 0.0;
    for (const Widget& widget : element_.widgets) {
      if (widget.kind != WidgetKind::Item) continue;
      const double own = width_of(widget, room_of(widget)) + gap;
      if (rows.empty() || width + own > element_.width) {
        rows.emplace_back();
        width = gap;
      }
      rows.back().push_back(&widget);
      width += own;
    }
    return rows;
  }

  double width_of_buttons(const std::vector<const Widget*>& row) const {
    double width = kGap * unit_;
    for (const Widget* const button : row) width += width_of(*button, room_of(*button)) + kGap * unit_;
    return width;
  }

  /// Words below each other, then buttons beside each other.
  void arrange_dialog() {
    const double gap = kGap * unit_, row = kRow * unit_;
    double width = width_of_title(title()), height = height_of_head(title()) + kRoom * unit_;
    TextRoom room;
    for (const Widget& widget : element_.widgets)
      if (widget.kind != WidgetKind::Item) widen(room, widget);
    for (const Widget& widget : element_.widgets) {
      if (widget.kind == WidgetKind::Item) continue;
      const Vector2 size = size_of(widget, room);
      width = std::max(width, size.x());
      height += size.y();
    }
    const auto rows = rows_of_buttons();
    for (const auto& buttons : rows) width = std::max(width, width_of_buttons(buttons));
    if (!rows.empty()) height += double(rows.size()) * (row + gap) + gap;
    add_sheet(nullptr, Vector2::Zero(), 0.5 * Vector2(width, height), title());
    place_dialog(Vector2(width, height), room, rows);
  }

  void place_dialog(const Vector2& size, const TextRoom& room,
                    const std::vector<std::vector<const Widget*>>& rows) {
    const double gap = kGap * unit_, row = kRow * unit_;
    double top = 0.5 * size.y() - layout_.sheets.back().title_height - kRoom * unit_;
    for (const Widget& widget : element_.widgets) {
      if (widget.kind == WidgetKind::Item) continue;
      const Vector2 own(size.x(), size_of(widget, room).y());
      place(widget, {-0.5 * size.x(), top}, own, room);
      top -= own.y();
    }
    double middle = -0.5 * size.y() + gap + 0.5 * row + double(rows.size() - 1) * (row + gap);
    for (const auto& buttons : rows) {
      double left = 0.5 * size.x() - width_of_buttons(buttons) + gap;
      for (const Widget* const button : buttons) {
        const double width = width_of(*button, room_of(*button));
        place_alone(*button, {left + 0.5 * width, middle}, 0.5 * Vector2(width, row));
        left += width + gap;
      }
      middle -= row + gap;
    }
  }

  /// The size of the largest item, for those round a middle.
  Vector2 largest() const {
    double width = 0.0;
    for (const Widget& widget : element_.widgets) width = std::max(width, width_of(widget, room_of(widget)));
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
      place_alone(element_.widgets[i], radius * clockwise(2.0 * std::numbers::pi * double(i) / double(count)),
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
      place_alone(element_.widgets[i], daisy.places[i], 0.5 * size);
  }

  const Element& element_;
  std::size_t language_;
  const TextMeasure& measure_;
  const ShownParts& shown_;
  ElementLayout& layout_;
  double unit_;
};

void mirror(LaidBox& box) { box.centre.x() = -box.centre.x(); }

/// Turns it the other way round. A number's signs stay where they are from each other, as digits do.
void mirror(ElementLayout& layout) {
  layout.leftward = true;
  for (LaidSheet& sheet : layout.sheets) sheet.centre.x() = -sheet.centre.x();
  for (LaidColumn& column : layout.columns) mirror(column.box);
  for (LaidFrame& frame : layout.frames) mirror(frame.box);
  for (LaidWidget& widget : layout.widgets) {
    widget.centre.x() = -widget.centre.x();
    widget.leftward = true;
  }
  for (LaidHandle& handle : layout.handles) {
    mirror(handle.box);
    if (handle.of == nullptr || handle.of->kind != WidgetKind::Number) continue;
    handle.kind = handle.kind == HandleKind::Less ? HandleKind::More : HandleKind::Less;
  }
}

}  // namespace

bool Sector::contains(const Vector2& from_middle) const {
  const double r = from_middle.norm();
  if (r < inner || r > outer) return false;
  const double angle = std::atan2(from_middle.x(), from_middle.y());
  const double turn = 2.0 * std::numbers::pi;
  const double behind = angle - from;
  return behind - turn * std::floor(behind / turn) < to - from;
}

bool LaidBox::contains(const Vector2& place) const {
  return ((place - centre).cwiseAbs().array() <= half.array()).all();
}

bool LaidWidget::contains(const Vector2& place) const {
  return sector ? sector->contains(place) : LaidBox{centre, half}.contains(place);
}

double SliderGroove::value_at(const Widget& slider, double place) const {
  const double share = std::clamp((place - left) / (right - left), 0.0, 1.0);
  return slider.least + share * (slider.most - slider.least);
}

double SliderGroove::place_of(const Widget& slider, double value) const {
  const double range = slider.most - slider.least;
  const double share = range > 0.0 ? std::clamp((value - slider.least) / range, 0.0, 1.0) : 0.0;
  return left + share * (right - left);
}

SliderGroove groove_of(const LaidWidget& slider, double text_height) {
  const double length = (kSliderRoom - kPadding) * text_height;
  const double end = slider.half.x() - kPadding * text_height;
  const double left = slider.leftward ? slider.centre.x() - end : slider.centre.x() + end - length;
  return {left, left + length};
}

ColourWheel wheel_of(const LaidWidget& picker, double text_height) {
  ColourWheel wheel;
  wheel.outer = 0.5 * kWheel * text_height;
  wheel.inner = wheel.outer - kRingWidth * text_height;
  wheel.corner = wheel.inner - kGap * text_height;
  wheel.centre = picker.centre + Vector2(0.0, kPadding * text_height + wheel.outer - picker.half.y());
  return wheel;
}

const Widget* ShownParts::page_of(const Widget& tabs) const {
  if (const auto found = pages.find(&tabs); found != pages.end()) return found->second;
  if (tabs.widgets.empty()) return nullptr;
  const auto named = std::ranges::find(tabs.widgets, tabs.chosen, &Widget::name);
  return named == tabs.widgets.end() ? &tabs.widgets.front() : &*named;
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

const LaidHandle* ElementLayout::handle_at(const Vector2& place) const {
  const auto found =
      std::ranges::find_if(handles, [&](const LaidHandle& it) { return it.box.contains(place); });
  return found == handles.end() ? nullptr : &*found;
}

const LaidColumn* ElementLayout::column_at(const Vector2& place) const {
  const auto found =
      std::ranges::find_if(columns, [&](const LaidColumn& it) { return it.box.contains(place); });
  return found == columns.end() ? nullptr : &*found;
}

const LaidWidget* ElementLayout::widget(const Widget& widget) const {
  const auto found = std::ranges::find(widgets, &widget, &LaidWidget::widget);
  return found == widgets.end() ? nullptr : &*found;
}

const LaidHandle* ElementLayout::handle(HandleKind kind, const Widget* of) const {
  const auto found =
      std::ranges::find_if(handles, [&](const LaidHandle& it) { return it.kind == kind && it.of == of; });
  return found == handles.end() ? nullptr : &*found;
}

const LaidColumn* ElementLayout::column(const Widget* of) const {
  const auto found = std::ranges::find(columns, of, &LaidColumn::of);
  return found == columns.end() ? nullptr : &*found;
}

LaidBox field_of(const ElementLayout& layout, const Widget& number) {
  const LaidBox& less = layout.handle(HandleKind::Less, &number)->box;
  const LaidBox& more = layout.handle(HandleKind::More, &number)->box;
  const double left = less.centre.x() + less.half.x(), right = more.centre.x() - more.half.x();
  return {{0.5 * (left + right), less.centre.y()}, {0.5 * (right - left), less.half.y()}};
}

std::string number_text(double value) { return fmt::format("{:.10g}", value == 0.0 ? 0.0 : value); }

std::size_t language_of(const Element& element, std::string_view language) {
  const auto found = std::ranges::find(element.languages, language);
  return found == element.languages.end() ? 0 : std::size_t(found - element.languages.begin());
}

bool writes_leftward(std::string_view language) {
  constexpr std::array<std::string_view, 16> kLeftward = {
      "ar", "arc", "ckb", "dv", "fa", "he", "iw", "ks", "nqo", "ps", "sd", "syr", "ug", "ur", "yi", "prs"};
  return std::ranges::find(kLeftward, language.substr(0, language.find_first_of("-_"))) != kLeftward.end();
}

ElementLayout lay_out(const Element& element, std::size_t language, const TextMeasure& measure,
                      std::span<const Widget* const> open, const ShownParts& shown) {
  ElementLayout layout;
  layout.language = language;
  const bool leftward = has_sides(element.kind) && language < element.languages.size() &&
                        writes_leftward(element.languages[language]);
  ShownParts seen = shown;
  if (leftward && seen.room) mirror(*seen.room);
  Arranger arranger(element, language, measure, seen, layout);
  if (!element.widgets.empty()) arranger.arrange_element();
  for (const Widget* const opener : open)
    if (!arranger.arrange_menu(*opener)) break;
  if (leftward) mirror(layout);
  return layout;
}

}  // namespace icome::interaction
