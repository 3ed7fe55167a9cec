#include "drawn_sheet.h"

#include <algorithm>

#include "base/random.h"

namespace icome::benchmarks {
namespace {

constexpr double kLeastSize = 0.010;  // m
constexpr double kMostSize = 0.040;

drawing::Curve placed(const drawing::Curve& curve, base::Random& random) {
  const geometry::Bounds2 box = curve.bounds();
  const double size = random.uniform(kLeastSize, kMostSize);
  const double scale = size / std::max(1e-6, box.sizes().maxCoeff());
  const Vector2 corner(random.uniform(0.0, kSheetWidth - size), random.uniform(0.0, kSheetHeight - size));
  drawing::Curve moved = curve;  // its width stays as it is
  for (CubicBezier& segment : moved.segments)
    for (Vector2& point : segment.points) point = corner + scale * (point - box.min());
  return moved;
}

}  // namespace

std::vector<drawing::Curve> drawn_sheet(const std::vector<BenchStroke>& strokes, std::size_t count) {
  std::vector<drawing::Curve> fitted;
  for (const BenchStroke& named : strokes) fitted.push_back(sketch::fit_stroke(named.stroke, {}).curve);
  base::Random random(4);
  std::vector<drawing::Curve> sheet;
  for (std::size_t i = 0; i < count; ++i) sheet.push_back(placed(fitted[i % fitted.size()], random));
  return sheet;
}

}  // namespace icome::benchmarks
