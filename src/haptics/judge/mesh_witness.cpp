#include <algorithm>
#include <memory>

#include "haptics/judge/contact_witness.h"
#include "haptics/judge/witness_tree.h"
#include "haptics/judge/witness_ways.h"

namespace icome::haptics {
namespace {

using base::Vector3;

class MeshWitness final : public Witness {
 public:
  explicit MeshWitness(const JudgedObject& object)
      : mesh_(std::get<0>(object.surface)),
        tree_(mesh_),
        closed_(object.closed),
        two_sided_(object.two_sided) {}

  std::optional<Block> blocked(const Vector3& a, const Vector3& b) const override {
    double first = 2.0;
    std::uint32_t met = 0;
    const Vector3 step = b - a;
    tree_.along(a, b, [&](std::uint32_t triangle) {
      const std::optional<Crossing> crossed = crossing(tree_.corners(triangle), a, step);
      if (!crossed || !(two_sided_ || crossed->from_front) || crossed->t >= first) return;
      first = crossed->t;
      met = triangle;
    });
    if (first > 1.0) return std::nullopt;
    const Vector3 front = front_of(met).normalized();
    return Block{first, front.dot(step) < 0.0 ? front : Vector3(-front)};
  }

  double distance(const Vector3& point, double limit) const override { return tree_.distance(point, limit); }

  double overlap(const Vector3& point, double radius) const override {
    if (closed_ || two_sided_) return radius - distance(point, radius);
    double deepest = 0.0;  // behind an open front-touched sheet the tip is free
    tree_.around(point, radius, [&](std::uint32_t triangle) {
      const Vector3 nearest = nearest_on(tree_.corners(triangle), point);
      if (front_of(triangle).dot(point - nearest) > 0.0)
        deepest = std::max(deepest, radius - (point - nearest).norm());
    });
    return deepest;
  }

  void touched(const Vector3& point, double radius,
               const std::function<void(const Vector3&)>& visit) const override {
    tree_.around(point, radius, [&](std::uint32_t triangle) {
      const Vector3 nearest = nearest_on(tree_.corners(triangle), point);
      if ((point - nearest).norm() <= radius && (two_sided_ || front_of(triangle).dot(point - nearest) > 0.0))
        visit(nearest);
    });
  }

  bool solid() const override { return closed_ && !two_sided_; }
  bool inside(const Vector3& point) const override { return solid() && winding(tree_, point) > 0; }

  const WitnessWays* ways() const override {
    if (!ways_) ways_ = std::make_unique<const WitnessWays>(tree_, *mesh_, two_sided_);
    return ways_.get();
  }

 private:
  /// The normal of a triangle, as long as twice its area.
  Vector3 front_of(std::uint32_t triangle) const {
    const auto [a, b, c] = tree_.corners(triangle);
    return (b - a).cross(c - a);
  }

  std::shared_ptr<const geometry::TriangleMesh> mesh_;
  WitnessTree tree_;
  mutable std::unique_ptr<const WitnessWays> ways_;
  bool closed_;
  bool two_sided_;
};

}  // namespace

std::unique_ptr<Witness> make_mesh_witness(const JudgedObject& object) {
  return std::make_unique<MeshWitness>(object);
}

}  // namespace icome::haptics
