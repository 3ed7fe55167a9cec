#include "session/elements/element_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "charts/canvas.h"
#include "charts/lettering.h"
#include "charts/palette.h"
#include "interaction/operations/looks/colour_names.h"

namespace icome::session {
namespace {

using base::Vector2;
using charts::Area;
using charts::Canvas;
using charts::Colour;
using interaction::ElementKind;
using interaction::HandleKind;
using interaction::LaidBox;
using interaction::LaidHandle;
using interaction::LaidSheet;
using interaction::LaidWidget;
using interaction::Widget;
using interaction::WidgetKind;

constexpr double kMillimetres = 1000.0;  // a page unit is a millimetre
constexpr double kMostPixels = 4096.0;
constexpr double kTitleRoom = 2.4;  // heights of a capital letter, above and below the ball of a daisy

struct Colours {
  Colour paper, ink, quiet, line, lit, on_lit, title, on_title, field, wrong;
};

Colours colours_of(ElementTheme theme) {
  switch (theme) {
    case ElementTheme::Light:
      return {{0.985, 0.987, 0.99}, charts::kInk,      {0.58, 0.61, 0.66},  {0.80, 0.83, 0.87},
              {0.10, 0.43, 0.78},   {1.0, 1.0, 1.0},   {0.91, 0.93, 0.955}, charts::kInk,
              {1.0, 1.0, 1.0},      {0.78, 0.13, 0.10}};
    case ElementTheme::Dark:
      return {{0.15, 0.165, 0.19}, {0.93, 0.94, 0.95}, {0.50, 0.53, 0.57},  {0.30, 0.33, 0.37},
              {0.25, 0.56, 0.93},  {1.0, 1.0, 1.0},    {0.21, 0.23, 0.265}, {0.93, 0.94, 0.95},
              {0.10, 0.11, 0.13},  {1.0, 0.45, 0.40}};
    case ElementTheme::HighContrast:
      break;
  }
  return {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {0.65, 0.65, 0.65}, {1.0, 1.0, 1.0}, {1.0, 1.0, 0.0},
          {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0},    {0.0, 0.0, 0.0}, {1.0, 0.5, 0.5}};
}

/// Draws one sheet; the page's y grows downward from the sheet's upper edge.
class SheetPainter {
 public:
  /// `sheet` is what of the element's plane the page shows.
  SheetPainter(const interaction::ElementUse& use, const LaidSheet& sheet, const Colours& colours,
               Canvas& canvas)
      : use_(use),
        sheet_(sheet),
        colours_(colours),
        canvas_(canvas),
        unit_(use.element().text_height * kMillimetres) {}

  /// A sheet of that number, with all that lies on it.
  void paint(std::size_t number) {
    canvas_.fill({0.0, 0.0, canvas_.width(), canvas_.height()}, colours_.paper);
    const auto& layout = use_.layout();
    const auto here = [&](const auto& laid) { return laid.sheet == number; };
    paint_title();
    for (const interaction::LaidFrame& frame : layout.frames)
      if (here(frame)) paint_frame(frame);
    for (const LaidWidget& laid : layout.widgets)
      if (here(laid)) paint_widget(laid);
    for (const LaidHandle& handle : layout.handles)
      if (here(handle)) paint_handle(handle);
  }

  /// A widget alone, as large as the page.
  void paint_alone(const LaidWidget& laid) {
    canvas_.fill({0.0, 0.0, canvas_.width(), canvas_.height()}, colours_.paper);
    paint_widget(laid);
  }

  /// The ball behind the tiles of a daisy, with the title above it.
  void paint_ball(const interaction::DaisySphere& sphere) {
    const Vector2 middle = page(Vector2::Zero());
    const double radius = sphere.radius * kMillimetres;
    canvas_.fill_disc(middle, radius, colours_.title);
    canvas_.circle(middle, radius - 0.05 * unit_, {colours_.line, 0.1 * unit_, {}});
    if (sheet_.title.empty()) return;
    auto look = style(colours_.ink, true);
    look.align = 0.5;
    canvas_.text({middle.x(), 1.7 * unit_}, sheet_.title, look);
  }

 private:
  static bool has_mark(const LaidWidget& laid) {
    return laid.widget->kind == WidgetKind::Check || laid.widget->kind == WidgetKind::Radio;
  }

  Vector2 page(const Vector2& place) const {
    return kMillimetres * Vector2(place.x() - sheet_.centre.x() + sheet_.half.x(),
                                  sheet_.centre.y() + sheet_.half.y() - place.y());
  }
  Area area_of(const LaidBox& box) const {
    const Vector2 corner = page(box.centre + Vector2(-box.half.x(), box.half.y()));
    return {corner.x(), corner.y(), 2.0 * kMillimetres * box.half.x(), 2.0 * kMillimetres * box.half.y()};
  }
  charts::TextStyle style(const Colour& colour, bool bold = false) const {
    return {unit_ / charts::kCapitalHeight, colour, bold, 0.0, 0.0};
  }

  /// A line that begins so far from where texts of the sheet begin, its baseline at `y`.
  void paint_line(const Area& area, double from, double y, const std::string& text, charts::TextStyle look) {
    const bool leftward = use_.layout().leftward;
    look.align = leftward ? 1.0 : 0.0;
    canvas_.text({leftward ? area.right() - from : area.x + from, y}, text, look);
  }

  void paint_title() {
    if (sheet_.title.empty()) return;
    const bool in_middle = sheet_.title_height == 0.0;
    auto look = style(colours_.on_title, true);
    if (in_middle) {
      look.align = 0.5;
      const Vector2 middle = page(sheet_.centre);
      return canvas_.text({middle.x(), middle.y() + 0.5 * unit_}, sheet_.title, look);
    }
    const double height = sheet_.title_height * kMillimetres;
    canvas_.fill({0.0, 0.0, canvas_.width(), height}, colours_.title);
    paint_line({0.0, 0.0, canvas_.width(), height}, 0.9 * unit_, 0.5 * (height + unit_), sheet_.title, look);
  }

  void paint_widget(const LaidWidget& laid) {
    const Widget& widget = *laid.widget;
    const Area area = area_of({laid.centre, laid.half});
    if (widget.kind == WidgetKind::Separator) return paint_separator(area);
    if (!widget.can_be_chosen()) return paint_words(laid, area);
    if (widget.kind == WidgetKind::Colour) return paint_picker(laid, area);
    const bool is_lit = is_filled(widget);
    const Colour ink = ink_of(widget, is_lit);
    paint_ground(laid, area, is_lit);
    const double middle = area.y + 0.5 * area.height;
    const double onward = laid.leftward ? -1.0 : 1.0, end = laid.leftward ? area.x : area.right();
    double from = 0.9 * unit_;  // where the text begins
    const auto place = [&](double offset) {
      return (laid.leftward ? area.right() : area.x) + onward * offset;
    };
    if (laid.has_mark_room) {
      if (has_mark(laid)) paint_mark(widget, {place(from + 0.6 * unit_), middle}, ink);
      from += 2.0 * unit_;
    }
    if (laid.has_icon_room) {
      const double side = 1.6 * unit_;
      if (!widget.icon.empty())
        paint_icon(widget, {place(from + 0.5 * side) - 0.5 * side, middle - 0.5 * side, side, side});
      from += 2.2 * unit_;
    }
    auto look = style(ink, widget.is_default || is_chosen(widget));
    const bool is_button = laid.stands_alone && widget.icon.empty() && widget.widgets.empty();
    const double base = middle + 0.5 * unit_;
    if (is_button && widget.kind == WidgetKind::Item) {
      look.align = 0.5;
      canvas_.text({area.x + 0.5 * area.width, base}, laid.lines.front(), look);
    } else {
      paint_line(area, from, base, laid.lines.front(), look);
    }
    if (widget.opens_menu()) paint_arrow({end - onward * 1.2 * unit_, middle}, onward, ink);
    if (widget.kind == WidgetKind::Slider) paint_slider(laid, middle, ink);
    if (widget.kind == WidgetKind::Number) paint_field(widget);
  }

  bool is_filled(const Widget& widget) const {
    return use_.lit() == &widget && widget.kind != WidgetKind::Number;
  }
  Colour ink_of(const Widget& widget, bool is_lit) const {
    return !use_.settings().is_usable(widget) ? colours_.quiet : is_lit ? colours_.on_lit : colours_.ink;
  }
  /// Is it the row of its list, or the page of its tabs?
  bool is_chosen(const Widget& widget) const {
    if (widget.kind != WidgetKind::Row && widget.kind != WidgetKind::Page) return false;
    const Widget* const parent = use_.settings().of(widget).parent;
    return parent != nullptr && use_.settings().of(*parent).chosen == &widget;
  }

  static std::array<Vector2, 5> outline_of(const Area& area) {
    return {Vector2(area.x, area.y), Vector2(area.right(), area.y), Vector2(area.right(), area.bottom()),
            Vector2(area.x, area.bottom()), Vector2(area.x, area.y)};
  }

  void paint_frame(const interaction::LaidFrame& frame) {
    const Area area = area_of(frame.box);
    canvas_.line(outline_of(area), {colours_.line, 0.1 * unit_, {}});
  }

  /// The digits of a number, between what makes it less and more.
  void paint_field(const Widget& number) {
    const Area area = area_of(interaction::field_of(use_.layout(), number));
    const std::string* const typed = use_.typed_into(number);
    const bool is_lit = use_.lit() == &number, is_wrong = typed != nullptr && !use_.trouble().empty();
    const charts::Stroke border{is_wrong ? colours_.wrong
                                : is_lit ? colours_.lit
                                         : colours_.line,
                                (is_lit ? 0.22 : 0.1) * unit_,
                                {}};
    canvas_.fill(area, colours_.field);
    canvas_.line(outline_of(area), border);
    auto look = style(is_wrong ? colours_.wrong : ink_of(number, false));
    look.align = 0.5;
    const std::string behind = number.unit.empty() ? "" : " " + number.unit;
    const std::string text =
        (typed != nullptr ? *typed + "|" : interaction::number_text(use_.value_of(number))) + behind;
    canvas_.text({area.x + 0.5 * area.width, area.y + 0.5 * (area.height + unit_)}, text, look);
  }

  void paint_handle(const LaidHandle& handle) {
    const Area area = area_of(handle.box);
    const bool is_lit = use_.lit_handle() == interaction::HandleName{handle.kind, handle.of};
    const bool is_number = handle.of != nullptr && handle.of->kind == WidgetKind::Number;
    if (handle.kind == HandleKind::Bar) return paint_bar(handle, area, is_lit);
    canvas_.fill(area, is_lit ? colours_.lit : colours_.title);
    canvas_.line(outline_of(area), {colours_.line, 0.1 * unit_, {}});
    const bool is_off =
        handle.of != nullptr && (is_number ? !use_.settings().is_usable(*handle.of) : !handle.of->enabled);
    const Colour ink = is_off || !leads_on(handle) ? colours_.quiet : is_lit ? colours_.on_lit : colours_.ink;
    const Vector2 middle(area.x + 0.5 * area.width, area.y + 0.5 * area.height);
    is_number ? paint_sign(middle, handle.kind, ink) : paint_way(middle, handle.kind, ink);
  }

  /// Is there more of it in that direction?
  bool leads_on(const LaidHandle& handle) const {
    const bool less = handle.kind == HandleKind::Less;
    if (const auto* const column = use_.layout().column(handle.of))
      return less ? column->first > 0 : column->first < column->last_first();
    const double value = use_.value_of(*handle.of);
    return less ? value > handle.of->least : value < handle.of->most;
  }

  void paint_sign(const Vector2& middle, HandleKind kind, const Colour& ink) {
    const charts::Stroke stroke{ink, 0.2 * unit_, {}};
    const Vector2 right(0.5 * unit_, 0.0), down(0.0, 0.5 * unit_);
    canvas_.line(std::array<Vector2, 2>{middle - right, middle + right}, stroke);
    if (kind == HandleKind::More) canvas_.line(std::array<Vector2, 2>{middle - down, middle + down}, stroke);
  }

  /// An arrow up or down.
  void paint_way(const Vector2& middle, HandleKind kind, const Colour& ink) {
    const double down = (kind == HandleKind::More ? 1.0 : -1.0) * unit_;
    const std::array<Vector2, 3> arrow{middle + Vector2(-0.5 * unit_, -0.25 * down),
                                       middle + Vector2(0.5 * unit_, -0.25 * down),
                                       middle + Vector2(0.0, 0.35 * down)};
    canvas_.fill_polygon(arrow, ink);
  }

  void paint_bar(const LaidHandle& bar, const Area& area, bool is_lit) {
    constexpr double kLeastThumb = 0.8;  // heights of a letter
    canvas_.fill(area, colours_.title);
    const interaction::LaidColumn& column = *use_.layout().column(bar.of);
    const double height = std::min(
        area.height, std::max(kLeastThumb * unit_, area.height * double(column.seen) / double(column.count)));
    const double share = double(column.first) / double(std::max<std::size_t>(1, column.last_first()));
    canvas_.fill(
        {area.x + 0.3 * unit_, area.y + share * (area.height - height), area.width - 0.6 * unit_, height},
        is_lit ? colours_.lit : colours_.quiet);
  }

  /// A picture of the ring and the triangle, on paper.
  charts::Image wheel_picture(const interaction::ColourWheel& wheel, const Vector2& half,
                              const interaction::Hsv& set) const {
    constexpr int kSide = 360;  // pixels
    charts::Image image{kSide, kSide, {}};
    image.rgba.reserve(std::size_t(4) * kSide * kSide);
    const double pixel = 2.0 * half.x() / kSide;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const Vector2 place =
            wheel.centre + Vector2((x + 0.5) * pixel - half.x(), half.y() - (y + 0.5) * pixel);
        const double r = (place - wheel.centre).norm();
        const double on_ring = std::clamp(
            0.5 -
                (std::abs(r - 0.5 * (wheel.inner + wheel.outer)) - 0.5 * (wheel.outer - wheel.inner)) / pixel,
            0.0, 1.0);
        const double on_triangle = std::clamp(0.5 - wheel.outside_triangle(place) / pixel, 0.0, 1.0);
        world::Colour hue = {}, shade = {};
        if (on_ring > 0.0) hue = interaction::rgb_of({wheel.with_hue_at({}, place).hue, 1.0, 1.0});
        if (on_triangle > 0.0) shade = interaction::rgb_of(wheel.with_shade_at(set, place));
        const std::array<double, 3> paper{colours_.paper.red, colours_.paper.green, colours_.paper.blue};
        for (std::size_t i = 0; i < 3; ++i) {
          const double value = paper[i] + on_ring * (hue[i] - paper[i]) + on_triangle * (shade[i] - paper[i]);
          image.rgba.push_back(std::uint8_t(std::lround(255.0 * std::clamp(value, 0.0, 1.0))));
        }
        image.rgba.push_back(255);
      }
    return image;
  }

  /// A ring that is seen on light and dark.
  void paint_spot(const Vector2& place) {
    canvas_.circle(page(place), 0.5 * unit_, {{0.0, 0.0, 0.0}, 0.3 * unit_, {}});
    canvas_.circle(page(place), 0.5 * unit_, {{1.0, 1.0, 1.0}, 0.14 * unit_, {}});
  }

  void paint_picker(const LaidWidget& laid, const Area& area) {
    const Widget& widget = *laid.widget;
    const bool is_usable = use_.settings().is_usable(widget), is_lit = use_.lit() == &widget;
    const interaction::Hsv set = use_.settings().of(widget).colour;
    const world::Colour rgb = interaction::rgb_of(set);
    const interaction::ColourWheel wheel = interaction::wheel_of(laid, use_.element().text_height);
    const Vector2 half = Vector2::Constant(wheel.outer * 1.01);
    const Colour ink = is_usable ? colours_.ink : colours_.quiet;
    const double base = area.y + 1.2 * unit_ + 0.5 * unit_;
    paint_line(area, 0.9 * unit_, base, laid.lines.front(), style(ink));
    auto look = style(ink);
    look.align = laid.leftward ? 0.0 : 1.0;
    const double code = laid.leftward ? area.x + 3.1 * unit_ : area.right() - 3.1 * unit_;
    canvas_.text({code, base}, interaction::colour_text(rgb), look);
    const double left = laid.leftward ? area.x + 0.9 * unit_ : area.right() - 2.5 * unit_;
    const Area square{left, area.y + 0.4 * unit_, 1.6 * unit_, 1.6 * unit_};
    canvas_.fill(square, {double(rgb[0]), double(rgb[1]), double(rgb[2])});
    canvas_.line(outline_of(square), {colours_.line, 0.1 * unit_, {}});
    canvas_.begin_group(area);
    canvas_.image(wheel_picture(wheel, half, set), area_of({wheel.centre, half}));
    if (is_usable) {
      paint_spot(wheel.place_of_hue(set.hue));
      paint_spot(wheel.place_of_shade(set));
    }
    canvas_.end_group(is_usable ? 1.0 : 0.35);
    if (!is_lit) return;
    const double rim = 0.15 * unit_;
    const Area inside{area.x + rim, area.y + rim, area.width - 2.0 * rim, area.height - 2.0 * rim};
    canvas_.line(outline_of(inside), {colours_.lit, (use_.is_editing() ? 0.3 : 0.15) * unit_, {}});
  }

  void paint_separator(const Area& area) {
    const std::array<Vector2, 2> line{Vector2(area.x + 0.4 * unit_, area.y + 0.5 * area.height),
                                      Vector2(area.right() - 0.4 * unit_, area.y + 0.5 * area.height)};
    canvas_.line(line, {colours_.line, 0.08 * unit_, {}});
  }

  void paint_words(const LaidWidget& laid, const Area& area) {
    double y = area.y + 1.35 * unit_;
    for (const std::string& line : laid.lines) {
      paint_line(area, 0.9 * unit_, y, line, style(colours_.ink));
      y += 1.7 * unit_;
    }
  }

  void paint_ground(const LaidWidget& laid, const Area& area, bool is_lit) {
    if (laid.sector) return paint_sector(*laid.sector, is_lit);
    if (is_lit) {
      canvas_.fill(area, colours_.lit);
    } else if (is_chosen(*laid.widget)) {
      canvas_.fill(area, colours_.title);
    }
    if (laid.widget->kind == WidgetKind::Page) return paint_header(*laid.widget, area);
    if (!laid.stands_alone) return;
    const double width = (laid.widget->is_default ? 0.22 : 0.1) * unit_;
    canvas_.line(outline_of(area), {laid.widget->is_default ? colours_.lit : colours_.line, width, {}});
  }

  /// The header of the page that shows has a line below it.
  void paint_header(const Widget& page, const Area& area) {
    canvas_.line(outline_of(area), {colours_.line, 0.1 * unit_, {}});
    if (is_chosen(page))
      canvas_.fill({area.x, area.bottom() - 0.25 * unit_, area.width, 0.25 * unit_}, colours_.lit);
  }

  void paint_sector(const interaction::Sector& sector, bool is_lit) {
    std::vector<Vector2> rim;
    constexpr int kSteps = 48;
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i <= kSteps; ++i) {
        const double share = double(side == 0 ? i : kSteps - i) / kSteps;
        const double angle = sector.from + share * (sector.to - sector.from);
        const double radius = side == 0 ? sector.outer : sector.inner;
        rim.push_back(page(sheet_.centre + radius * Vector2(std::sin(angle), std::cos(angle))));
      }
    if (is_lit) canvas_.fill_polygon(rim, colours_.lit);
    rim.push_back(rim.front());
    canvas_.line(rim, {colours_.line, 0.1 * unit_, {}});
  }

  void paint_mark(const Widget& widget, const Vector2& middle, const Colour& ink) {
    const bool on = use_.is_checked(widget);
    const charts::Stroke stroke{ink, 0.14 * unit_, {}};
    if (widget.kind == WidgetKind::Radio) {
      canvas_.circle(middle, 0.6 * unit_, stroke);
      if (on) canvas_.fill_disc(middle, 0.32 * unit_, ink);
      return;
    }
    const double half = 0.6 * unit_;
    const std::array<Vector2, 5> box{middle + Vector2(-half, -half), middle + Vector2(half, -half),
                                     middle + Vector2(half, half), middle + Vector2(-half, half),
                                     middle + Vector2(-half, -half)};
    canvas_.line(box, stroke);
    const std::array<Vector2, 3> tick{middle + unit_ * Vector2(-0.34, 0.02),
                                      middle + unit_ * Vector2(-0.08, 0.3),
                                      middle + unit_ * Vector2(0.38, -0.32)};
    if (on) canvas_.line(tick, {ink, 0.22 * unit_, {}});
  }

  void paint_icon(const Widget& widget, const Area& area) {
    const auto colour = interaction::colour_from_text(widget.icon);
    if (!colour) return;
    canvas_.fill(area, colours_.line);
    const double rim = 0.1 * unit_;
    canvas_.fill(
        {area.x + rim, area.y + rim, area.width - 2.0 * rim, area.height - 2.0 * rim},
        {double((*colour)[0]), double((*colour)[1]), double((*colour)[2]), widget.enabled ? 1.0 : 0.4});
  }

  /// An arrow to the right, or where `onward` is -1 to the left.
  void paint_arrow(const Vector2& middle, double onward, const Colour& ink) {
    const std::array<Vector2, 3> arrow{middle + unit_ * Vector2(-0.2 * onward, -0.5),
                                       middle + unit_ * Vector2(0.35 * onward, 0.0),
                                       middle + unit_ * Vector2(-0.2 * onward, 0.5)};
    canvas_.fill_polygon(arrow, ink);
  }

  void paint_slider(const LaidWidget& laid, double middle, const Colour& ink) {
    const auto groove = interaction::groove_of(laid, use_.element().text_height);
    const double left = page({groove.left, 0.0}).x(), right = page({groove.right, 0.0}).x();
    const Widget& widget = *laid.widget;
    const double knob = page({groove.place_of(widget, use_.value_of(widget)), 0.0}).x();
    const std::array<Vector2, 2> all{Vector2(left, middle), Vector2(right, middle)};
    const std::array<Vector2, 2> set{Vector2(left, middle), Vector2(knob, middle)};
    canvas_.line(all, {colours_.line, 0.3 * unit_, {}});
    canvas_.line(set, {ink, 0.3 * unit_, {}});
    canvas_.fill_disc({knob, middle}, 0.6 * unit_, ink);
  }

  const interaction::ElementUse& use_;
  const LaidSheet& sheet_;
  const Colours& colours_;
  Canvas& canvas_;
  double unit_;  // mm, height of a capital letter
};

/// Distance (m) from a rectangle with round corners, < 0 inside.
double outside(const Vector2& offset, const Vector2& half, double radius) {
  const Vector2 corner = offset.cwiseAbs() - half + Vector2::Constant(radius);
  return corner.cwiseMax(0.0).norm() + std::min(corner.maxCoeff(), 0.0) - radius;
}

/// The items of a ring, which are seen each by itself, sorted by height so that a place asks few.
class RingItems {
 public:
  RingItems(const interaction::ElementUse& use, std::size_t sheet) : round_(0.6 * use.element().text_height) {
    const LaidSheet& all = use.layout().sheets[sheet];
    low_ = all.centre.y() - all.half.y();
    for (const LaidWidget& laid : use.layout().widgets)
      if (laid.sheet == sheet) height_ = std::max(height_, 2.0 * laid.half.y());
    bands_.resize(1 + std::size_t(2.0 * all.half.y() / height_));
    for (const LaidWidget& laid : use.layout().widgets) {
      if (laid.sheet != sheet) continue;
      const double reach = laid.half.y() + 0.25 * height_;
      for (std::size_t i = band_of(laid.centre.y() - reach); i <= band_of(laid.centre.y() + reach); ++i)
        bands_[i].push_back({laid.centre, laid.half});
    }
  }

  /// Distance of a place from the nearest item, m, < 0 in it; far from all of them some length above 0.
  double outside_of(const Vector2& place) const {
    double least = 1.0;
    for (const LaidBox& box : bands_[band_of(place.y())])
      least = std::min(least, outside(place - box.centre, box.half, round_));
    return least;
  }

 private:
  std::size_t band_of(double y) const {
    return std::size_t(std::clamp((y - low_) / height_, 0.0, double(bands_.size() - 1)));
  }

  double round_, low_ = 0.0;
  double height_ = 1e-6;  // m, of a band
  std::vector<std::vector<LaidBox>> bands_;
};

/// Distance of a place from what is seen of a sheet, m, < 0 in it; of a ring without its items.
double outside_sheet(const interaction::ElementUse& use, std::size_t number, const Vector2& place) {
  const LaidSheet& sheet = use.layout().sheets[number];
  const double round = 0.6 * use.element().text_height;
  const ElementKind kind = use.element().kind;
  const bool is_root = sheet.opened_by == nullptr;
  if (is_root && kind == ElementKind::Pie) return (place - sheet.centre).norm() - sheet.half.x();
  if (!is_root || kind != ElementKind::Ring) return outside(place - sheet.centre, sheet.half, round);
  return sheet.title.empty() ? 1.0 : outside(place - sheet.centre, sheet.title_half, round);
}

/// The distance of a place of the plane from the part that is seen, m, < 0 in it.
using Outside = std::function<double(const Vector2&)>;

/// Cuts what is seen out of its page, with a line round it, and premultiplies.
void cut_out(const LaidSheet& laid, const Outside& outside, const Colour& line, double resolution,
             charts::Image& image) {
  const std::array<double, 3> rim{line.red, line.green, line.blue};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Vector2 place = laid.centre + Vector2((x + 0.5) / resolution - laid.half.x(),
                                                  laid.half.y() - (y + 0.5) / resolution);
      const double away = outside(place) * resolution;
      const double inside = std::clamp(0.5 - away, 0.0, 1.0);
      const double border = std::clamp(away + 2.5, 0.0, 1.0);
      std::uint8_t* const bytes =
          image.rgba.data() + 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
      for (std::size_t i = 0; i < 3; ++i) {
        const double own = bytes[i] / 255.0;
        bytes[i] = std::uint8_t(std::lround(255.0 * inside * (own + border * (rim[i] - own))));
      }
      bytes[3] = std::uint8_t(std::lround(255.0 * inside));
    }
}

/// Draws a page of the element's plane, and cuts out what is seen of it.
charts::Image drawn_page(const interaction::ElementUse& use, const LaidSheet& page, ElementTheme theme,
                         double resolution, const Outside& outside,
                         const std::function<void(SheetPainter&)>& paint) {
  resolution = std::min(resolution, 0.5 * kMostPixels / page.half.maxCoeff());
  const Vector2 size = 2.0 * resolution * page.half;
  const Colours colours = colours_of(theme);
  Canvas canvas(std::max(1, int(std::lround(size.x()))), std::max(1, int(std::lround(size.y()))),
                resolution / kMillimetres);
  SheetPainter painter(use, page, colours, canvas);
  paint(painter);
  charts::Image image = canvas.snapshot();
  cut_out(page, outside, colours.line, resolution, image);
  return image;
}

}  // namespace

charts::Image draw_sheet(const interaction::ElementUse& use, std::size_t sheet, ElementTheme theme,
                         double resolution) {
  std::optional<RingItems> items;
  if (sheet == 0 && use.element().kind == ElementKind::Ring) items.emplace(use, sheet);
  return drawn_page(
      use, use.layout().sheets[sheet], theme, resolution,
      [&](const Vector2& place) {
        const double away = outside_sheet(use, sheet, place);
        return items ? std::min(away, items->outside_of(place)) : away;
      },
      [&](SheetPainter& painter) { painter.paint(sheet); });
}

charts::Image draw_tile(const interaction::ElementUse& use, const LaidWidget& laid, ElementTheme theme,
                        double resolution) {
  LaidSheet page;
  page.centre = laid.centre;
  page.half = laid.half;
  const double round = 0.6 * use.element().text_height;
  return drawn_page(
      use, page, theme, resolution,
      [&](const Vector2& place) { return outside(place - laid.centre, laid.half, round); },
      [&](SheetPainter& painter) { painter.paint_alone(laid); });
}

interaction::Vector2 half_of_ball(const interaction::ElementUse& use) {
  const LaidSheet& sheet = use.layout().sheets.front();
  const double title = sheet.title.empty() ? 0.0 : kTitleRoom * use.element().text_height;
  return {std::max(sheet.sphere->radius, sheet.title_half.x()), sheet.sphere->radius + title};
}

std::string letters_without_font(const interaction::Element& element, std::size_t language) {
  std::string texts = language < element.title.size() ? element.title[language] : "";
  const auto add = [&](const auto& self, const std::vector<Widget>& widgets) -> void {
    for (const Widget& widget : widgets) {
      if (language < widget.text.size()) texts += widget.text[language];
      texts += widget.unit;
      self(self, widget.widgets);
    }
  };
  add(add, element.widgets);
  return charts::letters_without_font(texts);
}

charts::Image draw_look_mark(ElementTheme theme) {
  constexpr int kSide = 29;  // pixels
  const Colours colours = colours_of(theme);
  Canvas canvas(kSide, kSide, 1.0);
  const Vector2 middle = Vector2::Constant(0.5 * kSide);
  canvas.circle(middle, 11.0, {colours.paper, 5.0, {}});
  canvas.circle(middle, 11.0, {colours.lit, 2.0, {}});
  canvas.fill_disc(middle, 2.0, colours.lit);
  charts::Image image = canvas.snapshot();
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double away = (Vector2(x + 0.5, y + 0.5) - middle).norm();
      const double seen =
          std::max(std::clamp(3.5 - std::abs(away - 11.0), 0.0, 1.0), std::clamp(3.0 - away, 0.0, 1.0));
      std::uint8_t* const bytes = image.rgba.data() + 4 * std::ptrdiff_t(y * kSide + x);
      for (int i = 0; i < 3; ++i) bytes[i] = std::uint8_t(std::lround(seen * bytes[i]));
      bytes[3] = std::uint8_t(std::lround(255.0 * seen));
    }
  return image;
}

charts::Image draw_ball(const interaction::ElementUse& use, ElementTheme theme, double resolution) {
  LaidSheet page = use.layout().sheets.front();
  page.half = half_of_ball(use);
  const double top = page.half.y() - 0.5 * kTitleRoom * use.element().text_height;
  const auto outside_ball = [&](const Vector2& place) {
    const double of_ball = place.norm() - page.sphere->radius;
    if (page.title.empty()) return of_ball;
    return std::min(of_ball, outside(place - Vector2(0.0, top), page.title_half, 0.001));
  };
  return drawn_page(use, page, theme, resolution, outside_ball,
                    [&](SheetPainter& painter) { painter.paint_ball(*page.sphere); });
}

}  // namespace icome::session
