#include "fonts/text_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "base/utf8.h"
#include "fonts/font_face.h"
#include "fonts/outline_union.h"
#include "geometry/sweep/outline.h"
#include "geometry/sweep/profile.h"

namespace icome::fonts {
namespace {

using base::Vector2;

base::Result<void> check_wish(const std::string& utf8, double height, double depth) {
  const auto good = [](double length) {
    return length >= geometry::kSmallestProfile && length <= geometry::kLargestProfile;
  };
  if (!good(height) || (!good(depth) && depth != 0.0))
    return base::fail(fmt::format("Text is {:g} to {:g} m high and as deep, or 0 m deep: give such lengths.",
                                  geometry::kSmallestProfile, geometry::kLargestProfile));
  constexpr std::size_t kMostBytes = 4;  // of a letter
  if (utf8.size() > kMostBytes * kMostLetters || base::as_utf8(utf8) != utf8 ||
      base::letters_of(utf8).size() > kMostLetters)
    return base::fail(fmt::format("Text must be UTF-8 of at most {} letters: give less.", kMostLetters));
  return {};
}

/// Sets text into lines of rings, in the grid of the font.
class TextSetting {
 public:
  explicit TextSetting(const FontFace& face) : face_(face), tolerance_(face.capital_height() / 1000.0) {}

  base::Result<void> set(const std::vector<char32_t>& letters) {
    for (const char32_t letter : letters) {
      if (letter == U'\r') continue;
      if (letter == U'\n') {
        end_line();
        continue;
      }
      const std::uint32_t glyph = face_.glyph_of(letter);
      if (glyph == 0)
        return base::fail(
            fmt::format("The font \"{}\" has no letter U+{:04X}: leave it out or choose another font.",
                        face_.name(), std::uint32_t(letter)));
      add(glyph);
    }
    end_line();
    return {};
  }

  /// Rings of all letters, each line centred and the first one at y = 0.
  Rings take() { return std::move(all_); }
  std::size_t lines() const { return lines_; }

 private:
  void add(std::uint32_t glyph) {
    if (last_ != 0) pen_ += face_.kerning(last_, glyph);
    last_ = glyph;
    const auto [found, is_new] = known_.try_emplace(glyph);
    if (is_new) found->second = face_.rings(glyph, tolerance_);
    for (const auto& ring : found->second) {
      std::vector<Vector2>& set = line_.emplace_back();
      for (const Vector2& at : ring) {
        set.emplace_back(std::trunc(at.x() + pen_), std::trunc(at.y()));
        low_ = std::min(low_, set.back().x());
        high_ = std::max(high_, set.back().x());
      }
    }
    pen_ += face_.advance(glyph);
  }

  void end_line() {
    const double middle = line_.empty() ? 0.0 : low_ + std::trunc((high_ - low_) / 2.0);
    const double down = std::trunc(double(lines_) * face_.line_height());
    for (std::vector<Vector2>& ring : line_) {
      for (Vector2& at : ring) at -= Vector2(middle, down);
      all_.push_back(std::move(ring));
    }
    ++lines_;
    line_.clear();
    pen_ = 0.0;
    last_ = 0;
    low_ = kNone;
    high_ = -kNone;
  }

  const FontFace& face_;
  const double tolerance_;
  std::map<std::uint32_t, LetterRings> known_;
  Rings all_, line_;
  std::size_t lines_ = 0;
  double pen_ = 0.0;
  std::uint32_t last_ = 0;
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double low_ = kNone, high_ = -kNone;
};

}  // namespace

base::Result<geometry::TriangleMesh> text_shape(const std::string& utf8, double height, double depth,
                                                const std::string& family) {
  if (const auto good = check_wish(utf8, height, depth); !good) return tl::unexpected(good.error());
  const auto face = FontFace::open(family.empty() ? kUsualFont : family);
  if (!face) return tl::unexpected(face.error());
  TextSetting setting(*face);
  if (const auto set = setting.set(base::letters_of(utf8)); !set) return tl::unexpected(set.error());
  const std::vector<geometry::Outline> pieces = united(setting.take());
  if (pieces.empty()) return base::fail("The text has no letter that can be seen: give another.");
  auto mesh = geometry::solid_of_outlines(pieces, depth > 0.0 ? 1.0 : 0.0);
  if (!mesh) return base::fail(fmt::format("The text cannot become a shape: {}.", mesh.error().message));
  const double scale = height / face->capital_height();
  const double up = 0.5 * (double(setting.lines() - 1) * face->line_height() - face->capital_height());
  for (base::Vector3& at : mesh->positions) at = {scale * at.x(), scale * (at.y() + up), depth * at.z()};
  return mesh;
}

}  // namespace icome::fonts
