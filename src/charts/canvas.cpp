#include "charts/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "charts/lettering.h"
#include "charts/palette.h"
#include "charts/set_line.h"

namespace icome::charts {
namespace {

using base::Vector2;

/// Cairo keeps coordinates in 24.8 fixed point pixels; points farther out are off any page anyway.
constexpr double kFarOut = 1e5;

double bounded(double v) { return std::clamp(v, -kFarOut, kFarOut); }

void set_colour(cairo_t* cairo, const Colour& c) {
  cairo_set_source_rgba(cairo, c.red, c.green, c.blue, c.alpha);
}

void set_stroke(cairo_t* cairo, const Stroke& stroke) {
  set_colour(cairo, stroke.colour);
  cairo_set_line_width(cairo, stroke.width);
  cairo_set_dash(cairo, stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0.0);
}

void trace(cairo_t* cairo, std::span<const Vector2> points) {
  cairo_new_path(cairo);
  for (const Vector2& p : points) cairo_line_to(cairo, bounded(p.x()), bounded(p.y()));
}

void add_stops(cairo_pattern_t* pattern, std::span<const Colour> colours) {
  const double last = std::max<double>(1.0, static_cast<double>(colours.size()) - 1.0);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const Colour& c = colours[i];
    cairo_pattern_add_color_stop_rgba(pattern, static_cast<double>(i) / last, c.red, c.green, c.blue,
                                      c.alpha);
  }
}

void fill_with(cairo_t* cairo, cairo_pattern_t* pattern, std::span<const Colour> colours) {
  add_stops(pattern, colours);
  cairo_set_source(cairo, pattern);
  cairo_fill(cairo);
  cairo_pattern_destroy(pattern);
}

/// Cairo's pixel, whose colours are premultiplied, as an image has it.
void append_plain(std::vector<std::uint8_t>& rgba, std::uint32_t word) {
  const std::uint32_t alpha = word >> 24;
  for (const int shift : {16, 8, 0}) {
    const std::uint32_t channel = word >> shift & 0xff;
    rgba.push_back(static_cast<std::uint8_t>(alpha == 0 ? 0 : (255 * channel + alpha / 2) / alpha));
  }
  rgba.push_back(static_cast<std::uint8_t>(alpha));
}

cairo_status_t append_to_text(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

struct Canvas::Page {
  cairo_surface_t* surface;
  cairo_t* cairo;
  double width;                       // page units
  double height;                      // page units
  std::unique_ptr<std::string> file;  // the output of the surface; null for a page with pixels

  Page(cairo_surface_t* made, double wide, double high, std::unique_ptr<std::string> text)
      : surface(made), cairo(cairo_create(surface)), width(wide), height(high), file(std::move(text)) {}
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;
  ~Page() {
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
  }
};

Canvas::Canvas(std::unique_ptr<Page> page) : page_(std::move(page)) {
  cairo_set_line_join(page_->cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(page_->cairo, CAIRO_LINE_CAP_ROUND);
}

std::unique_ptr<Canvas::Page> Canvas::pixels(int width, int height, double scale) {
  auto page = std::make_unique<Page>(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height),
                                     width / scale, height / scale, nullptr);
  cairo_scale(page->cairo, scale, scale);
  return page;
}

Canvas::Canvas(int width, int height, double scale) : Canvas(pixels(width, height, scale)) {
  fill({0.0, 0.0, width / scale, height / scale}, kPaper);
}

Canvas Canvas::clear(int width, int height, double scale) { return Canvas(pixels(width, height, scale)); }

Canvas Canvas::of_lines(double width, double height) {
  auto text = std::make_unique<std::string>();
  cairo_surface_t* surface = cairo_svg_surface_create_for_stream(append_to_text, text.get(), width, height);
  cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
  Canvas canvas(std::make_unique<Page>(surface, width, height, std::move(text)));
  canvas.fill({0.0, 0.0, width, height}, kPaper);
  return canvas;
}

Canvas Canvas::of_pdf(double width, double height) {
  auto bytes = std::make_unique<std::string>();
  cairo_surface_t* surface = cairo_pdf_surface_create_for_stream(append_to_text, bytes.get(), width, height);
  // Otherwise it would be the present time, and no two files would be equal.
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  return Canvas(std::make_unique<Page>(surface, width, height, std::move(bytes)));
}

Canvas::Canvas(Canvas&&) noexcept = default;
Canvas::~Canvas() = default;

double Canvas::width() const { return page_->width; }
double Canvas::height() const { return page_->height; }

void Canvas::fill(const Area& area, const Colour& colour) {
  set_colour(page_->cairo, colour);
  cairo_rectangle(page_->cairo, area.x, area.y, area.width, area.height);
  cairo_fill(page_->cairo);
}

void Canvas::fill_gradient(const Area& area, std::span<const Colour> colours, bool upward) {
  cairo_rectangle(page_->cairo, area.x, area.y, area.width, area.height);
  fill_with(page_->cairo,
            upward ? cairo_pattern_create_linear(0.0, area.bottom(), 0.0, area.y)
                   : cairo_pattern_create_linear(area.x, 0.0, area.right(), 0.0),
            colours);
}

void Canvas::fill_gradient(std::span<const Vector2> polygon, const Area& span,
                           std::span<const Colour> colours) {
  trace(page_->cairo, polygon);
  fill_with(page_->cairo, cairo_pattern_create_linear(0.0, span.bottom(), 0.0, span.y), colours);
}

void Canvas::fill_polygon(std::span<const Vector2> points, const Colour& colour) {
  trace(page_->cairo, points);
  set_colour(page_->cairo, colour);
  cairo_fill(page_->cairo);
}

void Canvas::fill_path(std::span<const CubicLoop> loops, const Colour& colour) {
  cairo_t* cairo = page_->cairo;
  cairo_new_path(cairo);
  for (const CubicLoop& loop : loops) {
    if (loop.points.empty()) continue;
    cairo_move_to(cairo, bounded(loop.points[0].x()), bounded(loop.points[0].y()));
    for (std::size_t i = 3; i < loop.points.size(); i += 3) {
      const Vector2* p = &loop.points[i - 2];
      cairo_curve_to(cairo, bounded(p[0].x()), bounded(p[0].y()), bounded(p[1].x()), bounded(p[1].y()),
                     bounded(p[2].x()), bounded(p[2].y()));
    }
    cairo_close_path(cairo);
  }
  set_colour(cairo, colour);
  cairo_fill(cairo);
}

void Canvas::fill_disc(const Vector2& centre, double radius, const Colour& colour) {
  cairo_new_path(page_->cairo);
  cairo_arc(page_->cairo, bounded(centre.x()), bounded(centre.y()), radius, 0.0, 2.0 * M_PI);
  set_colour(page_->cairo, colour);
  cairo_fill(page_->cairo);
}

void Canvas::circle(const Vector2& centre, double radius, const Stroke& stroke) {
  cairo_new_path(page_->cairo);
  cairo_arc(page_->cairo, bounded(centre.x()), bounded(centre.y()), radius, 0.0, 2.0 * M_PI);
  set_stroke(page_->cairo, stroke);
  cairo_stroke(page_->cairo);
}

void Canvas::line(std::span<const Vector2> points, const Stroke& stroke) {
  trace(page_->cairo, points);
  set_stroke(page_->cairo, stroke);
  cairo_stroke(page_->cairo);
}

void Canvas::text(const Vector2& at, std::string_view text, const TextStyle& style) {
  const SetLine line(text, style.bold);
  cairo_save(page_->cairo);
  cairo_translate(page_->cairo, at.x(), at.y());
  cairo_rotate(page_->cairo, -style.turn);
  set_colour(page_->cairo, style.colour);
  line.show(page_->cairo, -style.align * line.width() * style.size, style.size);
  cairo_restore(page_->cairo);
}

double Canvas::text_width(std::string_view text, const TextStyle& style) const {
  return SetLine(text, style.bold).width() * style.size;
}

void Canvas::image(const Image& image, const Area& area) {
  cairo_surface_t* source = cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height);
  unsigned char* data = cairo_image_surface_get_data(source);
  if (data) {
    const int stride = cairo_image_surface_get_stride(source);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const std::uint8_t* p = image.pixel(x, y);
        const std::uint32_t word = std::uint32_t{p[0]} << 16 | std::uint32_t{p[1]} << 8 | p[2];
        std::memcpy(data + std::ptrdiff_t{y} * stride + std::ptrdiff_t{x} * 4, &word, sizeof word);
      }
    }
    cairo_surface_mark_dirty(source);
  }
  cairo_save(page_->cairo);
  cairo_translate(page_->cairo, area.x, area.y);
  cairo_scale(page_->cairo, area.width / image.width, area.height / image.height);
  cairo_set_source_surface(page_->cairo, source, 0.0, 0.0);
  cairo_paint(page_->cairo);
  cairo_restore(page_->cairo);
  cairo_surface_destroy(source);
}

void Canvas::clip(const Area& area) {
  cairo_save(page_->cairo);
  cairo_rectangle(page_->cairo, area.x, area.y, area.width, area.height);
  cairo_clip(page_->cairo);
}

void Canvas::unclip() { cairo_restore(page_->cairo); }

void Canvas::begin_group(const Area& area) {
  clip(area);
  cairo_push_group(page_->cairo);
}

void Canvas::end_group(double opacity) {
  cairo_pop_group_to_source(page_->cairo);
  cairo_paint_with_alpha(page_->cairo, opacity);
  unclip();
}

Image Canvas::snapshot() const {
  assert(!page_->file);
  cairo_surface_flush(page_->surface);
  Image out{
      cairo_image_surface_get_width(page_->surface), cairo_image_surface_get_height(page_->surface), {}};
  const unsigned char* data = cairo_image_surface_get_data(page_->surface);
  const int stride = cairo_image_surface_get_stride(page_->surface);
  out.rgba.reserve(4 * static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      std::uint32_t word = 0;
      std::memcpy(&word, data + std::ptrdiff_t{y} * stride + std::ptrdiff_t{x} * 4, sizeof word);
      append_plain(out.rgba, word);
    }
  }
  return out;
}

std::string Canvas::svg() {
  assert(cairo_surface_get_type(page_->surface) == CAIRO_SURFACE_TYPE_SVG);
  cairo_surface_finish(page_->surface);
  return *page_->file;
}

void Canvas::next_page() {
  assert(cairo_surface_get_type(page_->surface) == CAIRO_SURFACE_TYPE_PDF);
  cairo_show_page(page_->cairo);
}

std::string Canvas::pdf() {
  assert(cairo_surface_get_type(page_->surface) == CAIRO_SURFACE_TYPE_PDF);
  cairo_surface_finish(page_->surface);
  return *page_->file;
}

std::string fitted(const Canvas& canvas, std::string_view text, const TextStyle& style, double width) {
  std::string shown = printable(text);
  if (canvas.text_width(shown, style) <= width) return shown;
  while (!shown.empty() && canvas.text_width(shown + "\u2026", style) > width) {
    // Removes a whole character: its last bytes 10xxxxxx, then its first.
    while (shown.size() > 1 && (static_cast<unsigned char>(shown.back()) & 0xc0) == 0x80) shown.pop_back();
    shown.pop_back();
  }
  return shown + "\u2026";
}

}  // namespace icome::charts
