#include "apps/exploration.h"

#include <algorithm>
#include <cmath>

#include "apps/surface_probe.h"

namespace icome::apps {
namespace {

using base::Vector3;

constexpr double kPi = 3.14159265358979323846;
constexpr double kStep = 0.002;  // s between the targets of the table

// A person's hand on an object of 0.1 m moves at some 70 mm/s and no faster than 0.3 m/s on a large one.
constexpr double kSizesPerSecond = 0.7;
constexpr double kFastest = 0.3;  // m/s

// A hand of 300 N/m that wants to be 4 mm below a stiff surface presses with about 1 N, which every
// device can hold; small objects are pressed less.
constexpr double kDeepest = 0.004;      // m
constexpr double kDepthOfSize = 0.04;   // of the model's size
constexpr double kStartSeconds = 0.15;  // s of way through the air: where the hand comes from

// Around an edge the way below the surface leads where the contact cannot follow. A hand that has got
// this many depths away from its contact lifts, and comes down again where it wants to be.
constexpr double kLostDepths = 2.0;
constexpr double kLiftDepths = 1.0;

constexpr double kPolarRim = 25.0 * kPi / 180.0;  // rad, the spiral's first and last circle
constexpr double kSheetShare = 0.85;              // how far towards a sheet's rim
constexpr double kMostTurns = 20.0;
constexpr int kSamplesPerTurn = 360;
constexpr int kSmoothing = 4;  // samples to either side

/// A line of sight.
struct Sight {
  Vector3 from, to;
  Vector3 near;  // where to feel for the surface when nothing is in sight
};

/// How far a spiral goes: a whole one has at least a turn, and a short way does not reach its end.
struct SpiralLength {
  double turns;  // of the whole spiral
  double share;  // of it to go

  /// For a way of `length` m on a spiral that takes `per_turn` m a turn.
  SpiralLength(double length, double per_turn)
      : turns(std::clamp(length / per_turn, 1.0, kMostTurns)),
        share(std::min(1.0, length / (per_turn * turns))) {}
};

/// Lines of sight along a spiral from pole to pole, towards the middle and beyond.
class RoundSpiral {
 public:
  RoundSpiral(const SurfaceProbe& probe, double length)
      : centre_(probe.bounds().center()),
        radius_(0.5 * probe.bounds().diagonal().norm()),
        // The circles of latitude of a sphere measure 4 radii on average.
        length_(length, 2.0 * probe.bounds().sizes().mean()) {}

  const SpiralLength& length() const { return length_; }

  Sight at(double share) const {
    const double polar = kPolarRim + share * (kPi - 2.0 * kPolarRim);
    const double angle = 2.0 * kPi * length_.turns * share;
    const Vector3 way(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar));
    return {centre_ + 2.0 * radius_ * way, centre_ - 2.0 * radius_ * way, centre_ + radius_ * way};
  }

 private:
  Vector3 centre_;
  double radius_;
  SpiralLength length_;
};

/// Parallel lines of sight onto a sheet, along a flat spiral from its middle outwards.
class FlatSpiral {
 public:
  FlatSpiral(const SurfaceProbe& probe, double length)
      : centre_(probe.bounds().center()),
        back_(probe.bounds().diagonal().norm() * probe.front()),
        right_(reach(probe, right_of(probe.front()))),
        up_(reach(probe, probe.front().cross(right_of(probe.front())))),
        length_(length, 0.5 * kPi * (right_.norm() + up_.norm())) {}

  const SpiralLength& length() const { return length_; }

  Sight at(double share) const {
    const double angle = 2.0 * kPi * length_.turns * share;
    const Vector3 place = centre_ + share * (std::cos(angle) * right_ + std::sin(angle) * up_);
    return {place + back_, place - back_, place};
  }

 private:
  /// A direction across `front`; one of the world's axes where that is possible, as most sheets lie along
  /// them.
  static Vector3 right_of(const Vector3& front) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(front[axis]) < 1e-9) return Vector3::Unit(axis);
    }
    return front.unitOrthogonal();
  }

  /// From the middle nearly to the rim.
  static Vector3 reach(const SurfaceProbe& probe, const Vector3& direction) {
    return kSheetShare * 0.5 * probe.bounds().sizes().dot(direction.cwiseAbs()) * direction;
  }

  Vector3 centre_;
  Vector3 back_;
  Vector3 right_, up_;
  SpiralLength length_;
};

/// Each point replaced by the mean of its neighbours: rough surfaces and jumps become ways a hand takes.
std::vector<Vector3> smoothed(const std::vector<Vector3>& points) {
  std::vector<Vector3> result(points.size());
  const int count = static_cast<int>(points.size());
  for (int i = 0; i < count; ++i) {
    const int reach = std::min({kSmoothing, i, count - 1 - i});
    Vector3 sum = Vector3::Zero();
    for (int k = i - reach; k <= i + reach; ++k) sum += points[static_cast<std::size_t>(k)];
    result[static_cast<std::size_t>(i)] = sum / (2.0 * reach + 1.0);
  }
  return result;
}

/// Where the hand shall press: places of the surface, and how deep it wants to be there.
struct PressPlan {
  std::vector<ProbedPoint> places;
  std::vector<Vector3> targets;  // one each place
  double depth = 0.0;            // m
  Vector3 first_seen;            // m, the first place that was seen
  Vector3 to_eye;                // unit, from there to where it was seen from: through free space
};

/// The places that a spiral's lines of sight meet.
template <typename Spiral>
PressPlan press_along(const Spiral& spiral, const SurfaceProbe& probe) {
  PressPlan plan;
  plan.depth = std::min(kDeepest, kDepthOfSize * probe.bounds().sizes().maxCoeff());
  const auto count = static_cast<std::size_t>(spiral.length().turns * kSamplesPerTurn) + 2;
  std::vector<Sight> sights(count);
  std::vector<Vector3> seen(count);
  for (std::size_t i = 0; i < count; ++i) {
    sights[i] = spiral.at(spiral.length().share * static_cast<double>(i) / static_cast<double>(count - 1));
    seen[i] = probe.look(sights[i].from, sights[i].to, sights[i].near).point;
  }
  plan.first_seen = seen.front();
  plan.to_eye = (sights.front().from - seen.front()).normalized();
  // From one part of the model to another the smoothed way may lead far inside or outside: back to the
  // surface, and from there to the depth.
  seen = smoothed(seen);
  for (std::size_t i = 0; i < count; ++i) {
    plan.places.push_back(probe.nearest(seen[i], sights[i].from));
    plan.targets.push_back(plan.places[i].point - plan.depth * plan.places[i].normal);
  }
  plan.targets = smoothed(plan.targets);
  return plan;
}

/// The way from `start` to all targets, tried out on the scene: with a detour through the air wherever
/// the contact is left behind.
std::vector<Vector3> tried_out(const PressPlan& plan, const Vector3& start, const haptics::HapticScene& scene,
                               double tip, haptics::Renderer renderer) {
  haptics::ScpSettings settings;
  settings.tip_radius = tip;
  const std::unique_ptr<haptics::ContactSolver> solver = haptics::make_solver(renderer, settings);
  solver->adopt(scene, {});
  std::vector<Vector3> way;
  const auto go_to = [&](const Vector3& target) -> const haptics::ScpState& {
    way.push_back(target);
    return solver->step(target, 0.0);
  };
  go_to(start);
  const double lift = tip + kLiftDepths * plan.depth;
  for (std::size_t i = 0; i < plan.targets.size(); ++i) {
    const haptics::ScpState contact = go_to(plan.targets[i]);
    if (!contact.touching || (contact.scp - plan.targets[i]).norm() < tip + kLostDepths * plan.depth)
      continue;
    go_to(contact.scp + lift * contact.normal);
    // The contact was left a depth before the edge at the latest: so much further, the edge is cleared.
    const ProbedPoint& place = plan.places[i];
    go_to(contact.scp + lift * contact.normal + (lift + plan.depth) * place.normal);
    go_to(place.point + lift * place.normal);
  }
  return way;
}

}  // namespace

Exploration Exploration::plan(const std::vector<TouchModel>& models, const haptics::HapticScene& scene,
                              double tip, double seconds, haptics::Renderer renderer) {
  const SurfaceProbe probe(models);
  const double speed = std::min(kFastest, kSizesPerSecond * probe.bounds().sizes().maxCoeff());
  const double length = speed * seconds;
  const PressPlan press = probe.front().isZero(0.0) ? press_along(RoundSpiral(probe, length), probe)
                                                    : press_along(FlatSpiral(probe, length), probe);
  const Vector3 start = press.first_seen + (tip + kStartSeconds * speed) * press.to_eye;
  Exploration exploration;
  exploration.centre_ = probe.bounds().center();
  exploration.follow(tried_out(press, start, scene, tip, renderer), speed, seconds);
  return exploration;
}

/// Fills the table with the way at a constant speed: the usual one, or somewhat slower or faster if the
/// way then takes the whole time.
void Exploration::follow(const std::vector<Vector3>& way, double usual_speed, double seconds) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
  const double speed = std::clamp(length / seconds, 0.5 * usual_speed, 1.5 * usual_speed);
  const double step = speed * kStep;
  double before = 0.0;  // m along the way, at way[i - 1]
  double next = 0.0;    // m along the way, of the next target
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double piece = (way[i] - way[i - 1]).norm();
    for (; next < before + piece; next += step) {
      targets_.push_back(way[i - 1] + (next - before) / piece * (way[i] - way[i - 1]));
    }
    before += piece;
  }
  targets_.push_back(way.back());
  if (targets_.size() < 2) targets_.push_back(way.back());
}

Vector3 Exploration::target(double t) const {
  const auto last = static_cast<double>(targets_.size() - 1);
  const double place = std::fmod(t / kStep, 2.0 * last);
  const double folded = std::min(place <= last ? place : 2.0 * last - place, last);
  const auto index = std::min(static_cast<std::size_t>(folded), targets_.size() - 2);
  const double share = folded - static_cast<double>(index);
  return (1.0 - share) * targets_[index] + share * targets_[index + 1];
}

}  // namespace icome::apps
