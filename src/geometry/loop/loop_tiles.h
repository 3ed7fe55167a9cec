#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "geometry/loop/loop_patches.h"

namespace icome::geometry {

/// The side of a surface on which a ball touches it.
enum class LoopSide : std::uint8_t { Front, Back };

/// A part of a piece of a Loop surface that is so flat, for a ball of a given radius, that no place of the
/// ball's centre has two nearest places on it.
struct LoopTile {
  std::uint32_t piece = 0;
  std::array<Vector2, 3> corners;  // in the piece's u and v
  bool sharp = false;              // does the surface end or bend sharply at its border, or in its corner?
  bool tame = false;               // is it as flat as described above? Else it is only small
  /// Can no ball touch the tile's inside from the front (back), as the surface curves in there more than the
  /// ball?
  std::array<bool, 2> folded = {false, false};
  /// 1/m, the most by which the surface curves in, seen from the front (back).
  std::array<double, 2> bend = {0.0, 0.0};

  // A flat cylinder around it.
  Vector3 centre, axis;          // m; unit, about the normal
  double wide = 0.0;             // m, its radius
  double low = 0.0, high = 0.0;  // m, along the axis from the centre
  double spread = 0.0;           // sine of the largest angle between normal and axis; 1: any

  bool folded_at(LoopSide side) const { return folded[std::size_t(side)]; }
  double bend_at(LoopSide side) const { return bend[std::size_t(side)]; }
  /// The place of the piece at barycentric (1 - a - b, a, b) of the corners.
  Vector2 at(double a, double b) const {
    return corners[0] + a * (corners[1] - corners[0]) + b * (corners[2] - corners[0]);
  }
};

/// All of a Loop surface as tiles for a ball of one radius. Owns them; immutable.
class LoopTiles {
 public:
  static constexpr std::size_t kMost = 1'000'000;

  /// Fails, with the reason as a clause, when there would be more than kMost. `radius`: m, > 0.
  static base::Result<LoopTiles> create(const LoopPatches& patches, double radius);

  std::uint32_t count() const { return std::uint32_t(tiles_.size()); }
  const LoopTile& operator[](std::uint32_t which) const { return tiles_[which]; }
  const BoxTree& tree() const { return tree_; }
  std::size_t bytes() const;

  /// The tile that a place of a piece lies on. Real-time safe.
  std::uint32_t find(std::uint32_t piece, double u, double v) const;

 private:
  class Builder;

  LoopTiles() = default;

  /// A quartic triangle, or a half of one: a tile, or cut in two. The first half follows at once; `second`
  /// is the other one.
  struct Half {
    std::uint32_t tile = 0;
    std::uint32_t second = 0;  // 0: it is a tile
  };

  std::vector<LoopTile> tiles_;
  std::vector<Half> halves_;
  std::vector<std::uint32_t>
      roots_;  // among the halves: of each piece, or of each ring's three parts and the rest
  std::vector<std::uint32_t> first_root_;  // of each piece; one more at the end
  BoxTree tree_;                           // around the tiles
};

}  // namespace icome::geometry
