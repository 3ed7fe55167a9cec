#include "haptics/judge/contact_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "haptics/judge/contact_witness.h"
#include "haptics/judge/witness_ways.h"

namespace icome::haptics {
namespace {

using base::Bounds;
using base::Pose;
using base::Vector3;

constexpr int kMostSteps = 20'000;  // that one search for a way tries
// Steps of all searches: beyond them an undecided passage of a mesh stays unjudged, of others it is a pop.
constexpr int kMostStepsEver = 400'000;
constexpr int kMostWalked = 100'000;         // triangles and falls of one search along a mesh
constexpr int kMostWalkedEver = 4'000'000;   // of all of them
constexpr int kMostMarkedEver = 20'000'000;  // triangles looked at to prove that meshes part places, all told
constexpr int kLeastSamples = 16;            // of a way that a sphere tip may have room for
constexpr int kLateTicks = 5;                // in a row: then an SCP on its way sticks
constexpr int kPullTicks = 3;         // in a row: where the SCP goes round an edge a force may be late by one
constexpr double kTellable = 30.0;    // times the noise: the least length that is told from none
constexpr double kLeastForce = 1e-6;  // N; a smaller force is due to rounding
constexpr double kSideways = 0.1;     // cosine: a force at less than this to the surface does not pull
constexpr double kLeastCosine = 0.2588;  // of the angle between the pull and a move that counts

/// Lengths that are small for an object, m.
struct Lengths {
  double noise;  // possible error of positions
  double bumps;  // rise and fall of a surface that should be flat
  double pop;    // as JudgeSettings has them
  double stick;

  Lengths(double size, double farthest, double error, const JudgeSettings& settings) : bumps(2.0 * error) {
    const double small = 1e-2 * size;
    noise = std::max({std::min(1e-6 * size, 1e-2 * std::min(settings.pop_depth, small)), 1e-9 * size,
                      1e-12 * farthest, 2.0 * error});
    pop = std::max(std::min(settings.pop_depth, small), kTellable * noise);
    stick = std::max(std::min(settings.stick_move, small), kTellable * noise);
  }
};

/// Box in the world around `box`, which is given in the object's frame.
Bounds placed(const Bounds& box, const Pose& world_from_object) {
  if (box.isEmpty() || !box.min().allFinite() || !box.max().allFinite()) return box;
  const Vector3 centre = world_from_object * Vector3(box.center());
  const Vector3 reach = world_from_object.linear().cwiseAbs() * (0.5 * box.sizes());
  return {centre - reach, centre + reach};
}

/// One object, at its present pose.
class Party {
 public:
  Party(const JudgedObject& object, const JudgeSettings& settings)
      : motion_(object.motion),
        is_mesh_(std::holds_alternative<std::shared_ptr<const geometry::TriangleMesh>>(object.surface)),
        box_(bounds(object)),
        lengths_(lengths_of(object, box_, settings)) {
    limited_ = !box_.isEmpty() && box_.min().allFinite() && box_.max().allFinite();
    witness_ = make_witness(object, {lengths_.noise, lengths_.pop / 8.0});
    place(object.world_from_object);
  }

  void set_time(double time) {
    witness_->set_time(time);
    if (motion_) place(motion_(time));
  }

  const Lengths& lengths() const { return lengths_; }
  const Witness& witness() const { return *witness_; }
  bool is_mesh() const { return is_mesh_; }
  Vector3 in_object(const Vector3& point) const { return object_from_world_ * point; }
  Vector3 in_world(const Vector3& direction) const {
    return object_from_world_.linear().transpose() * direction;
  }

  /// May anything of it lie within `reach` of the segment?
  bool may_meet(const Vector3& a, const Vector3& b, double reach) const {
    if (!limited_) return true;
    const Vector3 margin = Vector3::Constant(reach + lengths_.noise);
    return Bounds(Vector3(a.cwiseMin(b) - margin), Vector3(a.cwiseMax(b) + margin)).intersects(world_box_);
  }

 private:
  static Lengths lengths_of(const JudgedObject& object, const Bounds& box, const JudgeSettings& settings) {
    const Bounds world = placed(box, object.motion ? object.motion(0.0) : object.world_from_object);
    const bool limited = !world.isEmpty() && world.min().allFinite() && world.max().allFinite();
    if (!limited || box.sizes().norm() <= 0.0) return {1.0, 0.0, object.error, settings};
    const double farthest = std::max({world.min().cwiseAbs().maxCoeff(), world.max().cwiseAbs().maxCoeff(),
                                      box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()});
    return {box.sizes().norm(), farthest, object.error, settings};
  }

  void place(const Pose& world_from_object) {
    object_from_world_ = world_from_object.inverse();
    if (limited_) world_box_ = placed(box_, world_from_object);
  }

  std::function<Pose(double)> motion_;
  bool is_mesh_;
  Bounds box_;  // own frame
  Lengths lengths_;
  bool limited_ = false;
  std::unique_ptr<Witness> witness_;
  Pose object_from_world_ = Pose::Identity();
  Bounds world_box_;
};

/// Some unit vectors at right angles to `axis`, evenly around it.
template <std::size_t kCount>
std::array<Vector3, kCount> ring(const Vector3& axis) {
  const Vector3 side = axis.unitOrthogonal();
  const Vector3 other = axis.cross(side);
  std::array<Vector3, kCount> result;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double angle = 6.283185307179586 * (double(i) + 0.25) / kCount;
    result[i] = std::cos(angle) * side + std::sin(angle) * other;
  }
  return result;
}

}  // namespace

class ContactJudge::Court {
 public:
  Court(const std::vector<JudgedObject>& objects, const JudgeSettings& settings)
      : settings_(settings), near_(1.0, 0.0, 0.0, settings) {
    parties_.reserve(objects.size());
    for (const JudgedObject& object : objects) parties_.emplace_back(object, settings);
  }

  std::uint64_t unfinished() const {
    std::uint64_t sum = 0;
    for (const Party& party : parties_) sum += party.witness().unfinished();
    return sum;
  }

  Judgement judge(const JudgedTick& tick) {
    for (Party& party : parties_) party.set_time(tick.time);
    look_around(tick);
    if (tick.time != last_.time) rise();
    Judgement judgement;
    const Passage passage = too_deep(tick.scp) ? Passage::Blocked : this->passage(tick.scp, tick.tip);
    judgement.pop = passage == Passage::Blocked;
    judgement.unjudged = passage == Passage::Unknown;
    const bool could_move = !judgement.pop && sticks(tick.tip, tick.scp, tick.touching);
    judgement.late = could_move && late_ < kLateTicks && came_nearer(tick);
    judgement.stick = could_move && !judgement.late;
    late_ = judgement.late ? late_ + 1 : 0;
    judgement.silent = unfelt(tick) && buried(tick.tip);
    pulling_ = pulls(tick) ? pulling_ + 1 : 0;
    judgement.pull = pulling_ >= kPullTicks;
    last_ = tick;
    began_ = true;
    return judgement;
  }

 private:
  /// Sets near_ to the strictest lengths of the objects that the tick can have to do with.
  void look_around(const JudgedTick& tick) {
    const double reach = settings_.tip_radius + settings_.pop_depth + settings_.stick_move;
    const Vector3 from = seen_.value_or(tick.scp);
    std::optional<Lengths> near;
    for (const Party& party : parties_) {
      if (!party.may_meet(tick.scp, tick.tip, reach) && !party.may_meet(from, tick.scp, reach)) continue;
      const Lengths& its = party.lengths();
      if (!near) near = its;
      near->noise = std::max(near->noise, its.noise);
      near->bumps = std::max(near->bumps, its.bumps);
      near->pop = std::min(near->pop, its.pop);
      near->stick = std::min(near->stick, its.stick);
    }
    if (!near) return;
    near_ = *near;
    near_.pop = std::max(near_.pop, kTellable * near_.noise);
    near_.stick = std::max(near_.stick, kTellable * near_.noise);
  }

  std::optional<Block> blocked(const Vector3& a, const Vector3& b) const {
    std::optional<Block> first;
    for (const Party& party : parties_) {
      if (!party.may_meet(a, b, 0.0)) continue;
      const auto block = party.witness().blocked(party.in_object(a), party.in_object(b));
      if (!block || (first && block->t >= first->t)) continue;
      first = Block{block->t, party.in_world(block->normal)};
    }
    return first;
  }

  bool passes(const Vector3& a, const Vector3& b) const {
    return std::all_of(parties_.begin(), parties_.end(), [&](const Party& party) {
      return !party.may_meet(a, b, 0.0) || party.witness().passes(party.in_object(a), party.in_object(b));
    });
  }

  double distance(const Vector3& point, double limit) const {
    for (const Party& party : parties_) {
      if (party.may_meet(point, point, limit))
        limit = party.witness().distance(party.in_object(point), limit);
    }
    return limit;
  }

  double least_distance(const Vector3& point, double limit) const {
    for (const Party& party : parties_) {
      if (party.may_meet(point, point, limit))
        limit = party.witness().least_distance(party.in_object(point), limit);
    }
    return limit;
  }

  double overlap(const Vector3& point, double radius) const {
    double deepest = 0.0;
    for (const Party& party : parties_) {
      if (party.may_meet(point, point, radius))
        deepest = std::max(deepest, party.witness().overlap(party.in_object(point), radius));
    }
    return deepest;
  }

  bool overlaps(const Vector3& point, double radius) const {
    return std::any_of(parties_.begin(), parties_.end(), [&](const Party& party) {
      return party.may_meet(point, point, radius) && party.witness().overlaps(party.in_object(point), radius);
    });
  }

  bool inside(const Vector3& point) const {
    return std::any_of(parties_.begin(), parties_.end(), [&](const Party& party) {
      return party.may_meet(point, point, 0.0) && party.witness().inside(party.in_object(point));
    });
  }

  /// Is the point inside a solid, and more than its pop depth?
  bool deep(const Vector3& point) const {
    return std::any_of(parties_.begin(), parties_.end(), [&](const Party& party) {
      return party.may_meet(point, point, 0.0) &&
             party.witness().deep(party.in_object(point), party.lengths().pop);
    });
  }

  /// Does a tip with its radius reach into a solid with its centre, or by more than the pop depth?
  bool buried(const Vector3& tip) const {
    const double radius = settings_.tip_radius;
    if (radius <= 0.0) return deep(tip);
    return std::any_of(parties_.begin(), parties_.end(), [&](const Party& party) {
      const Vector3 own = party.in_object(tip);
      return party.may_meet(tip, tip, radius) && party.witness().solid() &&
             (party.witness().inside(own) || party.witness().overlap(own, radius) > party.lengths().pop);
    });
  }

  /// Is the tip on its way out to the SCP? Then damping may use up the spring's force, and along the normal
  /// of an edge more than that.
  bool leaving(const JudgedTick& tick) const { return (tick.tip - last_.tip).dot(tick.scp - tick.tip) > 0.0; }

  /// Did the SCP come nearer to where the tip is now?
  bool came_nearer(const JudgedTick& tick) const {
    return began_ && (last_.scp - tick.tip).norm() - (tick.scp - tick.tip).norm() >= near_.stick;
  }

  bool unfelt(const JudgedTick& tick) const {
    if (!tick.touching) return true;
    return tick.force && tick.force->norm() <= kLeastForce && !leaving(tick);
  }

  /// A force that turned with the pull has yet to follow, as fast as the limiter lets it: it may point away
  /// from the SCP while it comes round.
  bool pulls(const JudgedTick& tick) const {
    const Vector3 out = tick.scp - tick.tip;
    if (!tick.force || out.norm() <= near_.pop || leaving(tick)) return false;
    if (tick.force->dot(out) >= -kSideways * tick.force->norm() * out.norm()) return false;
    return !last_.force || (*tick.force - *last_.force).dot(out) <= 0.0;
  }

  /// A surface that moved over the place where the SCP was seen lifts it.
  void rise() {
    if (!seen_ || !inside(*seen_)) return;
    const std::array<Vector3, 3> axes{Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
    for (double far = near_.noise; far <= 16.0 * near_.pop; far *= 1.25) {
      for (const Vector3& axis : axes) {
        for (const Vector3& side : ring<16>(axis)) {
          if (inside(*seen_ + far * side)) continue;
          seen_ = *seen_ + far * side;
          return;
        }
      }
    }
    seen_.reset();  // a solid has appeared around it
  }

  bool too_deep(const Vector3& scp) {
    if (settings_.tip_radius > 0.0 && overlap(scp, settings_.tip_radius) > near_.pop) return true;
    const bool deep = this->deep(scp);
    if (deep) seen_ = scp;  // a passage that led here is counted by this
    return deep;
  }

  /// Outcome of the SCP's way to its present place.
  enum class Passage { Free, Unknown, Blocked };

  // `seen_` follows the SCP on the side where it ought to be: where the SCP is a bit behind a surface, by
  // noise or by the beginning of a pop, `seen_` stays in front of it.
  Passage passage(const Vector3& scp, const Vector3& tip) {
    std::optional<Vector3> place =
        clearest(scp, [&](const Vector3& to) { return seen_ ? passes(*seen_, to) : !inside(to); });
    if (!place && seen_) place = clearest(scp, [&](const Vector3& to) { return around(*seen_, to); });
    const WaySearch search = place || !seen_ ? WaySearch::Found : long_way(scp, tip);
    if (search == WaySearch::Found) {
      seen_ = place.value_or(scp);
      return Passage::Free;
    }
    const Vector3 way = scp - *seen_;
    const double met = blocked(*seen_, scp)->t * way.norm();
    const bool far = way.norm() - met > near_.pop;
    seen_ = far ? scp : Vector3(*seen_ + std::max(0.0, met - 2.0 * near_.noise) * way.normalized());
    if (!far) return Passage::Free;
    return search == WaySearch::None ? Passage::Blocked : Passage::Unknown;
  }

  /// Is there a way through free space that never moves away from the tip? The SCP may run far in one
  /// tick when an edge or a bottleneck lets go of it.
  WaySearch long_way(const Vector3& scp, const Vector3& tip) {
    if (apart(scp, tip)) return WaySearch::None;
    if (settings_.tip_radius <= 0.0 && walks_to(scp, tip)) return WaySearch::Found;
    const WaySearch search = slides_to(scp, tip);
    // For other shapes nothing is proved, so that a way that is not found there has to count as none.
    return search == WaySearch::GaveUp && !mesh_between(scp) ? WaySearch::None : search;
  }

  /// Is a mesh in the straight way? One that merely is around, as a room, does not make it hard to tell.
  bool mesh_between(const Vector3& scp) const {
    return std::any_of(parties_.begin(), parties_.end(), [&](const Party& party) {
      return party.is_mesh() && party.may_meet(*seen_, scp, 0.0) &&
             party.witness().blocked(party.in_object(*seen_), party.in_object(scp)).has_value();
    });
  }

  /// Does a mesh surely part the SCP, wherever noise may have put it, from where it was seen?
  bool apart(const Vector3& scp, const Vector3& tip) {
    std::vector<Vector3> places;
    for (const Vector3& place : beside(scp)) {
      if (!inside(place)) places.push_back(place);
    }
    return !places.empty() && std::any_of(parties_.begin(), parties_.end(), [&](const Party& party) {
      const WitnessWays* ways = party.may_meet(*seen_, scp, 0.0) ? party.witness().ways() : nullptr;
      return ways != nullptr && std::all_of(places.begin(), places.end(), [&](const Vector3& place) {
               return ways->apart(party.in_object(*seen_), party.in_object(place), party.in_object(tip),
                                  marks_left_);
             });
    });
  }

  /// The party that is the only one within the ball around the tip that the SCP was seen on; null where there
  /// are more or none.
  const Party* only_party(const Vector3& tip) const {
    const double radius = settings_.tip_radius + (*seen_ - tip).norm();
    const Party* only = nullptr;
    for (const Party& party : parties_) {
      if (!party.may_meet(tip, tip, radius)) continue;
      if (only != nullptr) return nullptr;
      only = &party;
    }
    return only;
  }

  /// Does a mesh, alone within reach, lead a point tip to the SCP?
  bool walks_to(const Vector3& scp, const Vector3& tip) {
    const Party* party = only_party(tip);
    const WitnessWays* ways = party == nullptr ? nullptr : party->witness().ways();
    const int granted = std::min(kMostWalked, kMostWalkedEver - walked_);
    if (ways == nullptr || granted <= 0) return false;
    int left = granted;
    const WaySearch search = ways->leads(party->in_object(*seen_), party->in_object(scp),
                                         party->in_object(tip), near_.noise, left);
    walked_ += granted - left;
    return search == WaySearch::Found;
  }

  /// The clearest legal place at the SCP. Within noise of a surface the SCP may be on its wrong
  /// side, or on neither: there the legal places a little beside count too.
  template <typename Legal>
  std::optional<Vector3> clearest(const Vector3& scp, Legal&& legal) const {
    std::optional<Vector3> best;
    double most = -1.0;
    for (const Vector3& place : beside(scp)) {
      const double clear = distance(place, 4.0 * near_.noise);
      if (clear <= most || !legal(place)) continue;
      most = clear;
      best = place;
    }
    return best;
  }

  /// Possible places of an SCP that noise has moved, itself first; it alone where no surface is near.
  std::vector<Vector3> beside(const Vector3& scp) const {
    std::vector<Vector3> places{scp};
    if (distance(scp, 2.0 * near_.noise) >= 2.0 * near_.noise) return places;
    for (int i = 0; i < 6; ++i) {
      places.push_back(scp);
      places.back()[i / 2] += (i % 2 ? -4.0 : 4.0) * near_.noise;
    }
    return places;
  }

  /// Is there a way by one more point, no farther off than the way is long? Most likely off the face in
  /// between.
  bool around(const Vector3& a, const Vector3& b) const {
    const Vector3 way = b - a;
    const std::optional<Block> block = blocked(a, b);
    if (way.squaredNorm() <= 0.0 || !block) return false;
    const Vector3 direction = way.normalized();
    const Vector3 off_face = (block->normal - block->normal.dot(direction) * direction).normalized();
    const auto sides = ring<16>(direction);
    return passes_by(a, way, off_face) || std::any_of(sides.begin(), sides.end(), [&](const Vector3& side) {
             return passes_by(a, way, side);
           });
  }

  /// Is a way from `a` by a point on this side of `way` free?
  bool passes_by(const Vector3& a, const Vector3& way, const Vector3& side) const {
    for (const double off : {0.1, 0.3, 1.0}) {
      for (const double along : {0.5, 0.1, 0.9}) {
        const Vector3 apex = a + along * way + off * way.norm() * side;
        if (passes(a, apex) && passes(apex, a + way)) return true;
      }
    }
    return false;
  }

  /// Looks in all directions for the way. The SCP went downhill as a rule, so that comes first.
  WaySearch slides_to(const Vector3& scp, const Vector3& tip) {
    const WaySearch down = finds_way(scp, tip, tip);
    if (down == WaySearch::Found) return down;
    const WaySearch there = finds_way(scp, tip, scp);
    return there == WaySearch::GaveUp ? down : there;
  }

  /// Best-first search: from the place that is nearest to the goal so far, steps in all directions, and along
  /// what blocks them; shorter steps only where long ones lead no nearer.
  WaySearch finds_way(const Vector3& scp, const Vector3& tip, const Vector3& goal) {
    const double far = std::max(near_.stick, (scp - *seen_).norm() / 50.0);
    const Vector3 clear = clearest(scp, [&](const Vector3& to) { return !inside(to); }).value_or(scp);
    Search search{goal, {cell(*seen_, 0.5 * far)}, {{(goal - *seen_).norm(), *seen_}}};
    const int last = std::min(steps_ + kMostSteps, kMostStepsEver);
    while (!search.open.empty() && steps_ < last) {
      const Vector3 place = search.next();
      if (free(place, scp) || free(place, clear) || ((scp - place).norm() <= 4.0 * far && around(place, scp)))
        return WaySearch::Found;
      for (double move = far; move >= 2.0 * near_.noise; move *= 0.25) {
        if (walk_on(search, place, scp, tip, move)) break;
      }
    }
    return search.open.empty() ? WaySearch::None : WaySearch::GaveUp;
  }

  using Cell = std::array<double, 4>;  // its size and place, in sizes

  /// The goal of a search, the cells that it has come to, and the places that it may go on from.
  struct Search {
    Vector3 goal;
    std::set<Cell> known;
    std::vector<std::pair<double, Vector3>> open;  // a heap by distance to the goal, m

    static bool farther(const std::pair<double, Vector3>& a, const std::pair<double, Vector3>& b) {
      return a.first > b.first;
    }
    void add(const Vector3& place) {
      open.emplace_back((goal - place).norm(), place);
      std::push_heap(open.begin(), open.end(), farther);
    }
    Vector3 next() {
      std::pop_heap(open.begin(), open.end(), farther);
      const Vector3 place = open.back().second;
      open.pop_back();
      return place;
    }
  };

  static Cell cell(const Vector3& place, double size) {
    return {size, std::floor(place.x() / size), std::floor(place.y() / size), std::floor(place.z() / size)};
  }

  /// Adds the places that free steps `move` long lead to, none farther from the tip. Tells whether one comes
  /// nearer to the goal.
  bool walk_on(Search& search, const Vector3& from, const Vector3& scp, const Vector3& tip, double move) {
    constexpr std::array<double, 6> kCosines{0.95, 0.8, 0.6, 0.4, 0.2, 0.08};
    const double way = (tip - from).norm();
    const double left = (search.goal - from).norm();
    bool nearer = false;
    const auto go = [&](const Vector3& to) {
      if ((to - tip).norm() > way || search.known.contains(cell(to, 0.5 * move))) return;
      ++steps_;
      if (!free(from, to)) return;
      search.known.insert(cell(to, 0.5 * move));
      search.add(to);
      nearer = nearer || (search.goal - to).norm() < left - 0.1 * move;
    };
    // Goes as far as the way leads nearer to the goal, or up to an obstacle.
    const auto run = [&](const Vector3& along, const Vector3& goal) {
      const double length = along.dot(goal - from);
      if (length <= move) return;
      const std::optional<Block> block = blocked(from, from + length * along);
      const double free_part = block ? block->t * length - 2.0 * near_.noise : length;
      if (free_part > move) go(from + free_part * along);
    };
    for (const Vector3& goal : {scp, tip}) {
      if ((goal - from).squaredNorm() <= 0.0) continue;
      const Vector3 onward = (goal - from).normalized();
      for (const Vector3& along : unblocked(from, move, onward)) {
        run(along, goal);
        go(from + move * along);
      }
      for (const Vector3& along : ways_of_ball(from, move, onward)) go(from + move * along);
      for (const double cosine : kCosines) {
        for (const Vector3& side : ring<16>(onward))
          go(from + move * (cosine * onward + std::sqrt(1.0 - cosine * cosine) * side));
      }
    }
    return nearer;
  }

  /// A surface that the ball of a sphere tip touches, or may come to: as a plane.
  struct Floor {
    Vector3 normal;
    double gap;  // m, to the ball
  };

  /// Those within a move of the ball around `from`, but for parallel ones; the nearest first.
  std::vector<Floor> floors(const Vector3& from, double move) const {
    constexpr std::size_t kMost = 12;
    constexpr double kParallel = 0.999;
    std::vector<Floor> all, apart;
    const double radius = settings_.tip_radius;
    for (const Party& party : parties_) {
      if (!party.may_meet(from, from, radius + move)) continue;
      const Vector3 own = party.in_object(from);
      party.witness().touched(own, radius + move, [&](const Vector3& place) {
        const Vector3 away = own - place;
        if (away.norm() > 0.0) all.push_back({party.in_world(away.normalized()), away.norm() - radius});
      });
    }
    std::ranges::sort(all, {}, &Floor::gap);
    for (const Floor& it : all) {
      const bool known = std::ranges::any_of(
          apart, [&](const Floor& other) { return other.normal.dot(it.normal) > kParallel; });
      if (!known && apart.size() < kMost) apart.push_back(it);
    }
    return apart;
  }

  /// The ways of a sphere tip along one surface that it touches, and along the groove between two, that lead
  /// towards the pull and into none. A ball in a groove has no other, and directions at random miss them.
  std::vector<Vector3> ways_of_ball(const Vector3& from, double move, const Vector3& pull) const {
    std::vector<Vector3> ways;
    if (settings_.tip_radius <= 0.0) return ways;
    constexpr double kInto = 1e-3;  // of the move, as has_room() allows
    const std::vector<Floor> around = floors(from, move);
    const auto add = [&](const Vector3& along) {
      const double length = along.norm();
      if (length < 1e-6) return;
      const Vector3 way = (along.dot(pull) < 0.0 ? -1.0 : 1.0) / length * along;
      const auto allows = [&](const Floor& it) {
        return move * it.normal.dot(way) >= -std::max(0.0, it.gap) - kInto * move;
      };
      if (std::ranges::all_of(around, allows)) ways.push_back(way);
    };
    for (std::size_t i = 0; i < around.size(); ++i) {
      add(pull - pull.dot(around[i].normal) * around[i].normal);
      for (std::size_t k = 0; k < i; ++k) add(around[i].normal.cross(around[k].normal));
    }
    return ways;
  }

  /// The pull, the pull along the face that blocks it, and the pull along that and the face that blocks this.
  std::array<Vector3, 3> unblocked(const Vector3& from, double move, const Vector3& pull) const {
    std::array<Vector3, 3> ways{pull, pull, pull};
    const std::optional<Block> first = blocked(from, from + move * pull);
    if (!first) return ways;
    ways[1] = ways[2] = (pull - pull.dot(first->normal) * first->normal).normalized();
    const std::optional<Block> second = blocked(from, from + move * ways[1]);
    if (!second) return ways;
    const Vector3 seam = first->normal.cross(second->normal).normalized();
    ways[2] = seam.dot(pull) < 0.0 ? Vector3(-seam) : seam;
    return ways;
  }

  /// Start of a straight way, and the depth to which the tip reaches into a surface there.
  struct Start {
    Vector3 place;
    double overlap;
  };
  using Starts = std::array<Start, 2>;  // where the SCP was seen, and where it is

  Start start_at(const Vector3& place) const {
    const double radius = settings_.tip_radius;
    return {place, radius > 0.0 ? overlap(place, radius) : 0.0};
  }

  bool sticks(const Vector3& tip, const Vector3& scp, bool touching) const {
    const Vector3 pull = tip - scp;
    const double way = pull.norm();
    const double move = near_.stick;
    if (way <= move) return false;
    const Starts starts{start_at(*seen_), start_at(scp)};
    if (!touching || free_by(starts, tip - scp)) return true;
    return !nearest_possible(tip, way) && may_come_nearer(starts, pull / way, way);
  }

  /// Is no place nearer to the tip than the SCP is, give or take half a move?
  bool nearest_possible(const Vector3& tip, double way) const {
    const double least = least_distance(tip, way) + settings_.tip_radius;
    return way <= least + 0.5 * near_.stick && !passes(*seen_, tip);
  }

  /// Tries the ways along the faces that block the pull, then fans of directions around the pull; the
  /// widest is 15 degrees short of the right angle.
  bool may_come_nearer(const Starts& starts, const Vector3& pull, double way) const {
    constexpr std::array<double, 4> kCosines{kLeastCosine, 0.5, 0.7660, 0.9397};
    const auto along = unblocked(*seen_, near_.stick, pull);
    const auto clearly = [&](const Vector3& direction) {
      return clearly_nearer(direction.dot(pull), way) && free_by(starts, near_.stick * direction);
    };
    if (std::any_of(along.begin(), along.end(), clearly)) return true;
    const auto sides = ring<16>(pull);
    for (const double cosine : kCosines) {
      for (const Vector3& side : sides) {
        if (clearly(cosine * pull + std::sqrt(1.0 - cosine * cosine) * side)) return true;
      }
    }
    return false;
  }

  /// Is a move, at an angle of this `cosine` to the pull, outside the friction cone and clearly nearer to
  /// the tip? It need not be free.
  bool clearly_nearer(double cosine, double way) const {
    const double move = near_.stick;
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    if (cosine < 0.999 * kLeastCosine || cosine <= 1.1 * settings_.static_friction * sine + 0.02)
      return false;
    return way - std::hypot(way - move * cosine, move * sine) >= 0.1 * move;
  }

  /// Is the move free both from the SCP, which noise may have put behind a surface, and from where it was
  /// seen, which may lie just past an edge?
  bool free_by(const Starts& starts, const Vector3& move) const {
    return std::all_of(starts.begin(), starts.end(), [&](const Start& start) {
      return passes(start.place, start.place + move) && has_room(start, start.place + move, near_.stick);
    });
  }

  /// May the tip go straight from `a` to `b`?
  bool free(const Vector3& a, const Vector3& b) const {
    return passes(a, b) && has_room(start_at(a), b, (b - a).norm());
  }

  /// Is there room for a sphere tip on a way that is free for its middle? It may reach into surfaces by
  /// its overlap at the start, its bumps, and a thousandth of the way or of `longest`, if that is shorter,
  /// which still tells walls from gaps in a groove of a tenth of a degree.
  bool has_room(const Start& start, const Vector3& b, double longest) const {
    const Vector3& a = start.place;
    const double radius = settings_.tip_radius;
    if (radius <= 0.0) return true;
    const double length = (b - a).norm();
    const double kept = radius - start.overlap - near_.bumps - 1e-3 * std::min(length, longest);
    if (kept <= 0.0) return true;
    // A short way may lead by a place that is narrower by some micrometres only.
    const int samples = std::max(kLeastSamples, int(std::ceil(2.0 * length / radius)));
    for (int i = samples; i > 0; --i) {
      if (overlaps(a + (double(i) / samples) * (b - a), kept)) return false;
    }
    return true;
  }

  JudgeSettings settings_;
  std::vector<Party> parties_;
  Lengths near_;  // of the objects that the last tick had to do with
  JudgedTick last_;
  bool began_ = false;
  int pulling_ = 0;  // ticks in a row
  int late_ = 0;     // ticks in a row
  int steps_ = 0;    // tried by all searches for a way in all directions
  int walked_ = 0;   // by all searches along meshes
  int marks_left_ = kMostMarkedEver;
  std::optional<Vector3> seen_;  // m, last place of the SCP in front of everything
};

ContactJudge::ContactJudge(const std::vector<JudgedObject>& objects, const JudgeSettings& settings)
    : court_(std::make_unique<Court>(objects, settings)) {}
ContactJudge::~ContactJudge() = default;
ContactJudge::ContactJudge(ContactJudge&&) noexcept = default;
ContactJudge& ContactJudge::operator=(ContactJudge&&) noexcept = default;

std::uint64_t ContactJudge::unfinished() const { return court_->unfinished(); }

Judgement ContactJudge::judge(const JudgedTick& tick) {
  const Judgement judgement = court_->judge(tick);
  ++ticks_;
  pops_ += judgement.pop;
  sticks_ += judgement.stick;
  silent_ += judgement.silent;
  pulls_ += judgement.pull;
  unjudged_ += judgement.unjudged;
  late_ += judgement.late;
  return judgement;
}

}  // namespace icome::haptics
