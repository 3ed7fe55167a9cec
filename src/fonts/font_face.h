#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vector.h"

namespace icome::fonts {

/// What a letter looks like, in whole numbers of a font's grid: rings, the inside of which is where they wind
/// round a point other than 0 times.
using LetterRings = std::vector<std::vector<base::Vector2>>;

/// A font with outlines, opened from a file that fontconfig found; owns the library's face. Lengths are in
/// its grid, which is finer than the units that its letters are drawn in.
class FontFace {
 public:
  /// Of a family, perhaps with a style. Fails, naming the package to install, where there is no such font.
  static base::Result<FontFace> open(const std::string& family);

  FontFace(FontFace&&) noexcept;
  FontFace& operator=(FontFace&&) noexcept;
  ~FontFace();

  /// Of the capital H, or what stands in for it; > 0.
  double capital_height() const;
  double line_height() const;

  /// 0 where the font has no such letter.
  std::uint32_t glyph_of(char32_t letter) const;
  /// How far the next letter stands behind; what pairs need is added.
  double advance(std::uint32_t glyph) const;
  double kerning(std::uint32_t glyph, std::uint32_t next) const;
  /// Curves become lines that keep to within `tolerance`, > 0. Empty where there is nothing to see.
  LetterRings rings(std::uint32_t glyph, double tolerance) const;
  /// As people call it.
  const std::string& name() const;

 private:
  struct Impl;
  explicit FontFace(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace icome::fonts
