#include <algorithm>
#include <array>
#include <cmath>

#include "haptics/judge/contact_witness.h"

namespace icome::haptics {
namespace {

using base::Vector3;

constexpr int kHalvings = 40;

/// Directions to all neighbours of a cell, unit: every place of the sphere is within 28 degrees of one.
std::array<Vector3, 26> all_around() {
  std::array<Vector3, 26> result;
  std::size_t count = 0;
  for (int i = 0; i < 27; ++i) {
    if (i != 13) result[count++] = Vector3(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1).normalized();
  }
  return result;
}

/// Looks at samples only: along ways and around places.
class MembershipWitness final : public Witness {
 public:
  MembershipWitness(const MembershipSolid& solid, const Resolution& resolution)
      : solid_(solid), resolution_(resolution), around_(all_around()) {}

  void set_time(double time) override { time_ = time; }

  bool solid() const override { return true; }
  bool inside(const Vector3& point) const override {
    return solid_.bounds.contains(point) && solid_.inside(point, time_);
  }

  std::optional<Block> blocked(const Vector3& a, const Vector3& b) const override {
    const std::optional<Stretch> hit = first_hit_of(a, b);
    if (!hit) return std::nullopt;
    const Vector3 step = b - a;
    const double t = change(a, step, hit->free, hit->solid);
    const Vector3 normal = normal_at(a + t * step, step);
    return Block{t, normal.dot(step) < 0.0 ? normal : Vector3(-step.normalized())};
  }

  bool passes(const Vector3& a, const Vector3& b) const override { return !first_hit_of(a, b); }

  double distance(const Vector3& point, double limit) const override {
    const bool here = inside(point);
    double least = limit;
    for (const Vector3& direction : around_) {
      for (const double share : {0.5, 1.0}) {
        if (inside(point + share * least * direction) == here) continue;
        least *= share * change(point, share * least * direction, 0.0, 1.0);
        break;
      }
    }
    return least;
  }

  double least_distance(const Vector3&, double) const override { return 0.0; }

  double overlap(const Vector3& point, double radius) const override {
    if (inside(point)) return radius;
    // The nearest of the coarse directions, then ever finer ones around it.
    Vector3 nearest = Vector3::Zero();
    double least = radius;
    const auto look_at = [&](const Vector3& place) {
      if (!inside(place)) return;
      const Vector3 way = place - point;
      const double there = change(point, way, 0.0, 1.0) * way.norm();
      if (there < least) nearest = way.normalized();
      least = std::min(least, there);
    };
    const auto look = [&](const Vector3& direction) { look_at(point + least * direction); };
    for (const Vector3& direction : around_) look(direction);
    if (solid_.nearest) {  // parts between the directions, or that end within the ball, too
      if (const auto place = nearest_place(point, least, radius)) look_at(*place);
    }
    for (double angle = 0.3; angle > 1e-4 && least < radius; angle *= 0.6) {
      const Vector3 side = nearest.unitOrthogonal(), other = nearest.cross(side), centre = nearest;
      for (int i = 0; i < 6; ++i) {
        const double turn = 1.0471975511965976 * i;
        look((centre + angle * (std::cos(turn) * side + std::sin(turn) * other)).normalized());
      }
    }
    return radius - least;
  }

  bool overlaps(const Vector3& point, double radius) const override {
    if (!solid_.nearest) return overlap(point, radius) > 0.0;
    if (inside(point)) return true;
    if (const auto place = nearest_place(point, radius, radius)) return inside(*place);
    return std::ranges::any_of(around_, [&](const Vector3& it) { return inside(point + radius * it); });
  }

  bool deep(const Vector3& point, double depth) const override {
    return inside(point) && distance(point, depth) >= depth;
  }

  std::uint64_t unfinished() const override { return unfinished_; }

 private:
  std::optional<Vector3> nearest_place(const Vector3& point, double limit, double radius) const {
    const auto unfinished = [&] { return solid_.unfinished ? solid_.unfinished() : 0; };
    const std::uint64_t before = unfinished();  // copies of the solid share the count
    const auto place = solid_.nearest(point, time_, limit, fineness(radius));
    unfinished_ += unfinished() - before;
    return place;
  }

  /// Small against walls, and against what a ball of that radius cuts off from an edge.
  double fineness(double radius) const { return std::min(resolution_.wall, 0.02 * radius); }

  /// Shares of a way: free at the one, in the solid at the other.
  struct Stretch {
    double free, solid;
  };

  /// The stretch where a way first goes from free space into the solid. A start behind the surface by noise
  /// counts as free. Near the start the samples are dense, as there an edge may be all that is in the way.
  std::optional<Stretch> first_hit_of(const Vector3& a, const Vector3& b) const {
    const Vector3 step = b - a;
    if (!way_meets_bounds(a, b)) return std::nullopt;
    bool free = !inside(a) || distance(a, 2.0 * resolution_.noise) < 2.0 * resolution_.noise;
    const double length = step.norm();
    double last = 0.0;
    for (double way = std::min(length, 0.5 * resolution_.noise); last < length;) {
      const bool here = inside(a + (way / length) * step);
      if (here && free) return Stretch{last / length, way / length};
      free = free || !here;
      last = way;
      way = std::min({length, 2.0 * way, way + resolution_.wall});
    }
    return std::nullopt;
  }

  bool way_meets_bounds(const Vector3& a, const Vector3& b) const {
    base::Bounds way(a, a);
    way.extend(b);
    return way.intersects(solid_.bounds);
  }

  /// The share of `step` at which membership changes between two shares where it differs.
  double change(const Vector3& start, const Vector3& step, double from, double to) const {
    const bool at_from = inside(start + from * step);
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (from + to);
      (inside(start + middle * step) == at_from ? from : to) = middle;
    }
    return from;
  }

  /// The outward normal of the surface there: a first guess from the free places around, then from the
  /// heights of the surface beside the place.
  Vector3 normal_at(const Vector3& place, const Vector3& step) const {
    const double far = 8.0 * resolution_.noise;
    Vector3 guess = Vector3::Zero();
    for (const Vector3& direction : around_)
      guess += inside(place + far * direction) ? -direction : direction;
    if (guess.norm() < 1e-3) return -step.normalized();
    guess.normalize();
    const Vector3 u = guess.unitOrthogonal(), v = guess.cross(u);
    const auto height = [&](const Vector3& side) {
      return change(place + far * side - 2.0 * far * guess, 4.0 * far * guess, 0.0, 1.0) * 4.0 * far;
    };
    const double slope_u = (height(u) - height(-u)) / (2.0 * far);
    const double slope_v = (height(v) - height(-v)) / (2.0 * far);
    return (guess - slope_u * u - slope_v * v).normalized();
  }

  MembershipSolid solid_;
  Resolution resolution_;
  std::array<Vector3, 26> around_;
  double time_ = 0.0;  // s
  mutable std::uint64_t unfinished_ = 0;
};

}  // namespace

std::unique_ptr<Witness> make_membership_witness(const MembershipSolid& solid, const Resolution& resolution) {
  return std::make_unique<MembershipWitness>(solid, resolution);
}

}  // namespace icome::haptics
