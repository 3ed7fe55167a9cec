#include "tip_paths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/decompositions.h"
#include "base/random.h"
#include "geometry/tree/triangle_tree.h"

namespace icome::benchmarks {
namespace {

constexpr double kAir = 0.003;  // m, above the surface, where a slide begins

/// Appends the positions from `from` (left out) to `to` at `speed` m/s. `from` is passed by value, as it may
/// be the last of the tips, which move when there is no more room.
void go(std::vector<Vector3>& tips, Vector3 from, Vector3 to, double speed) {
  const int steps = std::max(1, int(std::ceil((to - from).norm() / (speed * kTick))));
  for (int i = 1; i <= steps; ++i) tips.push_back(from + double(i) / steps * (to - from));
}

/// A unit vector at most `angle` (radians) from the unit `axis`, uniform over the cap.
Vector3 near_direction(base::Random& random, const Vector3& axis, double angle) {
  const double cosine = random.uniform(std::cos(angle), 1.0);
  const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
  const Vector3 u = axis.unitOrthogonal();
  const Vector3 v = axis.cross(u);
  return cosine * axis + std::sqrt(1.0 - cosine * cosine) * (std::cos(turn) * u + std::sin(turn) * v);
}

/// A place on the unit sphere that wanders with smoothly random turns.
class Wanderer {
 public:
  Vector3 position = Vector3::UnitX();

  void walk(double angle) {
    if (--until_turn_ <= 0) {
      until_turn_ = 200;
      turning_ = random_.uniform(-0.6, 0.6);
    }
    const Vector3 next = std::cos(angle) * position + std::sin(angle) * heading_;
    const Vector3 ahead = std::cos(angle) * heading_ - std::sin(angle) * position;
    const double turn = turning_ * angle;
    position = next.normalized();
    heading_ = (std::cos(turn) * ahead + std::sin(turn) * position.cross(ahead)).normalized();
  }

 private:
  base::Random random_{11};
  Vector3 heading_ = Vector3(0.0, 0.6, 0.8);
  double turning_ = 0.0;  // of the path, radians a radian
  int until_turn_ = 0;    // ticks
};

/// Unit normal of a face; `otherwise` for a sliver whose normal drowns in rounding.
Vector3 face_normal(const geometry::TriangleMesh& mesh, std::size_t face, const Vector3& otherwise) {
  const Vector3 a = mesh.corner(face, 0);
  const Vector3 normal =
      (mesh.corner(face, 1) - a).stableNormalized().cross((mesh.corner(face, 2) - a).stableNormalized());
  return normal.norm() > 1e-9 ? normal.normalized() : otherwise;
}

/// Direction of a vector's part along a surface with that unit normal; any one where nothing is left.
Vector3 along(const Vector3& vector, const Vector3& normal) {
  const Vector3 rest = vector - vector.dot(normal) * normal;
  return rest.norm() > 1e-6 ? rest.normalized() : normal.unitOrthogonal();
}

}  // namespace

double BumpySphere::surface(const Vector3& direction) const {
  return radius * (1.0 + bump_height * std::sin(bumps * direction.x()) * std::sin(bumps * direction.y()) *
                             std::sin(bumps * direction.z()));
}

std::vector<Vector3> slide_path(const BumpySphere& sphere, double speed, double depth, std::size_t ticks) {
  Wanderer wanderer;
  std::vector<Vector3> tips;
  tips.reserve(ticks);
  double below = -kAir;
  while (tips.size() < ticks) {
    tips.push_back(wanderer.position * (sphere.surface(wanderer.position) - below));
    below = std::min(depth, below + speed * kTick);
    wanderer.walk(speed * kTick / sphere.radius);
  }
  return tips;
}

std::vector<Vector3> mesh_walk_path(const geometry::TriangleMesh& mesh, double speed, double depth,
                                    std::size_t ticks) {
  constexpr double kStep = 0.0005;  // m, on the surface
  constexpr double kTurn = 0.25;    // rad, the largest of a step
  const geometry::TriangleTree tree(mesh);
  base::Random random(5);
  geometry::MeshHit at{.point = *std::max_element(mesh.positions.begin(), mesh.positions.end(),
                                                  [](const auto& a, const auto& b) { return a.z() < b.z(); }),
                       .triangle = 0,
                       .parameter = 0.0};
  at = *tree.nearest(at.point);
  Vector3 normal = face_normal(mesh, at.triangle, Vector3::UnitZ());
  Vector3 heading = along(random.direction(), normal);
  std::vector<Vector3> tips{at.point + kAir * Vector3::UnitZ()};
  go(tips, tips.back(), at.point - depth * normal, speed);
  while (tips.size() < ticks) {
    const geometry::MeshHit next = *tree.nearest(at.point + kStep * heading);
    if ((next.point - at.point).norm() < 0.1 * kStep) heading = random.direction();
    at = next;
    normal = face_normal(mesh, at.triangle, normal);
    const double turn = random.uniform(-kTurn, kTurn);
    heading = along(std::cos(turn) * heading + std::sin(turn) * normal.cross(heading), normal);
    go(tips, tips.back(), at.point - depth * normal, speed);
  }
  tips.resize(ticks);
  return tips;
}

std::vector<Vector3> stab_path(const BumpySphere& sphere, double depth, int stabs) {
  constexpr double kLength = 0.02;       // m
  constexpr double kClear = 0.075;       // m from the origin: above every start
  constexpr double kTravelSpeed = 10.0;  // m/s
  constexpr int kTravelSteps = 14;
  base::Random random(23);
  std::vector<Vector3> tips{kClear * Vector3::UnitX()};
  for (int i = 0; i < stabs; ++i) {
    const Vector3 up = random.direction();
    const Vector3 deepest = up * (sphere.surface(up) - depth);
    const Vector3 start = deepest + kLength * near_direction(random, up, 0.25 * std::numbers::pi);
    const Vector3 from = tips.back().normalized();
    const auto turn = base::rotation_between(from, start.normalized());
    go(tips, tips.back(), kClear * from, kTravelSpeed);
    for (int step = 1; step <= kTravelSteps; ++step) {
      const double part = double(step) / kTravelSteps;
      tips.push_back(kClear * (base::Quaternion::Identity().slerp(part, turn) * from));
    }
    const double speed = random.uniform(0.1, 2.0);
    go(tips, tips.back(), start, kTravelSpeed);
    go(tips, start, deepest, speed);
    go(tips, deepest, start, speed);
  }
  return tips;
}

Presses press_path(double face, double depth, double half, int presses) {
  constexpr double kAbove = 0.005;  // m
  constexpr int kHold = 20;         // ticks
  base::Random random(37);
  Presses result;
  for (int i = 0; i < presses; ++i) {
    const Vector3 deepest(random.uniform(-half, half), random.uniform(-half, half), face - depth);
    const Vector3 up = near_direction(random, Vector3::UnitZ(), std::numbers::pi / 6.0);
    const Vector3 start = deepest + up * ((depth + kAbove) / up.z());
    const double speed = random.uniform(0.1, 2.0);
    result.starts.push_back(result.tips.size());
    result.tips.push_back(start);
    go(result.tips, start, deepest, speed);
    result.tips.insert(result.tips.end(), kHold, deepest);
    go(result.tips, deepest, start, speed);
  }
  return result;
}

Visits visit_path(const std::vector<Vector3>& tops, double depth, std::size_t ticks) {
  constexpr double kAround = 0.002;     // m, radius of the circle
  constexpr double kSpeed = 0.1;        // m/s, on the circle
  constexpr double kTravelSpeed = 2.0;  // m/s
  constexpr int kCircleTicks = 1000;
  const Vector3 above(0.0, 0.0, 0.005);
  base::Random random(41);
  Visits result;
  Vector3 last = tops.front() + above;
  while (result.tips.size() < ticks) {
    const std::size_t place = random.index(tops.size());
    const auto on_circle = [&](int tick) {
      const double angle = tick * kSpeed * kTick / kAround;
      return Vector3(tops[place] + kAround * Vector3(std::cos(angle), std::sin(angle), 0.0) -
                     depth * Vector3::UnitZ());
    };
    go(result.tips, last, on_circle(0) + above, kTravelSpeed);
    go(result.tips, result.tips.back(), on_circle(0), kTravelSpeed);
    for (int tick = 1; tick <= kCircleTicks; ++tick) result.tips.push_back(on_circle(tick));
    last = result.tips.back() + above;
    go(result.tips, result.tips.back(), last, kTravelSpeed);
    result.places.resize(result.tips.size(), place);
  }
  result.tips.resize(ticks);
  result.places.resize(ticks);
  return result;
}

}  // namespace icome::benchmarks
