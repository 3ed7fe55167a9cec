#pragma once
// Touches CSG solids, and others like them, along random ways and holds every surface contact point (SCP)
// against brute force.
#include <functional>
#include <ostream>

#include "geometry/csg/csg_solid.h"
#include "haptics/csg_brute.h"
#include "haptics/csg_way.h"
#include "haptics/csg_world.h"
#include "haptics/shapes/smooth_shape.h"

namespace icome::haptics {

inline std::shared_ptr<const Shape> shape_of(const CsgTree& tree) {
  return std::make_shared<SmoothShape>(std::make_shared<const geometry::CsgSolid>(tree));
}

/// Free places about a solid and places in it, found by chance.
template <typename Solid>
class PlacePicker {
 public:
  PlacePicker(const Solid& solid, Random& random, double size)
      : solid_(solid), random_(random), size_(size) {}

  Vector3 any(double spread = 0.65) {
    return size_ * Vector3(random_.uniform(-spread, spread), random_.uniform(-spread, spread),
                           random_.uniform(-spread, spread));
  }
  Vector3 free() { return find(false); }
  Vector3 solid() { return find(true); }

 private:
  Vector3 find(bool inside) {
    for (int i = 0; i < 10'000; ++i) {
      const Vector3 place = any();
      if (solid_.inside(place) == inside) return place;
    }
    return any();
  }

  const Solid& solid_;
  Random& random_;
  double size_;
};

/// Presses and slides: from the air straight at some place in the solid until up to a tenth of the size
/// behind its surface, there along a wavy way, holding still now and then, and out again at random.
template <typename Solid>
std::vector<Vector3> random_touch(const Solid& solid, std::uint64_t seed, std::size_t ticks,
                                  double size = 0.1, std::size_t* moves = nullptr) {
  Random random(seed);
  PlacePicker places(solid, random, size);
  std::vector<Vector3> path{places.free()};
  const auto go = [&](const Vector3& to, double step) {
    const Vector3 from = path.back();
    const int count = std::max(1, int((to - from).norm() / step));
    for (int i = 1; i <= count; ++i) path.push_back(from + (double(i) / count) * (to - from));
  };
  while (path.size() < ticks) {
    const double step = size * std::pow(10.0, random.uniform(-3.3, -1.7));
    if (moves) ++*moves;
    if (random.index(2) == 0 || solid.inside(path.back())) go(places.free(), 4.0 * step);
    const Vector3 target = places.solid();
    const Vector3 way = target - path.back();
    double met = 0.0;
    while (met < way.norm() && !solid.inside(path.back() + met / way.norm() * way)) met += 2e-3 * size;
    go(path.back() + std::min(1.0, (met + random.uniform(0.0, 0.1) * size) / way.norm()) * way, 2.0 * step);
    for (int leg = int(random.index(6)); leg >= 0; --leg) {
      const Vector3 along = random.direction(), aside = random.direction();
      if (moves) ++*moves;
      const double length = size * random.uniform(0.0, 0.4), wave = random.uniform(0.0, 0.03) * size;
      const Vector3 from = path.back();
      const int count = 1 + int(length / step);
      for (int i = 1; i <= count; ++i) {
        path.push_back(from + i * step * along + wave * std::sin(10.0 * i / count) * aside);
      }
      for (std::uint64_t rest = random.index(2) * 3; rest > 0; --rest) path.push_back(path.back());
    }
  }
  path.resize(ticks);
  return path;
}

/// What was wrong with a tick.
struct TouchFailure {
  enum Kind { None, Unconverged, Inside, Popped, Wrong, Moving } kind = None;
  std::size_t tick = 0;
  Vector3 tip, scp, last;  // m
  double amount = 0.0;     // m

  const char* name() const {
    constexpr std::array<const char*, 6> kNames{"none", "unconverged", "inside", "popped", "wrong", "moving"};
    return kNames[std::size_t(kind)];
  }
  friend std::ostream& operator<<(std::ostream& out, const TouchFailure& it) {
    const Eigen::IOFormat exact(17, 0, ", ", ", ", "", "", "{", "}");
    return out << it.name() << " by " << it.amount << " m in tick " << it.tick << ": tip "
               << it.tip.transpose().format(exact) << ", SCP " << it.scp.transpose().format(exact)
               << ", before " << it.last.transpose().format(exact);
  }
};

struct TouchCheck {
  double size = 0.1;             // m, of the solid
  std::size_t sample = 50;       // every so many ticks the place is compared with brute force
  double max_error = 1e-5;       // of the size: 1 um at 0.1 m
  double max_inside = 1e-9;      // of the size
  Pose pose = Pose::Identity();  // of the solid in the world
  std::function<void(const TouchFailure&)> report = {};
};

/// Figures of a run.
struct TouchFigures {
  std::size_t touching = 0, compared = 0, failures = 0;
  double largest_error = 0.0;  // m
  std::vector<Vector3> scps;
};

/// Follows one tip (in the solid's frame), tick by tick, and checks. A solid has the functions of BruteSolid,
/// or its own brute_way() and brute_scp_error().
template <typename Solid>
class CheckedTouch {
 public:
  CheckedTouch(Solid solid, std::shared_ptr<const Shape> shape, const TouchCheck& check)
      : check_(check),
        solid_(std::move(solid)),
        toucher_(HapticScene::compile({object(1, std::move(shape), check.pose)})) {}
  CheckedTouch(const CsgTree& tree, const TouchCheck& check)
      : CheckedTouch(BruteSolid(tree), shape_of(tree), check) {}

  const TouchFigures& run(const std::vector<Vector3>& path) {
    for (const Vector3& tip : path) tick(tip);
    return figures_;
  }

 private:
  void tick(const Vector3& tip) {
    ScpState state = toucher_.step(check_.pose * tip);
    state.scp = state.touching ? check_.pose.inverse() * state.scp : tip;
    const std::size_t number = figures_.scps.size();
    const Vector3 last = figures_.scps.empty() ? state.scp : figures_.scps.back();
    const auto fail = [&](TouchFailure::Kind kind, double amount) {
      ++figures_.failures;
      if (check_.report) check_.report({kind, number, tip, state.scp, last, amount});
    };
    figures_.scps.push_back(state.scp);
    figures_.touching += state.touching;
    if (!state.converged) fail(TouchFailure::Unconverged, state.iterations);
    const double depth = -solid_.bound(state.scp);
    if (depth > check_.max_inside * check_.size) return fail(TouchFailure::Inside, depth);
    if (number > 0 && brute_way(solid_, last, state.scp, tip, check_.size) == Way::None)
      fail(TouchFailure::Popped, (state.scp - last).norm());
    const bool held = number > 0 && tip == last_tip_;
    if (held && was_converged_ && (state.scp - last).norm() > check_.max_error * check_.size)
      fail(TouchFailure::Moving, (state.scp - last).norm());
    last_tip_ = tip;
    was_converged_ = state.converged;
    if (check_.sample > 0 && number % check_.sample == 0 && state.touching && state.converged)
      compare(tip, state.scp, fail);
  }

  template <typename Fail>
  void compare(const Vector3& tip, const Vector3& scp, Fail&& fail) {
    const ScpError found = brute_scp_error(solid_, tip, scp, check_.size);
    ++figures_.compared;
    figures_.largest_error = std::max(figures_.largest_error, found.error);
    if (found.inside > check_.max_inside * check_.size) fail(TouchFailure::Inside, found.inside);
    if (found.error > check_.max_error * check_.size) fail(TouchFailure::Wrong, found.error);
  }

  TouchCheck check_;
  Solid solid_;
  Toucher toucher_;
  TouchFigures figures_;
  Vector3 last_tip_ = Vector3::Zero();
  bool was_converged_ = true;
};

CheckedTouch(const CsgTree&, const TouchCheck&)->CheckedTouch<BruteSolid>;

}  // namespace icome::haptics
