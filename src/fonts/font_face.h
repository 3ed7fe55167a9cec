#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vector.h"

namespace icome::fonts {

/// The shape of a letter, in whole numbers of a font's grid: rings, inside which are the points round which
/// they wind other than 0 times.
using LetterRings = std::vector<std::vector<base::Vector2>>;

/// A font with outlines, opened from a file that fontconfig found; owns the library's face. Lengths are in
/// its grid, which is finer than the units that its letters are drawn in.
class FontFace {
 public:
  /// Opens a font of that family, perhaps with a style. Fails, saying what to install or choose, without one.
  static base::Result<FontFace> open(const std::string& family);

  FontFace(FontFace&&) noexcept;
  FontFace& operator=(FontFace&&) noexcept;
  ~FontFace();

  /// Height of the capital H, or of its stand-in where the font has none; > 0.
  double capital_height() const;
  double line_height() const;

  /// The glyph of a letter; 0 where the font has no such letter.
  std::uint32_t glyph_of(char32_t letter) const;
  /// Distance to the origin of the next letter, to which the kerning of the pair is added.
  double advance(std::uint32_t glyph) const;
  double kerning(std::uint32_t glyph, std::uint32_t next) const;
  /// The letter's shape, its curves as lines that keep to within `tolerance`, > 0. Empty for blank letters.
  LetterRings rings(std::uint32_t glyph, double tolerance) const;
  /// The name of the family.
  const std::string& name() const;

 private:
  struct Impl;
  explicit FontFace(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace icome::fonts
