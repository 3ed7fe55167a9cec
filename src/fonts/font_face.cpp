#include "fonts/font_face.h"

#include <fmt/format.h>
#include <fontconfig/fontconfig.h>
#include <ft2build.h>

#include <algorithm>
#include <cmath>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include "fonts/text_shape.h"

namespace icome::fonts {
namespace {

using base::Vector2;

// Steps of the grid in an em: rounding to it moves nothing that can be seen.
constexpr double kGridSteps = 524'288.0;

using Pattern = std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)>;

struct FoundFont {
  std::string file;
  std::string name;
  int index = 0;
};

tl::unexpected<base::Error> no_such_font(const std::string& family) {
  const std::string advice = family == kUsualFont
                                 ? "install the package fonts-dejavu-core"
                                 : fmt::format("choose another, such as \"{}\", or install it", kUsualFont);
  return base::fail(fmt::format("There is no font \"{}\" here: {}.", family.substr(0, 100), advice));
}

std::string text_of(const FcPattern* pattern, const char* what, int n) {
  FcChar8* text = nullptr;
  if (FcPatternGetString(pattern, what, n, &text) != FcResultMatch) return {};
  return reinterpret_cast<const char*>(text);
}

/// Does the pattern have a family of this name? fontconfig gives another font rather than none.
bool has_family(const FcPattern* pattern, const std::string& family) {
  for (int n = 0;; ++n) {
    const std::string name = text_of(pattern, FC_FAMILY, n);
    if (name.empty()) return false;
    if (FcStrCmpIgnoreCase(reinterpret_cast<const FcChar8*>(name.c_str()),
                           reinterpret_cast<const FcChar8*>(family.c_str())) == 0)
      return true;
  }
}

base::Result<FoundFont> find_font(const std::string& family) {
  const Pattern wanted(FcNameParse(reinterpret_cast<const FcChar8*>(family.c_str())), FcPatternDestroy);
  const std::string name = wanted ? text_of(wanted.get(), FC_FAMILY, 0) : "";
  if (name.empty()) return no_such_font(family);
  FcPatternAddBool(wanted.get(), FC_SCALABLE, FcTrue);
  FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult result = FcResultNoMatch;
  const Pattern found(FcFontMatch(nullptr, wanted.get(), &result), FcPatternDestroy);
  const bool generic = name == "sans" || name == "sans-serif" || name == "serif" || name == "monospace";
  if (!found || (!generic && !has_family(found.get(), name))) return no_such_font(family);
  FoundFont font{text_of(found.get(), FC_FILE, 0), text_of(found.get(), FC_FAMILY, 0)};
  FcPatternGetInteger(found.get(), FC_INDEX, 0, &font.index);
  return font;
}

/// Turns the lines and curves of a letter into rings of points.
class RingCollector {
 public:
  RingCollector(double grid, double tolerance) : grid_(grid), tolerance_(tolerance) {}

  LetterRings collect(FT_Outline& outline) {
    FT_Outline_Funcs calls{};
    calls.move_to = [](const FT_Vector* to, void* self) { return from(self).move(*to); };
    calls.line_to = [](const FT_Vector* to, void* self) { return from(self).line(*to); };
    calls.conic_to = [](const FT_Vector* by, const FT_Vector* to, void* self) {
      return from(self).conic(*by, *to);
    };
    calls.cubic_to = [](const FT_Vector* by, const FT_Vector* and_by, const FT_Vector* to, void* self) {
      return from(self).cubic(*by, *and_by, *to);
    };
    if (FT_Outline_Decompose(&outline, &calls, this) != 0) return {};
    return std::move(rings_);
  }

 private:
  static RingCollector& from(void* self) { return *static_cast<RingCollector*>(self); }
  Vector2 point(const FT_Vector& it) const { return {grid_ * double(it.x), grid_ * double(it.y)}; }

  int move(const FT_Vector& to) {
    rings_.push_back({point(to)});
    at_ = point(to);
    return 0;
  }
  int line(const FT_Vector& to) {
    add(point(to));
    at_ = point(to);
    return 0;
  }
  /// A piece of a parabola is off its chord by a quarter of the second difference, over the pieces squared.
  int conic(const FT_Vector& by, const FT_Vector& to) {
    const Vector2 a = at_, b = point(by), c = point(to);
    const int pieces = pieces_for((a - 2.0 * b + c).norm() / 4.0);
    for (int i = 1; i <= pieces; ++i) {
      const double t = double(i) / pieces, s = 1.0 - t;
      add(s * s * a + 2.0 * s * t * b + t * t * c);
    }
    at_ = c;
    return 0;
  }
  /// A piece of a cubic is off by at most 3/4 of the larger second difference, over the pieces squared.
  int cubic(const FT_Vector& by, const FT_Vector& and_by, const FT_Vector& to) {
    const Vector2 a = at_, b = point(by), c = point(and_by), d = point(to);
    const int pieces = pieces_for(0.75 * std::max((a - 2.0 * b + c).norm(), (b - 2.0 * c + d).norm()));
    for (int i = 1; i <= pieces; ++i) {
      const double t = double(i) / pieces, s = 1.0 - t;
      add(s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d);
    }
    at_ = d;
    return 0;
  }

  int pieces_for(double off) const {
    constexpr double kMostPieces = 100.0;  // of one curve, whatever its size
    return int(std::clamp(std::ceil(std::sqrt(off / tolerance_)), 1.0, kMostPieces));
  }
  void add(const Vector2& at) { rings_.back().push_back(at.array().round()); }

  const double grid_, tolerance_;
  Vector2 at_ = Vector2::Zero();
  LetterRings rings_;
};

}  // namespace

struct FontFace::Impl {
  ~Impl() {
    if (face) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }

  /// Loads the letter's outline, unscaled; false where it has none.
  bool load(std::uint32_t glyph) const {
    return FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE | FT_LOAD_IGNORE_TRANSFORM) == 0 &&
           face->glyph->format == FT_GLYPH_FORMAT_OUTLINE;
  }

  FT_Library library = nullptr;
  FT_Face face = nullptr;
  double grid = 1.0;  // steps of the grid in a unit of the font
  std::string name = {};
};

FontFace::FontFace(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FontFace::FontFace(FontFace&&) noexcept = default;
FontFace& FontFace::operator=(FontFace&&) noexcept = default;
FontFace::~FontFace() = default;

base::Result<FontFace> FontFace::open(const std::string& family) {
  const auto found = find_font(family);
  if (!found) return tl::unexpected(found.error());
  auto impl = std::make_unique<Impl>();
  impl->name = found->name;
  if (FT_Init_FreeType(&impl->library) != 0 ||
      FT_New_Face(impl->library, found->file.c_str(), found->index, &impl->face) != 0 ||
      !FT_IS_SCALABLE(impl->face) || impl->face->units_per_EM == 0)
    return base::fail(
        fmt::format("The font {} cannot be read: choose another than \"{}\".", found->file, family));
  impl->grid = std::max(1.0, std::floor(kGridSteps / impl->face->units_per_EM));
  return FontFace(std::move(impl));
}

double FontFace::capital_height() const {
  FT_BBox box{};
  const std::uint32_t glyph = glyph_of(U'H');
  if (glyph != 0 && impl_->load(glyph)) FT_Outline_Get_CBox(&impl_->face->glyph->outline, &box);
  const auto units = box.yMax > 0 ? double(box.yMax) : 0.7 * impl_->face->units_per_EM;
  return impl_->grid * units;
}

double FontFace::line_height() const { return impl_->grid * impl_->face->height; }

std::uint32_t FontFace::glyph_of(char32_t letter) const { return FT_Get_Char_Index(impl_->face, letter); }

double FontFace::advance(std::uint32_t glyph) const {
  return impl_->load(glyph) ? impl_->grid * double(impl_->face->glyph->metrics.horiAdvance) : 0.0;
}

double FontFace::kerning(std::uint32_t glyph, std::uint32_t next) const {
  FT_Vector apart{};
  if (!FT_HAS_KERNING(impl_->face) ||
      FT_Get_Kerning(impl_->face, glyph, next, FT_KERNING_UNSCALED, &apart) != 0)
    return 0.0;
  return impl_->grid * double(apart.x);
}

LetterRings FontFace::rings(std::uint32_t glyph, double tolerance) const {
  if (!impl_->load(glyph)) return {};
  return RingCollector(impl_->grid, tolerance).collect(impl_->face->glyph->outline);
}

const std::string& FontFace::name() const { return impl_->name; }

}  // namespace icome::fonts
