// Straight ways need linear equations only: a corner meets a plane at one time, and so do two lines. Of two
// solids bounded by triangles, inside and outside can change only where a corner goes through a face or an
// edge across an edge (Canny 1986; Redon, Kheddar and Coquillart 2002).
#include "interaction/snapping/touches.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace icome::interaction {
namespace {

using base::Bounds;
using geometry::Corners;
using world::CollisionShape;
using Ball = CollisionShape::Ball;
using HalfSpace = CollisionShape::HalfSpace;

constexpr double kTouchRounding = 1e-10;    // of the largest coordinate, as in world::meeting
constexpr double kArithmetic = 1e-15;       // of the largest coordinate, what one sum may be off
constexpr std::uint64_t kCornersAUnit = 8;  // triangles whose corners are looked at for one unit of effort

double largest_of(const Vector3& vector) { return vector.cwiseAbs().maxCoeff(); }

/// A bound of the factor by which the map stretches lengths.
double stretch_of(const Affine3& map) { return map.linear().norm(); }

Corners placed_corners(const Affine3& frame, const Corners& corners) {
  return {frame * corners[0], frame * corners[1], frame * corners[2]};
}

Bounds box_of(const Corners& corners) {
  Bounds box(corners[0]);
  return box.extend(corners[1]).extend(corners[2]);
}

/// The times at which a t^2 + 2 b t + c is zero; none where it only touches zero.
std::array<double, 2> roots(double a, double b, double c) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0.0) || a == 0.0) return {kNone, kNone};
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  return {q / a, c / q};
}

/// The search for the touches of one passing.
class TouchSearch {
 public:
  TouchSearch(const Passing& passing, double from, double until,
              base::FunctionRef<double(const Touch&)> visit)
      : passing_(passing),
        from_(from),
        until_(until),
        visit_(visit),
        rounding_(rounding_of(passing, until)),
        arithmetic_(kArithmetic / kTouchRounding * rounding_) {}

  void run() {
    const auto one = passing_.moved->half_space(passing_.world_from_moved);
    const auto other = passing_.other->half_space(passing_.world_from_other);
    const Side moved{*passing_.moved, passing_.world_from_moved, passing_.step};
    const Side standing{*passing_.other, passing_.world_from_other, -passing_.step};
    if (one && other) return of_half_spaces(*one, *other);
    if (one) return of_half_space(*one, turned(standing));
    if (other) return of_half_space(*other, moved);
    const auto ball = moved.shape.ball(moved.place), other_ball = standing.shape.ball(standing.place);
    if (ball && other_ball) return around(ball->centre, moved.step, other_ball->centre, *ball, *other_ball);
    if (ball) return of_ball(*ball, moved.step, standing);
    if (other_ball) return of_ball(*other_ball, turned(standing).step, moved);
    if (standing.shape.triangle_tree().size() < moved.shape.triangle_tree().size())
      of_triangles(turned(standing), moved);
    else
      of_triangles(moved, standing);
  }

 private:
  /// One of the two, as it goes past the other.
  struct Side {
    CollisionShape& shape;
    const Affine3& place;
    Vector3 step;
  };

  /// Lets the standing shape go past the moved one: touches are then found in the frame of the moved one.
  const Side& turned(const Side& standing) {
    frame_step_ = passing_.step;
    return standing;
  }

  bool may_go_on(std::uint64_t units = 1) { return !passing_.effort || passing_.effort->spend(units); }

  void add(double share, const Vector3& normal, const Vector3& place) {
    if (!(share >= from_ && share <= until_)) return;
    const Vector3 against = normal.dot(passing_.step) > 0.0 ? Vector3(-normal) : normal;
    until_ = std::min(until_, visit_({share, against, place + share * frame_step_}));
  }

  void of_half_spaces(const HalfSpace& one, const HalfSpace& other) {
    if ((one.normal + other.normal).cwiseAbs().maxCoeff() >= 1e-12) return;
    cross_plane(other.normal.dot(one.foot - other.foot), other.normal, passing_.step, one.foot);
  }

  /// Adds the touch of a point that is `height` (m) above a plane and goes by `step`.
  void cross_plane(double height, const Vector3& normal, const Vector3& step, const Vector3& place) {
    const double speed = normal.dot(step), share = -height / speed;
    if (std::abs(speed) > rounding_) add(share, normal, place + share * step);
  }

  void of_half_space(const HalfSpace& space, const Side& side) {
    const auto height = [&](const Vector3& point) { return space.normal.dot(point - space.foot); };
    double lowest = std::numeric_limits<double>::infinity();
    Vector3 place = side.place.translation();
    if (const auto ball = side.shape.ball(side.place)) {
      lowest = height(ball->centre) - ball->radius;
      place = ball->centre - ball->radius * space.normal;
    } else {
      const geometry::TriangleTree& tree = side.shape.triangle_tree();
      if (!may_go_on(tree.size() / kCornersAUnit)) return;
      for (std::uint32_t slot = 0; slot < tree.size(); ++slot) {
        for (const Vector3& corner : tree.corners(slot)) {
          const Vector3 there = side.place * corner;
          if (!(height(there) < lowest)) continue;
          lowest = height(there);
          place = there;
        }
      }
    }
    if (std::isfinite(lowest)) cross_plane(lowest, space.normal, side.step, place);
  }

  void around(const Vector3& point, const Vector3& step, const Vector3& centre, const Ball& one,
              const Ball& other) {
    cross_sphere(point, step, centre, one.radius + other.radius, other.radius);
  }

  /// Adds the touches of a point with a sphere; their places are `inner` (m) off the centre.
  void cross_sphere(const Vector3& point, const Vector3& step, const Vector3& centre, double radius,
                    double inner) {
    const Vector3 offset = point - centre;
    const double a = step.squaredNorm(), b = offset.dot(step);
    for (const double share : roots(a, b, (offset.norm() - radius) * (offset.norm() + radius))) {
      const Vector3 normal = (offset + share * step).normalized();
      add(share, normal, centre + inner * normal);
    }
  }

  void of_ball(const Ball& ball, const Vector3& step, const Side& mesh) {
    const geometry::TriangleTree& tree = mesh.shape.triangle_tree();
    const Affine3 mesh_from_world = mesh.place.inverse();
    if (!mesh_from_world.matrix().allFinite()) return;
    const double reach = (ball.radius + 2.0 * rounding_) * stretch_of(mesh_from_world);
    tree.near(mesh_from_world * Vector3(ball.centre + from_ * step),
              mesh_from_world * Vector3(ball.centre + until_ * step), reach, [&](std::uint32_t slot) {
                ball_on_triangle(ball, step, placed_corners(mesh.place, tree.corners(slot)));
                return may_go_on();
              });
  }

  void ball_on_triangle(const Ball& ball, const Vector3& step, const Corners& corners) {
    const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    const double speed = normal.dot(step), height = normal.dot(ball.centre - corners[0]);
    if (std::abs(speed) > rounding_) {
      for (const double radius : {ball.radius, -ball.radius}) {
        const double share = (radius - height) / speed;
        const Vector3 place = ball.centre + share * step - radius * normal;
        if (covers(corners, normal, place, slack(step, speed))) add(share, normal, place);
      }
    }
    for (int i = 0; i < 3; ++i) {
      cross_sphere(ball.centre, step, corners[i], ball.radius, 0.0);
      ball_on_edge(ball, step, corners[i], corners[(i + 1) % 3]);
    }
  }

  void ball_on_edge(const Ball& ball, const Vector3& step, const Vector3& from, const Vector3& to) {
    const double length = (to - from).norm();
    if (length <= 0.0) return;
    const Vector3 along = (to - from) / length;
    const auto across = [&](const Vector3& vector) { return Vector3(vector - vector.dot(along) * along); };
    const Vector3 offset = across(ball.centre - from), speed = across(step);
    const double c = (offset.norm() - ball.radius) * (offset.norm() + ball.radius);
    for (const double share : roots(speed.squaredNorm(), offset.dot(speed), c)) {
      const double place = along.dot(ball.centre + share * step - from);
      if (place >= -2.0 * rounding_ && place <= length + 2.0 * rounding_)
        add(share, (offset + share * speed).normalized(), from + place * along);
    }
  }

  /// The bounds of a box on the part of its way that is searched.
  Bounds on_its_way(const Bounds& box, const Vector3& step) const {
    return box.translated(from_ * step).merged(box.translated(until_ * step));
  }

  /// The triangles of one that come near the other's box, each against the other's on its way.
  void of_triangles(const Side& one, const Side& other) {
    const geometry::TriangleTree& tree = one.shape.triangle_tree();
    const Affine3 one_from_world = one.place.inverse(), other_from_world = other.place.inverse();
    if (!one_from_world.matrix().allFinite() || !other_from_world.matrix().allFinite()) return;
    Bounds box = other.shape.bounds().transformed(other.place);
    const Vector3 middle = box.center();
    const double reach = (0.5 * box.diagonal().norm() + 2.0 * rounding_) * stretch_of(one_from_world);
    geometry::SegmentQuery query(one_from_world * Vector3(middle - from_ * one.step),
                                 one_from_world * Vector3(middle - until_ * one.step), reach);
    query.only_in(on_its_way(grown(box, 2.0 * rounding_), -one.step).transformed(one_from_world));
    box = grown(box, 2.0 * rounding_);
    tree.near(query, [&](std::uint32_t slot) {
      const Corners corners = placed_corners(one.place, tree.corners(slot));
      if (on_its_way(box_of(corners), one.step).intersects(box))
        triangle_past(corners, one.step, other, other_from_world);
      return may_go_on();
    });
  }

  void triangle_past(const Corners& corners, const Vector3& step, const Side& other,
                     const Affine3& other_from_world) {
    const geometry::TriangleTree& tree = other.shape.triangle_tree();
    const Vector3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    double reach = 2.0 * rounding_;
    for (const Vector3& corner : corners) reach = std::max(reach, (corner - middle).norm() + 2.0 * rounding_);
    const Bounds here = box_of(corners);
    geometry::SegmentQuery query(other_from_world * Vector3(middle + from_ * step),
                                 other_from_world * Vector3(middle + until_ * step),
                                 reach * stretch_of(other_from_world));
    // Long triangles, and flat ones, fill little of the ball around them.
    const Bounds there =
        on_its_way(box_of(placed_corners(other_from_world, corners)), other_from_world.linear() * step);
    query.only_in(grown(there, 2.0 * rounding_ * stretch_of(other_from_world)));
    tree.near(query, [&](std::uint32_t slot) {
      const Corners facing = placed_corners(other.place, tree.corners(slot));
      if (grown(on_its_way(here, step), 2.0 * rounding_).intersects(box_of(facing)))
        triangles_touch(corners, step, facing);
      return may_go_on();
    });
  }

  void triangles_touch(const Corners& one, const Vector3& step, const Corners& other) {
    corners_through(one, step, other, step);
    corners_through(other, -step, one, Vector3::Zero());
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) edges_cross(one[i], one[(i + 1) % 3], step, other[j], other[(j + 1) % 3]);
    }
  }

  /// `seen`: the step of the points in the frame in which touches are found.
  void corners_through(const Corners& points, const Vector3& step, const Corners& face, const Vector3& seen) {
    const Vector3 normal = (face[1] - face[0]).cross(face[2] - face[0]).normalized();
    const double speed = normal.dot(step);
    if (!(std::abs(speed) > rounding_)) return;
    for (const Vector3& point : points) {
      const double share = -normal.dot(point - face[0]) / speed;
      if (share >= from_ && share <= until_ && covers(face, normal, point + share * step, slack(step, speed)))
        add(share, normal, point + share * seen);
    }
  }

  /// Adds the touch of two edges, but not where one of them ends: that is a corner's touch.
  void edges_cross(const Vector3& from, const Vector3& to, const Vector3& step, const Vector3& other_from,
                   const Vector3& other_to) {
    const Vector3 u = to - from, v = other_to - other_from;
    const Vector3 normal = u.cross(v);
    const double square = normal.squaredNorm();
    if (!(square > 1e-24 * u.squaredNorm() * v.squaredNorm())) return;
    const double norm = std::sqrt(square), speed = normal.dot(step) / norm;
    if (!(std::abs(speed) > rounding_)) return;
    const Vector3 offset = other_from - from;
    const double share = normal.dot(offset) / norm / speed;
    if (!(share >= from_ && share <= until_)) return;
    const Vector3 left = offset - share * step;
    const double s = left.cross(v).dot(normal) / square, r = left.cross(u).dot(normal) / square;
    const double end_s = 0.5 * rounding_ / u.norm(), end_r = 0.5 * rounding_ / v.norm();
    if (s >= end_s && s <= 1.0 - end_s && r >= end_r && r <= 1.0 - end_r)
      add(share, normal / norm, other_from + r * v);
  }

  /// Error (m) of the place where something goes through a plane at that speed: the slower, the less well
  /// the time is known.
  double slack(const Vector3& step, double speed) const {
    return 2.0 * rounding_ + 4.0 * arithmetic_ * step.norm() / std::abs(speed);
  }

  static bool covers(const Corners& face, const Vector3& normal, const Vector3& point, double slack) {
    for (int i = 0; i < 3; ++i) {
      const Vector3 edge = face[(i + 1) % 3] - face[i];
      if (normal.dot(edge.cross(point - face[i])) < -slack * edge.norm()) return false;
    }
    return true;
  }

  const Passing& passing_;
  double from_, until_;
  base::FunctionRef<double(const Touch&)> visit_;
  double rounding_, arithmetic_;          // m
  Vector3 frame_step_ = Vector3::Zero();  // m: step of the frame in which touches are found
};

/// Keeps the first touches in their order.
class FirstTouches {
 public:
  FirstTouches(double from, double until, double apart, std::size_t most)
      : from_(from), until_(until), apart_(apart), most_(most) {}

  /// Returns the share up to which more are wanted.
  double add(const Touch& touch) {
    if (touch.share <= from_ + apart_) return until_;
    auto next = std::lower_bound(kept_.begin(), kept_.end(), touch.share,
                                 [](const Touch& it, double share) { return it.share < share; });
    if (next != kept_.begin() && touch.share - std::prev(next)->share < apart_) return until_;
    if (next != kept_.end() && next->share - touch.share < apart_)
      *next = touch;
    else
      kept_.insert(next, touch);
    if (kept_.size() > most_) kept_.pop_back();
    if (kept_.size() == most_) until_ = std::min(until_, kept_.back().share);
    return until_;
  }

  std::vector<Touch> take() { return std::move(kept_); }

 private:
  double from_, until_, apart_;
  std::size_t most_;
  std::vector<Touch> kept_;
};

}  // namespace

double rounding_of(const Passing& passing, double until) {
  double extent = std::max(largest_of(passing.world_from_moved.translation()),
                           largest_of(passing.world_from_other.translation()));
  extent = std::max(extent, largest_of(passing.world_from_moved_at(until).translation()));
  const auto reach = [&](const CollisionShape& shape, const Affine3& place) {
    if (shape.unlimited() || shape.nothing()) return;
    const Bounds box = shape.bounds().transformed(place);
    extent = std::max({extent, largest_of(box.min()), largest_of(box.max())});
  };
  reach(*passing.moved, passing.world_from_moved);
  reach(*passing.moved, passing.world_from_moved_at(until));
  reach(*passing.other, passing.world_from_other);
  return kTouchRounding * extent;
}

void visit_touches(const Passing& passing, double from, double until,
                   base::FunctionRef<double(const Touch&)> visit) {
  if (passing.moved->nothing() || passing.other->nothing() || !(until >= from)) return;
  TouchSearch(passing, from, until, visit).run();
}

std::vector<Touch> first_touches(const Passing& passing, double from, double until, double apart,
                                 std::size_t most) {
  FirstTouches found(from, until, apart, most);
  const auto keep = [&](const Touch& touch) { return found.add(touch); };
  visit_touches(passing, from, until, keep);
  return found.take();
}

}  // namespace icome::interaction
