#pragma once
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "cutout/tracker/tracker.h"

namespace icome::cutout {

/// A colour as sRGB codes it, 0 to 255 each.
struct DrawnColour {
  double blue, green, red;
};
inline constexpr DrawnColour kTableRed{40, 35, 190};
inline constexpr DrawnColour kPaperBlue{180, 80, 40};
inline constexpr DrawnColour kHandSkin{130, 160, 215};

/// Draws simple frames for tests: shapes by covered shares of pixels (8 x 8 places each), a little blur,
/// noise.
class DrawnTable {
 public:
  explicit DrawnTable(const TableView& view, DrawnColour table = kTableRed);

  void triangle(const KnownTriangle& known, const TrianglePose& pose, DrawnColour colour = kPaperBlue);
  /// A convex shape by its corners, mm, in any one sense.
  void convex(const std::vector<base::Vector2>& corners, DrawnColour colour);
  void disc(const base::Vector2& centre, double radius, DrawnColour colour);
  /// The picture, blurred by a 3 x 3 binomial and with noise of that standard deviation.
  Frame frame(double noise, std::uint64_t seed) const;

 private:
  template <typename Inside>
  void draw(const std::vector<base::Vector2>& around, DrawnColour colour, Inside&& inside);

  TableView view_;
  std::vector<DrawnColour> pixels_;  // light, 0 to 1
};

/// Triangles of well different shapes.
KnownTriangles drawn_triangles(std::size_t count);
/// Poses without overlap, all on the table.
std::vector<TrianglePose> scattered(const KnownTriangles& known, const TableView& view, base::Random& random);

}  // namespace icome::cutout
