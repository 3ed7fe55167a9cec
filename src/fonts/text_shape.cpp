#include "fonts/text_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <clipper.hpp>
#include <limits>
#include <map>
#include <vector>

#include "base/utf8.h"
#include "fonts/font_face.h"
#include "geometry/sweep/outline.h"
#include "geometry/sweep/profile.h"

namespace icome::fonts {
namespace {

using base::Vector2;
using ClipperLib::cInt;

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
  ClipperLib::Paths take() { return std::move(all_); }
  std::size_t lines() const { return lines_; }

 private:
  void add(std::uint32_t glyph) {
    if (last_ != 0) pen_ += face_.kerning(last_, glyph);
    last_ = glyph;
    const auto [found, is_new] = known_.try_emplace(glyph);
    if (is_new) found->second = face_.rings(glyph, tolerance_);
    for (const auto& ring : found->second) {
      ClipperLib::Path path;
      for (const Vector2& at : ring) {
        path.emplace_back(cInt(at.x() + pen_), cInt(at.y()));
        low_ = std::min(low_, path.back().X);
        high_ = std::max(high_, path.back().X);
      }
      line_.push_back(std::move(path));
    }
    pen_ += face_.advance(glyph);
  }

  void end_line() {
    const cInt middle = line_.empty() ? 0 : low_ + (high_ - low_) / 2;
    const auto down = cInt(double(lines_) * face_.line_height());
    for (ClipperLib::Path& path : line_) {
      for (ClipperLib::IntPoint& point : path) point = {point.X - middle, point.Y - down};
      all_.push_back(std::move(path));
    }
    ++lines_;
    line_.clear();
    pen_ = 0.0;
    last_ = 0;
    low_ = std::numeric_limits<cInt>::max();
    high_ = std::numeric_limits<cInt>::min();
  }

  const FontFace& face_;
  const double tolerance_;
  std::map<std::uint32_t, LetterRings> known_;
  ClipperLib::Paths all_, line_;
  std::size_t lines_ = 0;
  double pen_ = 0.0;
  std::uint32_t last_ = 0;
  cInt low_ = std::numeric_limits<cInt>::max(), high_ = std::numeric_limits<cInt>::min();
};

std::vector<Vector2> ring_of(const ClipperLib::Path& path, bool counter_clockwise) {
  std::vector<Vector2> ring;
  ring.reserve(path.size());
  for (const auto& point : path) ring.emplace_back(double(point.X), double(point.Y));
  if (ClipperLib::Orientation(path) != counter_clockwise) std::reverse(ring.begin(), ring.end());
  return ring;
}

/// The area that the rings cover, as pieces that do not overlap.
std::vector<geometry::Outline> united(const ClipperLib::Paths& paths) {
  ClipperLib::Clipper clipper;
  clipper.StrictlySimple(true);
  clipper.AddPaths(paths, ClipperLib::ptSubject, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  std::vector<geometry::Outline> pieces;
  for (const ClipperLib::PolyNode* node = tree.GetFirst(); node; node = node->GetNext()) {
    if (node->IsHole()) continue;
    geometry::Outline piece{ring_of(node->Contour, true)};
    for (const ClipperLib::PolyNode* hole : node->Childs)
      piece.holes.push_back(ring_of(hole->Contour, false));
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

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
