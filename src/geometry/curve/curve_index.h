#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/curve/nearest_on_curve.h"
#include "geometry/tree/box_tree.h"

namespace icome::geometry {

/// Finds the nearest of many curves: they are cut into pieces that are nearly straight, and a tree over the
/// boxes of these leads to the few of which even the chord, as thick as the piece is bent, comes near enough.
/// Only those are solved, over all real roots. Owns copies of the curves. Queries neither allocate nor change
/// anything, so several threads may ask.
class CurveIndex {
 public:
  CurveIndex() = default;
  explicit CurveIndex(std::span<const CubicBezier> curves);

  struct Nearest {
    std::size_t curve = 0;  ///< its place among those given
    NearestOnCurve on_curve;
  };

  /// The nearest place of all curves, if one is less than `within` (m) away; else false. Real-time safe.
  bool nearest(const Vector2& point, double within, Nearest& found) const;
  std::size_t size() const { return curves_.size(); }

 private:
  static constexpr unsigned kWidth = FourBoxes::kCount;
  static constexpr unsigned kMostLevels = 16;  // 4^16 groups

  /// A piece of a curve: the one of that number among so many, which are equally long in t.
  struct Piece {
    std::uint32_t curve;
    std::uint16_t number, count;

    double from() const { return double(number) / count; }
    double to() const { return double(number + 1) / count; }
  };
  /// Four boxes; those of a missing child are empty.
  struct alignas(64) Node {
    FourFloats lo_x, lo_y, hi_x, hi_y;
  };
  /// The chords of four pieces.
  struct Chords {
    FourFloats from_x, from_y, way_x, way_y;
    FourFloats per_way;  // 1 / the way's square, 0 for a point
    FourFloats reach;    // m, by which the piece may be off its chord
  };
  class Search;

  void add_pieces(std::vector<Piece>& pieces, std::vector<FloatBox>& boxes) const;
  void set_chord(std::size_t place);
  void build_tree(std::vector<FloatBox> boxes);
  Vector2 centred(const Vector2& point) const { return point - middle_; }

  std::vector<CubicBezier> curves_;
  Vector2 middle_ = Vector2::Zero();  // single precision counts from here
  float extent_ = 0.0F;               // m, of the coordinates from there
  std::vector<Piece> pieces_;         // neighbours lie near each other
  std::vector<Chords> chords_;        // four pieces each
  std::vector<Node> nodes_;           // level 0, whose children are chords, first; the root last
  std::array<std::uint32_t, kMostLevels> start_{};  // of each level in nodes_
  unsigned levels_ = 0;
};

}  // namespace icome::geometry
