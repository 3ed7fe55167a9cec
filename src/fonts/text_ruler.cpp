#include "fonts/text_ruler.h"

#include "base/utf8.h"
#include "fonts/font_face.h"

namespace icome::fonts {

base::Result<TextRuler> TextRuler::open(const std::string& family) {
  auto face = FontFace::open(family);
  if (!face) return tl::unexpected(face.error());
  return TextRuler(std::make_shared<const FontFace>(std::move(*face)));
}

double TextRuler::width(const std::string& utf8) const {
  double width = 0.0;
  std::uint32_t last = 0;
  for (const char32_t letter : base::letters_of(base::as_utf8(utf8))) {
    const std::uint32_t glyph = face_->glyph_of(letter);
    if (last != 0 && glyph != 0) width += face_->kerning(last, glyph);
    width += face_->advance(glyph);
    last = glyph;
  }
  return width / face_->capital_height();
}

}  // namespace icome::fonts
