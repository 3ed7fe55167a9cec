#include "haptics/contact_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "haptics/contact_witness.h"

namespace icome::haptics {
namespace {

using base::Bounds;
using base::Pose;
using base::Vector3;

constexpr double kLeastCosine = 0.2588;  // of the angle between the pull and a move that counts

/// One object with its pose.
struct Party {
  std::unique_ptr<Witness> witness;
  Pose object_from_world;
};

/// The diagonal of the box around all limited objects; 1 m when there is none.
double diagonal(const std::vector<JudgedObject>& objects) {
  Bounds all;
  for (const JudgedObject& object : objects) {
    const Bounds box = bounds(object);
    if (box.isEmpty() || !box.min().allFinite() || !box.max().allFinite()) continue;
    const Vector3 centre = object.world_from_object * Vector3(box.center());
    const Vector3 reach = object.world_from_object.linear().cwiseAbs() * (0.5 * box.sizes());
    all.extend(Bounds(centre - reach, centre + reach));
  }
  return all.isEmpty() || all.sizes().norm() <= 0.0 ? 1.0 : all.sizes().norm();
}

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
  Court(const std::vector<JudgedObject>& objects, const JudgeSettings& settings) : settings_(settings) {
    const double size = diagonal(objects);
    const auto scaled = [&](double length) { return std::clamp(length, 1e-5 * size, 1e-2 * size); };
    settings_.pop_depth = scaled(settings.pop_depth);
    settings_.stick_move = scaled(settings.stick_move);
    noise_ = kJudgeNoise * size;
    const Resolution resolution{noise_, settings_.pop_depth / 8.0};
    for (const JudgedObject& object : objects) {
      parties_.push_back({make_witness(object, resolution), object.world_from_object.inverse()});
    }
  }

  const JudgeSettings& settings() const { return settings_; }

  Judgement judge(const Vector3& tip, const Vector3& scp, bool touching, double time) {
    for (const Party& party : parties_) party.witness->set_time(time);
    if (time != time_) rise();
    time_ = time;
    Judgement judgement;
    judgement.pop = too_deep(scp) || passed_through(scp, tip);
    if (!judgement.pop) judgement.stick = sticks(tip, scp, touching);
    return judgement;
  }

 private:
  std::optional<Block> blocked(const Vector3& a, const Vector3& b) const {
    std::optional<Block> first;
    for (const Party& party : parties_) {
      const auto block = party.witness->blocked(party.object_from_world * a, party.object_from_world * b);
      if (!block || (first && block->t >= first->t)) continue;
      first = Block{block->t, party.object_from_world.linear().transpose() * block->normal};
    }
    return first;
  }

  bool passes(const Vector3& a, const Vector3& b) const {
    return std::all_of(parties_.begin(), parties_.end(), [&](const Party& party) {
      return party.witness->passes(party.object_from_world * a, party.object_from_world * b);
    });
  }

  double distance(const Vector3& point, double limit) const {
    for (const Party& party : parties_)
      limit = party.witness->distance(party.object_from_world * point, limit);
    return limit;
  }

  double least_distance(const Vector3& point, double limit) const {
    for (const Party& party : parties_)
      limit = party.witness->least_distance(party.object_from_world * point, limit);
    return limit;
  }

  double overlap(const Vector3& point, double radius) const {
    double deepest = 0.0;
    for (const Party& party : parties_) {
      deepest = std::max(deepest, party.witness->overlap(party.object_from_world * point, radius));
    }
    return deepest;
  }

  bool inside(const Vector3& point) const {
    return std::any_of(parties_.begin(), parties_.end(), [&](const Party& party) {
      return party.witness->inside(party.object_from_world * point);
    });
  }

  /// A surface that moved over the place where the SCP was seen lifts it.
  void rise() {
    if (!seen_ || !inside(*seen_)) return;
    const std::array<Vector3, 3> axes{Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
    for (double far = noise_; far <= 16.0 * settings_.pop_depth; far *= 1.25) {
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
    if (settings_.tip_radius > 0.0 && overlap(scp, settings_.tip_radius) > settings_.pop_depth) return true;
    const bool deep = std::any_of(parties_.begin(), parties_.end(), [&](const Party& party) {
      return party.witness->deep(party.object_from_world * scp, settings_.pop_depth);
    });
    if (deep) seen_ = scp;  // a passage that led here is counted by this
    return deep;
  }

  // `seen_` follows the SCP on the side where it ought to be: where the SCP is a bit behind a surface, by
  // noise or by the beginning of a pop, `seen_` stays in front of it.
  bool passed_through(const Vector3& scp, const Vector3& tip) {
    std::optional<Vector3> place =
        clearest(scp, [&](const Vector3& to) { return seen_ ? passes(*seen_, to) : !inside(to); });
    if (!place && seen_) place = clearest(scp, [&](const Vector3& to) { return around(*seen_, to); });
    if (!place && (!seen_ || slides_to(scp, tip))) place = scp;
    if (place) {
      seen_ = place;
      return false;
    }
    const Vector3 way = scp - *seen_;
    const double met = blocked(*seen_, scp)->t * way.norm();
    const bool far = way.norm() - met > settings_.pop_depth;
    seen_ = far ? scp : Vector3(*seen_ + std::max(0.0, met - 2.0 * noise_) * way.normalized());
    return far;
  }

  /// The SCP when it is legal there. Within noise of a surface it may be on the wrong side of it, or on
  /// neither: there the clearest of the legal places a little beside.
  template <typename Legal>
  std::optional<Vector3> clearest(const Vector3& scp, Legal&& legal) const {
    if (distance(scp, 2.0 * noise_) >= 2.0 * noise_) return legal(scp) ? std::optional(scp) : std::nullopt;
    std::optional<Vector3> best;
    double most = -1.0;
    for (int i = 0; i < 7; ++i) {
      Vector3 place = scp;
      if (i > 0) place[(i - 1) / 2] += (i % 2 ? 4.0 : -4.0) * noise_;
      const double clear = distance(place, 4.0 * noise_);
      if (clear <= most || !legal(place)) continue;
      most = clear;
      best = place;
    }
    return best;
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

  /// Where an edge or a bottleneck lets go, the SCP may run far in one tick. Does a walk through free space
  /// that never moves away from the tip come by?
  bool slides_to(const Vector3& scp, const Vector3& tip) const {
    constexpr int kMaxSteps = 1000;
    const double far = std::max(settings_.stick_move, (scp - *seen_).norm() / 50.0);
    Vector3 place = *seen_;
    for (int i = 0; i < kMaxSteps; ++i) {
      if (free(place, scp) || ((scp - place).norm() <= 4.0 * far && around(place, scp))) return true;
      const std::optional<Vector3> next = walked(place, tip, far);
      if (!next) return false;
      place = *next;
    }
    return false;
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

  /// One step of such a walk: straight on, or along what blocks the way, or whichever way leads nearer.
  std::optional<Vector3> walked(const Vector3& from, const Vector3& tip, double longest) const {
    constexpr std::array<double, 6> kCosines{0.95, 0.8, 0.6, 0.4, 0.2, 0.08};
    const double way = (tip - from).norm();
    if (way <= 0.0) return std::nullopt;
    const Vector3 pull = (tip - from) / way;
    const auto nearer = [&](const Vector3& step) {
      return (from + step - tip).norm() < way && free(from, from + step);
    };
    const auto sides = ring<16>(pull);
    for (double move = std::min(longest, way); move >= 1e-3 * settings_.stick_move; move *= 0.25) {
      for (const Vector3& along : unblocked(from, move, pull)) {
        if (nearer(move * along)) return from + move * along;
      }
      for (const double cosine : kCosines) {
        for (const Vector3& side : sides) {
          const Vector3 step = move * (cosine * pull + std::sqrt(1.0 - cosine * cosine) * side);
          if (nearer(step)) return from + step;
        }
      }
    }
    return std::nullopt;
  }

  bool sticks(const Vector3& tip, const Vector3& scp, bool touching) const {
    const Vector3 pull = tip - scp;
    const double way = pull.norm();
    const double move = settings_.stick_move;
    if (way <= move) return false;
    if (!touching || free_by(scp, tip - scp)) return true;
    return !nearest_possible(tip, way) && may_come_nearer(scp, pull / way, way);
  }

  /// Nothing is nearer to the tip than the SCP is, give or take half a move.
  bool nearest_possible(const Vector3& tip, double way) const {
    const double least = least_distance(tip, way) + settings_.tip_radius;
    return way <= least + 0.5 * settings_.stick_move && !passes(*seen_, tip);
  }

  /// Tries the ways along what blocks the pull, then fans of directions around the pull; the widest is 15
  /// degrees short of the right angle.
  bool may_come_nearer(const Vector3& scp, const Vector3& pull, double way) const {
    constexpr std::array<double, 4> kCosines{kLeastCosine, 0.5, 0.7660, 0.9397};
    const auto along = unblocked(*seen_, settings_.stick_move, pull);
    const auto clearly = [&](const Vector3& direction) {
      return clearly_nearer(direction.dot(pull), way) && free_by(scp, settings_.stick_move * direction);
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

  /// Is a move in this direction, `cosine` of its angle to the pull, outside the friction cone, worth it and
  /// free?
  bool clearly_nearer(double cosine, double way) const {
    const double move = settings_.stick_move;
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    if (cosine < 0.999 * kLeastCosine || cosine <= 1.1 * settings_.static_friction * sine + 0.02)
      return false;
    return way - std::hypot(way - move * cosine, move * sine) >= 0.1 * move;
  }

  /// Is the move free both from the SCP, which noise may have put behind a surface, and from where it was
  /// seen, which may lie just past an edge?
  bool free_by(const Vector3& scp, const Vector3& move) const {
    return free(*seen_, *seen_ + move) && free(scp, scp + move);
  }

  /// May the tip go straight from `a` to `b`? A sphere may brush along what it touches already: the noise,
  /// and a thousandth of the way, which still tells walls from gaps in a groove of a tenth of a degree.
  bool free(const Vector3& a, const Vector3& b) const {
    if (!passes(a, b)) return false;
    const double radius = settings_.tip_radius;
    if (radius <= 0.0) return true;
    const double length = (b - a).norm();
    const double allowed = overlap(a, radius) + 1e-3 * length;
    const int samples = std::max(2, int(std::ceil(2.0 * length / radius)));
    for (int i = samples; i > 0; --i) {
      if (overlap(a + (double(i) / samples) * (b - a), radius) > allowed) return false;
    }
    return true;
  }

  JudgeSettings settings_;
  std::vector<Party> parties_;
  double noise_ = 0.0;           // m
  double time_ = 0.0;            // s
  std::optional<Vector3> seen_;  // m, where the SCP was last in front of everything
};

ContactJudge::ContactJudge(const std::vector<JudgedObject>& objects, const JudgeSettings& settings)
    : court_(std::make_unique<Court>(objects, settings)) {}
ContactJudge::~ContactJudge() = default;
ContactJudge::ContactJudge(ContactJudge&&) noexcept = default;
ContactJudge& ContactJudge::operator=(ContactJudge&&) noexcept = default;

Judgement ContactJudge::judge(const Vector3& tip, const Vector3& scp, bool touching, double time) {
  const Judgement judgement = court_->judge(tip, scp, touching, time);
  ++ticks_;
  pops_ += judgement.pop;
  sticks_ += judgement.stick;
  return judgement;
}

double ContactJudge::pop_depth() const { return court_->settings().pop_depth; }
double ContactJudge::stick_move() const { return court_->settings().stick_move; }

}  // namespace icome::haptics
