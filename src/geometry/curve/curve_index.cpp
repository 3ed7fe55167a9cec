#include "geometry/curve/curve_index.h"

#include "geometry/tree/hilbert.h"

namespace icome::geometry {
namespace {

// Shorter parts have smaller boxes, so that fewer curves are asked; more than a few make the tree deeper for
// nothing.
constexpr unsigned kPartsOfACurve = 4;

Bounds flat_box(const Bounds2& box) {
  return {Vector3(box.min().x(), box.min().y(), 0.0), Vector3(box.max().x(), box.max().y(), 0.0)};
}

}  // namespace

CurveIndex::CurveIndex(std::span<const CubicBezier> curves) : curves_(curves.begin(), curves.end()) {
  std::vector<Part> parts;
  std::vector<FloatBox> boxes;
  std::vector<Eigen::Vector3f> middles;
  parts.reserve(kPartsOfACurve * curves_.size());
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    for (unsigned k = 0; k < kPartsOfACurve; ++k) {
      const Part part = {std::uint32_t(i), float(k) / float(kPartsOfACurve),
                         float(k + 1) / float(kPartsOfACurve)};
      const Bounds box = flat_box(curves_[i].part(double(part.from), double(part.to)).hull_bounds());
      parts.push_back(part);
      boxes.push_back(float_box(box));
      middles.push_back(box.center().cast<float>());
    }
  }
  const std::vector<std::uint32_t> order = hilbert_order(middles);
  std::vector<FloatBox> leaves;
  leaves.reserve(order.size());
  parts_.reserve(order.size());
  for (const std::uint32_t which : order) {
    leaves.push_back(boxes[which]);
    parts_.push_back(parts[which]);
  }
  tree_ = BoxTree(leaves);
}

bool CurveIndex::nearest(const Vector2& point, double within, Nearest& found) const {
  bool any = false;
  double limit = within * within;
  tree_.nearest(Vector3(point.x(), point.y(), 0.0), limit, [&](std::size_t leaf) {
    const Part& part = parts_[leaf];
    const NearestOnCurve near =
        nearest_on_curve(curves_[part.curve], point, double(part.from), double(part.to));
    if (near.distance_squared < limit) {
      limit = near.distance_squared;
      found = {part.curve, near};
      any = true;
    }
    return limit;
  });
  return any;
}

}  // namespace icome::geometry
