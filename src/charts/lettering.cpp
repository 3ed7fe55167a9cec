#include "charts/lettering.h"

#include <pango/pangocairo.h>

#include <algorithm>
#include <cstdint>
#include <memory>

#include "charts/set_line.h"

namespace icome::charts {
namespace {

constexpr const char* kFamily = "DejaVu Sans";
constexpr double kSetSize = 100.0;  // units of a page, at which lines are set

/// Length in bytes of the UTF-8 character at the start of `text`; 0 where there is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80         ? 1
                             : first >> 5 == 0x6  ? 2
                             : first >> 4 == 0xe  ? 3
                             : first >> 3 == 0x1e ? 4
                                                  : 0;
  if (length == 0 || length > text.size()) return 0;
  std::uint32_t code = length == 1 ? first : first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr std::uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code < kSmallest[length] || code > 0x10ffff || surrogate ? 0 : length;
}

struct Unref {
  void operator()(void* object) const { g_object_unref(object); }
};

/// Pango's objects of one thread, which sets its lines with them.
struct Setting {
  std::unique_ptr<PangoContext, Unref> context{
      pango_font_map_create_context(pango_cairo_font_map_get_default())};
  std::unique_ptr<PangoLayout, Unref> layout;

  Setting() {
    // Letters keep their shape and place at any scale.
    cairo_font_options_t* const options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    pango_cairo_context_set_font_options(context.get(), options);
    cairo_font_options_destroy(options);
    pango_context_set_round_glyph_positions(context.get(), FALSE);
    layout.reset(pango_layout_new(context.get()));
    pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
  }
};

PangoLayout* layout_of_thread() {
  thread_local Setting setting;
  return setting.layout.get();
}

}  // namespace

SetLine::SetLine(std::string_view text, bool bold) {
  PangoLayout* const layout = layout_of_thread();
  PangoFontDescription* const font = pango_font_description_new();
  pango_font_description_set_family_static(font, kFamily);
  pango_font_description_set_weight(font, bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_font_description_set_absolute_size(font, kSetSize * PANGO_SCALE);
  pango_layout_set_font_description(layout, font);
  pango_font_description_free(font);
  const std::string shown = printable(text);
  pango_layout_set_text(layout, shown.data(), int(shown.size()));
  // Measured alike, whatever page the line before was drawn on.
  pango_context_set_matrix(pango_layout_get_context(layout), nullptr);
  int width = 0;
  pango_layout_get_size(layout, &width, nullptr);
  width_ = width / (PANGO_SCALE * kSetSize);
  unknown_letters_ = pango_layout_get_unknown_glyphs_count(layout);
}

void SetLine::show(_cairo* cairo, double x, double size) const {
  PangoLayout* const layout = layout_of_thread();
  cairo_save(cairo);
  cairo_scale(cairo, size / kSetSize, size / kSetSize);
  pango_cairo_update_layout(cairo, layout);
  cairo_move_to(cairo, x / size * kSetSize, -double(pango_layout_get_baseline(layout)) / PANGO_SCALE);
  pango_cairo_show_layout(cairo, layout);
  cairo_restore(cairo);
}

double line_width(std::string_view text) { return SetLine(text, false).width() / kCapitalHeight; }

std::string letters_without_font(std::string_view text) {
  if (SetLine(text, false).unknown_letters() == 0) return {};
  const std::string shown = printable(text);
  std::string missing;
  for (std::size_t at = 0; at < shown.size();) {
    const std::size_t length = character_length(std::string_view(shown).substr(at));
    const std::string letter = shown.substr(at, length);
    at += length;
    if (missing.find(letter) == std::string::npos && SetLine(letter, false).unknown_letters() > 0)
      missing += letter;
  }
  return missing;
}

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const bool control = length == 1 && (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7f);
    out += length == 0 ? std::string_view("\xef\xbf\xbd") : control ? " " : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return out;
}

}  // namespace icome::charts
