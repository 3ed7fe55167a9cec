#include "apps/touch/exploration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "apps/touch/surface_probe.h"
#include "base/random.h"
#include "haptics/effects/effect_text.h"

namespace icome::apps {

/// A piece of the hand's way.
struct Exploration::Leg {
  base::Vector3 to;  // m
  double length;     // m, its time as a length: more than its distance for a rest
  bool presses;      // below the surface
};

namespace {

using base::Vector3;

constexpr double kPi = 3.14159265358979323846;
constexpr double kStep = 0.002;  // s between the targets of the table

// A person's hand on an object of 0.1 m moves at some 70 mm/s and no faster than 0.3 m/s on a large one.
constexpr double kSizesPerSecond = 0.7;
constexpr double kFastest = 0.3;  // m/s

// A hand of 300 N/m that aims 4 mm below a stiff surface presses with about 1 N, which every
// device can hold; small objects are pressed less.
constexpr double kDeepest = 0.004;     // m
constexpr double kDepthOfSize = 0.04;  // of the model's size
constexpr double kStartSeconds = 0.1;  // s of way through the air, before the first landing

constexpr double kMostTurn = 0.7;  // cosine: the surface may turn by 45 degrees along two depths of a stroke
constexpr double kMargin = 1.5;    // depths of a stroke that it stays away from edges
constexpr double kFacing = 0.3;    // cosine: how squarely a place must be seen to be landed on
constexpr double kStrokeOfSize = 0.5;     // shortest stroke, of the model's size
constexpr double kLeastShare = 1e-6;      // of the whole way: no stroke need be shorter
constexpr double kMostSeconds = 120.0;    // of way: longer explorations go to and fro on it
constexpr double kPressesForAir = 3.0;    // least ratio of pressing to flying, in time
constexpr double kAirSpeed = 2.0;         // of flights, against strokes
constexpr int kHalvings = 6;              // of the depth, where there is little room
constexpr int kSides = 8;                 // directions in which room is looked for
constexpr int kPlaces = 400;              // looks for places where the hand may land
constexpr double kSheetShare = 0.85;      // of a sheet, within which the hand lands: off its rim
constexpr std::size_t kDirectTries = 40;  // places tried for a straight way through the air
constexpr int kArcPieces = 12;            // of a way around the models
constexpr std::uint64_t kSeed = 1;

using Leg = Exploration::Leg;

/// A place where the hand can land: seen from outside along a free line.
struct Landing {
  ProbedPoint place;
  Vector3 eye;   // unit, to where it was seen from
  double depth;  // m, how deep the hand presses there: less where there is little room around
};

/// The hand's way, put together of strokes and flights. A stroke lands on a place that can be seen from
/// outside, slides along the smooth patch around it like a billiard ball, turning at edges and at walls, and
/// presses all the time, less deep and slower where there is little room. A flight leads through free space
/// to the next place: straight, or out of the model and around it. The hand flies on when it has pressed for
/// long enough to do so. The plan uses lines of sight only.
class StrokePlanner {
 public:
  StrokePlanner(const SurfaceProbe& probe, double tip)
      : probe_(probe),
        tip_(tip),
        size_(probe.bounds().sizes().maxCoeff()),
        depth_(std::min(kDeepest, kDepthOfSize * size_)),
        lift_(tip + depth_),
        centre_(probe.bounds().center()),
        outside_(0.55 * probe.bounds().diagonal().norm() + lift_),
        random_(kSeed) {
    find_landings();
  }

  /// A way of at least `length` (m) that begins `approach` (m) before its first landing; empty where there is
  /// no place to land.
  std::vector<Leg> way(double length, double approach) {
    if (landings_.empty()) return {};
    const Landing first = landings_.front();
    air(first.place.point + (lift_ + approach) * first.eye);
    land(first);
    stroke(kStrokeOfSize * size_);
    while (gone_ < length) {
      const Landing& to = next();
      const std::size_t before = legs_.size();
      fly(to);
      const double missing = kPressesForAir * flown() - (gone_ - flown());
      if (missing > kLeastShare * length) {  // too soon: first press for longer
        take_back(before);
        stroke(missing);
        continue;
      }
      land(to);
      stroke(kStrokeOfSize * size_);
    }
    return legs_;
  }

 private:
  void find_landings() {
    for (int i = 0; i < kPlaces; ++i) {
      const auto [from, to] = sight();
      const std::optional<ProbedPoint> seen = probe_.look(from, to);
      const Vector3 eye = (from - to).normalized();
      if (!seen || seen->normal.dot(eye) <= kFacing) continue;
      landings_.push_back({*seen, eye, depth_at(*seen)});
    }
    // The hand slides best where there is room: the half with less is left out.
    std::stable_sort(landings_.begin(), landings_.end(),
                     [](const Landing& a, const Landing& b) { return a.depth > b.depth; });
    landings_.resize((landings_.size() + 1) / 2);
  }

  /// The greatest depth that leaves room to slide to most sides.
  double depth_at(const ProbedPoint& place) {
    track_.assign(1, place);
    double deep = depth_;
    for (int halving = 0; halving < kHalvings; ++halving, deep *= 0.5) {
      int open = 0;
      const Vector3 first = place.normal.unitOrthogonal();
      for (int i = 0; i < kSides; ++i) {
        const Vector3 heading = Eigen::AngleAxisd(2.0 * kPi * i / kSides, place.normal) * first;
        open += ahead(heading, deep).has_value() ? 1 : 0;
      }
      if (2 * open > kSides) break;
    }
    return deep;
  }

  /// A line of sight: onto a sheet along its front, else from anywhere outside to anywhere in the models'
  /// box.
  std::pair<Vector3, Vector3> sight() {
    Vector3 to;
    const bool sheet = !probe_.front().isZero(0.0);
    const double share = sheet ? kSheetShare : 1.0;
    for (int axis = 0; axis < 3; ++axis)
      to[axis] = centre_[axis] + 0.5 * share * random_.uniform(-1.0, 1.0) * probe_.bounds().sizes()[axis];
    const Vector3 eye = sheet ? probe_.front() : random_.direction();
    return {to + 2.0 * outside_ * eye, to - 2.0 * outside_ * eye};
  }

  bool free(const Vector3& a, const Vector3& b) const { return !probe_.look(a, b); }
  Vector3 above(const ProbedPoint& place) const { return place.point + lift_ * place.normal; }

  void add(const Vector3& to, double length, bool presses) {
    legs_.push_back({to, length, presses});
    gone_ += length;
  }
  /// Hands move faster through the air.
  void air(const Vector3& to) {
    add(to, legs_.empty() ? 0.0 : (to - legs_.back().to).norm() / kAirSpeed, false);
  }
  double flown() const {
    double length = 0.0;
    for (const Leg& leg : legs_) length += leg.presses ? 0.0 : leg.length;
    return length;
  }
  void take_back(std::size_t legs) {
    for (; legs_.size() > legs; legs_.pop_back()) gone_ -= legs_.back().length;
  }
  void press(const ProbedPoint& place) {
    const Vector3 target = place.point + (tip_ - start_.depth) * place.normal;
    // The less deep the hand presses, the slower it moves, so as not to slip off.
    add(target, (target - legs_.back().to).norm() * depth_ / start_.depth, true);
    track_.push_back(place);
  }

  void land(const Landing& landing) {
    start_ = landing;
    track_.clear();
    visited_.push_back(landing.place.point);
    const Vector3 approach = landing.place.point + (tip_ + landing.depth) * landing.eye;
    air(landing.place.point + lift_ * landing.eye);
    add(approach, depth_, false);
    press(landing.place);
  }

  /// Slides on from the hand's place; rests for the remaining length where it cannot.
  void stroke(double length) {
    const double end = gone_ + length;
    Vector3 heading = tangent(random_.direction(), track_.back().normal);
    while (gone_ < end) {
      const std::optional<ProbedPoint> place = slide(heading);
      if (!place) break;
      press(*place);
      heading = tangent(heading, place->normal);
    }
    if (gone_ < end) add(legs_.back().to, end - gone_, true);
    visited_.push_back(track_.back().point);
  }

  static Vector3 tangent(const Vector3& direction, const Vector3& normal) {
    const Vector3 along = direction - direction.dot(normal) * normal;
    return along.norm() > 1e-3 ? Vector3(along.normalized()) : normal.unitOrthogonal();
  }

  /// The next place ahead, or to a side when there is none; `heading` then turns to it.
  std::optional<ProbedPoint> slide(Vector3& heading) {
    constexpr std::array<double, 8> kTurns{0.0, 0.9, -0.9, 1.7, -1.7, 2.5, -2.5, kPi};
    const Vector3 wanted = heading;
    const double side = random_.uniform() < 0.5 ? -1.0 : 1.0;
    for (const double turn : kTurns) {
      heading = Eigen::AngleAxisd(side * turn, track_.back().normal) * wanted;
      if (const auto place = ahead(heading, start_.depth)) return place;
    }
    return std::nullopt;
  }

  /// The place of the surface a step ahead, unless a wall or an edge comes first, or so soon after it that a
  /// hand that goes on for a bit would slip off.
  std::optional<ProbedPoint> ahead(const Vector3& heading, double depth) const {
    const auto place = smooth_floor(heading, 0.5 * depth, depth);
    return place && smooth_floor(heading, kMargin * depth, depth) ? place : std::nullopt;
  }

  /// The place of the surface `step` (m) ahead, if the way is free and the surface has turned little since.
  std::optional<ProbedPoint> smooth_floor(const Vector3& heading, double step, double depth) const {
    const ProbedPoint& here = track_.back();
    const double lift = tip_ + depth;
    const Vector3 from = here.point + lift * here.normal, to = from + step * heading;
    if (!free(from, to + tip_ * heading)) return std::nullopt;
    const auto floor = probe_.look(to, to - (lift + step) * here.normal);
    if (!floor) return std::nullopt;
    // Below sharp edges the way would lead where the contact cannot follow.
    const std::size_t back = std::min<std::size_t>(track_.size(), 4);
    const bool smooth =
        std::all_of(track_.end() - std::ptrdiff_t(back), track_.end(),
                    [&](const ProbedPoint& it) { return it.normal.dot(floor->normal) > kMostTurn; });
    return smooth ? floor : std::nullopt;
  }

  /// The next landing: far from all that was visited, with a straight way there if possible.
  const Landing& next() const {
    const auto news = [&](const Landing& it) {
      double least = std::numeric_limits<double>::infinity();
      for (const Vector3& place : visited_) least = std::min(least, (place - it.place.point).norm());
      return least;
    };
    // One that is new and can be reached straight through the air is worth more than one farther away.
    const Vector3 from = above(track_.back());
    const Landing* best = nullptr;
    double most = 0.0;
    for (std::size_t i = 0; i < std::min(kDirectTries, landings_.size()); ++i) {
      const Landing& it = landings_[(visited_.size() * kDirectTries + i) % landings_.size()];
      const Vector3 to = it.place.point + lift_ * it.eye;
      const double gain = news(it) - 0.5 * (to - from).norm();
      if ((!best || gain > most) && free(from, to)) {
        best = &it;
        most = gain;
      }
    }
    if (best) return *best;
    return *std::max_element(landings_.begin(), landings_.end(),
                             [&](const Landing& a, const Landing& b) { return news(a) < news(b); });
  }

  void fly(const Landing& to) {
    const Vector3 arrival = to.place.point + lift_ * to.eye;
    if (free(above(track_.back()), arrival)) {
      air(above(track_.back()));
    } else {
      leave();
      around(leaving(arrival, to.eye));
    }
    air(arrival);
  }

  /// Out of the model: straight, where a line from here leads out, else back to where the hand came in.
  void leave() {
    const Vector3 here = above(track_.back());
    const auto leads_out = [&](const Vector3& way) { return free(here, here + 4.0 * outside_ * way); };
    std::optional<Vector3> way;
    for (int i = 0; i < 27 && !way; ++i) {
      const Vector3 direction = i == 0 ? track_.back().normal : random_.direction();
      if (direction.dot(track_.back().normal) > 0.0 && leads_out(direction)) way = direction;
    }
    if (!way) {
      for (auto place = track_.rbegin(); place != track_.rend(); ++place)
        add(place->point + (tip_ - start_.depth) * place->normal, start_.depth, true);
      air(start_.place.point + lift_ * start_.eye);
      way = start_.eye;
    } else {
      air(here);
    }
    air(leaving(legs_.back().to, *way));
  }

  /// The point where a line leaves the ball around the models; `from` itself where it is outside already.
  Vector3 leaving(const Vector3& from, const Vector3& way) const {
    const Vector3 off = from - centre_;
    const double along = off.dot(way);
    const double under_root = along * along - off.squaredNorm() + outside_ * outside_;
    if (under_root < 0.0) return from;
    return from + std::max(0.0, std::sqrt(under_root) - along) * way;
  }

  /// Over the ball around the models to `goal`, outside of it.
  void around(const Vector3& goal) {
    const Vector3 from = legs_.back().to - centre_, to = goal - centre_;
    for (int i = 1; i <= kArcPieces; ++i) {
      const double share = double(i) / kArcPieces;
      const Vector3 mixed = (1.0 - share) * from.normalized() + share * to.normalized();
      if (mixed.norm() < 0.1) continue;  // opposite: by the side that the next pieces take
      air(centre_ + ((1.0 - share) * from.norm() + share * to.norm()) * mixed.normalized());
    }
  }

  const SurfaceProbe& probe_;
  double tip_;    // m
  double size_;   // m, of the models
  double depth_;  // m, of the targets below the surface
  double lift_;   // m, of the tip's centre above it
  Vector3 centre_;
  double outside_;  // m, radius of a ball around the middle beyond which there is nothing
  base::Random random_;
  std::vector<Landing> landings_;
  std::vector<Leg> legs_;
  double gone_ = 0.0;               // m
  Landing start_;                   // of the stroke
  std::vector<ProbedPoint> track_;  // of the stroke
  std::vector<Vector3> visited_;
};

double pressed_share(const std::vector<Leg>& way) {
  double all = 0.0, pressed = 0.0;
  for (const Leg& leg : way) {
    all += leg.length;
    pressed += leg.presses ? leg.length : 0.0;
  }
  return all > 0.0 ? pressed / all : 0.0;
}

/// The reaches of the effects, world frame.
std::vector<haptics::Reach> reaches_of(const std::vector<TouchModel>& models) {
  std::vector<haptics::Reach> reaches;
  for (const TouchModel& model : models) {
    for (const haptics::PlacedEffect& effect : model.effects) {
      reaches.push_back(reach_in_world(effect, *haptics::make_effect(effect.text).value()));
    }
  }
  return reaches;
}

/// A way of this length (m) through the air about the effects, from one to the next.
std::vector<Leg> way_among(const std::vector<haptics::Reach>& reaches, double length) {
  constexpr double kUsualRadius = 0.03;  // m, of effects that act everywhere
  constexpr double kBeyond = 1.3;        // radii: a little more than the effect reaches
  base::Random random(kSeed);
  std::vector<Leg> way;
  double gone = 0.0;
  for (std::size_t i = 0; gone < length; ++i) {
    const haptics::Reach& about = reaches[i % reaches.size()];
    const double radius = std::isfinite(about.radius) ? about.radius : kUsualRadius;
    const Vector3 to = about.centre + kBeyond * radius * random.uniform() * random.direction();
    way.push_back({to, way.empty() ? 0.0 : (to - way.back().to).norm(), false});
    gone += std::max(way.back().length, kLeastShare * length);
  }
  return way;
}

}  // namespace

Exploration Exploration::plan(const std::vector<TouchModel>& models, double tip, double seconds) {
  const bool effects_alone =
      std::ranges::all_of(models, [](const TouchModel& model) { return model.bodies.empty(); });
  return effects_alone ? among_effects(models, seconds) : over_surfaces(models, tip, seconds);
}

Exploration Exploration::among_effects(const std::vector<TouchModel>& models, double seconds) {
  constexpr double kSpeed = 0.07;  // m/s
  const std::vector<haptics::Reach> reaches = reaches_of(models);
  Exploration exploration;
  for (const haptics::Reach& reach : reaches)
    exploration.centre_ += reach.centre / static_cast<double>(reaches.size());
  exploration.follow(way_among(reaches, kSpeed * std::min(seconds, kMostSeconds)), kSpeed);
  return exploration;
}

Exploration Exploration::over_surfaces(const std::vector<TouchModel>& models, double tip, double seconds) {
  const SurfaceProbe probe(models);
  const double speed = std::min(kFastest, kSizesPerSecond * probe.bounds().sizes().maxCoeff());
  std::vector<Leg> way =
      StrokePlanner(probe, tip).way(speed * std::min(seconds, kMostSeconds), kStartSeconds * speed);
  Exploration exploration;
  exploration.centre_ = probe.bounds().center();
  exploration.planned_ = pressed_share(way);
  for (const TouchModel& model : models) {
    for (const TouchBody& body : model.bodies)
      exploration.changes_ |= model.motion || body.course || body.shape->changes();
  }
  if (way.empty()) way.push_back({exploration.centre_ + 2.0 * probe.bounds().diagonal(), 0.0, false});
  exploration.follow(way, speed);
  return exploration;
}

std::string Exploration::why_little() const {
  if (planned_ <= 0.0) return "no line of sight from outside meets the surface squarely";
  if (changes_) return "the surface moves, and the way was planned for how it is at the start";
  if (planned_ < kEnough) {
    return fmt::format("from one place to the next, {:.0f} % of the way lead through the air",
                       100.0 * (1.0 - planned_));
  }
  return "the contact slipped off where the hand pressed";
}

/// Fills the table with the way at a constant speed.
void Exploration::follow(const std::vector<Leg>& way, double speed) {
  const double step = speed * kStep;
  double before = 0.0;  // m along the way, at its last place
  double next = 0.0;    // m along the way, of the next target
  Vector3 from = way.front().to;
  for (const Leg& leg : way) {
    for (; next < before + leg.length; next += step)
      targets_.push_back(from + (next - before) / leg.length * (leg.to - from));
    before += leg.length;
    from = leg.to;
  }
  targets_.push_back(from);
  if (targets_.size() < 2) targets_.push_back(from);
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
