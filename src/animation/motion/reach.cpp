#include "animation/motion/reach.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "animation/motion/cell_point.h"
#include "animation/motion/small_system.h"

namespace icome::animation {
namespace {

constexpr int kReachSteps = 60;
constexpr double kSlowZone = 0.01;    // of the reach, in which a chain straightens ever more slowly
constexpr double kGain = 6;           // px that a part may move for one that the hand went ahead
constexpr double kAngleWeight = 0.1;  // reaches for a radian
constexpr double kStuck = 1e-4;  // cosine between error and motion, below which nothing moves to the target
constexpr double kSideways = 4;  // times the pull sideways by which an end that lags may turn
constexpr double kSwing = 0.7;   // rad, that an end turns at most in a frame that is its radius from the hand
constexpr double kNoLength = 1e-9;  // px
constexpr double kFirstBend = 0.1;  // rad, by which a straight chain is bent to begin with

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The chain by itself: pins, the links between them, and the turns of the cells.
class Arm {
 public:
  Arm(const Rig& rig, const ArmWish& wish) {
    const RigCell& first = rig.cells[std::size_t(wish.turning.front())];
    hangs_ = first.parent >= 0;
    origin_ = hangs_ ? first.pin_place() : first.place;
    base_ = hangs_ ? first.angle - first.relative : 0;
    for (std::size_t i = 0; i < wish.turning.size(); ++i) {
      const RigCell& cell = rig.cells[std::size_t(wish.turning[i])];
      const bool is_last = i + 1 == wish.turning.size();
      const Vector2 from = i == 0 && !hangs_ ? Vector2(Vector2::Zero()) : cell.pin;
      const Vector2 to = is_last ? wish.offset : rig.cells[std::size_t(wish.turning[i + 1])].pin_on_parent;
      links_.push_back(to - from);
      turns_.push_back(i == 0 && !hangs_ ? cell.angle : cell.relative);
      least_.push_back(cell.least);
      greatest_.push_back(cell.greatest);
      lengths_ += links_.back().norm();
      longest_ = std::max(longest_, links_.back().norm());
    }
    places_.resize(links_.size() + 1);
    settle();
  }

  std::size_t size() const { return links_.size(); }
  double length() const { return lengths_; }
  double longest() const { return longest_; }
  const Vector2& origin() const { return origin_; }
  const Vector2& end() const { return places_.back(); }
  const std::vector<Vector2>& places() const { return places_; }  // of the pins, and of the end
  double end_angle() const { return end_angle_; }
  double last_link() const { return links_.back().norm(); }
  const std::vector<double>& turns() const { return turns_; }
  double room_above(std::size_t i) const { return greatest_[i] - turns_[i]; }
  double room_below(std::size_t i) const { return turns_[i] - least_[i]; }

  void set_turns(const std::vector<double>& turns) {
    turns_ = turns;
    for (std::size_t i = 0; i < size(); ++i)
      turns_[i] = std::max(least_[i], std::min(greatest_[i], turns_[i]));
    settle();
  }

  void write(Rig& rig, const std::vector<int>& turning) const {
    for (std::size_t i = 0; i < size(); ++i) {
      RigCell& cell = rig.cells[std::size_t(turning[i])];
      if (i == 0 && !hangs_) {
        cell.angle = turns_[i];
      } else {
        cell.relative = turns_[i];
      }
    }
    rig.settle(rig.cells[std::size_t(turning.front())].root);
  }

 private:
  void settle() {
    double angle = base_;
    places_[0] = origin_;
    for (std::size_t i = 0; i < size(); ++i) {
      angle += turns_[i];
      places_[i + 1] = places_[i] + turned(links_[i], angle);
    }
    end_angle_ = angle;
  }

  bool hangs_ = false;
  Vector2 origin_ = Vector2::Zero();
  double base_ = 0, end_angle_ = 0, lengths_ = 0, longest_ = 0;
  std::vector<Vector2> links_, places_;
  std::vector<double> turns_, least_, greatest_;
};

/// The task in units of the arm's length: place, and the angle where it counts.
struct Miss {
  std::array<double, 3> values = {0, 0, 0};
  std::size_t rows = 2;

  double squared() const { return values[0] * values[0] + values[1] * values[1] + values[2] * values[2]; }
};

Miss miss_of(const Arm& arm, const Vector2& target, const std::optional<double>& angle) {
  const Vector2 away = (target - arm.end()) / arm.length();
  Miss miss;
  miss.values = {away.x(), away.y(), 0};
  if (angle) {
    miss.values[2] = kAngleWeight * (*angle - arm.end_angle());
    miss.rows = 3;
  }
  return miss;
}

using Column = std::array<double, 3>;

/// The change of the task by each turn.
std::vector<Column> columns_of(const Arm& arm, std::size_t rows) {
  std::vector<Column> columns(arm.size());
  for (std::size_t i = 0; i < arm.size(); ++i) {
    const Vector2 lever = (arm.end() - arm.places()[i]) / arm.length();
    columns[i] = {lever.y(), -lever.x(), rows == 3 ? kAngleWeight : 0};
  }
  return columns;
}

double dot(const Column& a, const Column& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The least turns that mend the miss, damped. Those that would turn past a limit are kept out.
std::vector<double> turns_towards(const Arm& arm, const Miss& miss, const std::vector<Column>& columns,
                                  double damping) {
  std::vector<double> by(arm.size(), 0);
  std::vector<char> blocked(arm.size(), 0);
  for (std::size_t round = 0; round <= arm.size(); ++round) {
    std::array<double, 9> normal = {};
    const std::size_t n = miss.rows;
    for (std::size_t i = 0; i < arm.size(); ++i) {
      if (blocked[i]) continue;
      for (std::size_t r = 0; r < n; ++r)
        for (std::size_t c = 0; c < n; ++c) normal[r * n + c] += columns[i][r] * columns[i][c];
    }
    for (std::size_t r = 0; r < n; ++r) normal[r * n + r] += damping;
    Column pull = miss.values;
    solve_symmetric({normal.data(), n * n}, {pull.data(), n});
    bool is_free = true;
    for (std::size_t i = 0; i < arm.size(); ++i) {
      by[i] = blocked[i] ? 0 : dot(columns[i], pull);
      if ((by[i] > 0 && arm.room_above(i) <= 0) || (by[i] < 0 && arm.room_below(i) <= 0)) {
        blocked[i] = 1;
        is_free = false;
      }
    }
    if (is_free) return by;
  }
  return std::vector<double>(arm.size(), 0);
}

/// Levenberg and Marquardt's steps until nothing more comes of them.
void approach(Arm& arm, const Vector2& target, const std::optional<double>& angle) {
  double damping = 1e-4;
  Miss miss = miss_of(arm, target, angle);
  for (int step = 0; step < kReachSteps && miss.squared() > 1e-26; ++step) {
    const std::vector<double> before = arm.turns();
    std::vector<double> turns = turns_towards(arm, miss, columns_of(arm, miss.rows), damping);
    double largest = 0;
    for (const double turn : turns) largest = std::max(largest, std::abs(turn));
    if (largest < 1e-14) return;
    const double share = std::min(1.0, 1.0 / largest);
    for (std::size_t i = 0; i < turns.size(); ++i) turns[i] = before[i] + share * turns[i];
    arm.set_turns(turns);
    const Miss now = miss_of(arm, target, angle);
    if (now.squared() < miss.squared()) {
      const bool is_done = miss.squared() - now.squared() < 1e-13 * miss.squared();
      miss = now;
      damping = std::max(damping * 0.1, 1e-12);
      if (is_done) return;
    } else {
      arm.set_turns(before);
      damping *= 10;
      if (damping > 1e8) return;
    }
  }
}

/// Whether the arm lies so that no small turn brings it nearer to a target that it has not reached.
bool is_stuck(const Arm& arm, const Vector2& target) {
  const Miss miss = miss_of(arm, target, std::nullopt);
  const double error = std::sqrt(miss.squared());
  if (error < 1e-6) return false;
  for (const Column& column : columns_of(arm, 2))
    if (std::abs(dot(column, miss.values)) > kStuck * error) return false;
  return true;
}

/// Bends a straight arm, each joint to the side that has more room.
void bend(Arm& arm) {
  std::vector<double> turns = arm.turns();
  double sum = 0;
  for (std::size_t i = 1; i < arm.size(); ++i) {
    const double by = arm.room_above(i) >= std::min(kFirstBend, arm.room_below(i)) ? kFirstBend : -kFirstBend;
    turns[i] += by;
    sum += by;
  }
  turns[0] -= arm.size() > 1 ? sum / 2 : -kFirstBend;
  arm.set_turns(turns);
}

/// The place that the end can go to for a hand, near the reach and near the hole about the root, whose radius
/// is `hole`, at a distance from the root that changes ever more slowly.
class Followed {
 public:
  explicit Followed(const Arm& arm)
      : far_(arm.length()),
        hole_(std::max(0.0, 2 * arm.longest() - far_)),
        zone_(arm.size() > 1 ? std::min(kSlowZone * far_, (far_ - hole_) / 4) : 0) {}

  Vector2 place(const Arm& arm, const Vector2& hand, bool continues) const {
    const Vector2 way = hand - arm.origin(), now = arm.end() - arm.origin();
    const double distance = way.norm(), goes_to = radius(distance);
    const bool has_end = now.norm() > kNoLength;
    if (distance < kNoLength && !has_end) return arm.end();
    const Vector2 from = has_end ? Vector2(now.normalized()) : Vector2(way / distance);
    const Vector2 ahead = distance < kNoLength ? from : Vector2(way / distance);
    const double turn = std::atan2(-cross(from, ahead), from.dot(ahead));
    // Where the end cannot be with the hand, a hand that passes the root turns the chain by what pulls it
    // sideways.
    const double apart = std::max(std::abs(goes_to - distance), std::min(hole_, (hand - arm.end()).norm()));
    const double allowed = std::min(kSideways * std::abs(cross(way, from)), kSwing * goes_to);
    if (!continues || std::abs(turn) * apart <= allowed) return arm.origin() + goes_to * ahead;
    return arm.origin() + goes_to * turned(from, std::copysign(allowed / apart, turn));
  }

 private:
  double radius(double distance) const {
    if (zone_ <= 0) return far_;
    if (distance > far_ - zone_) return far_ - zone_ * zone_ / (distance - far_ + 2 * zone_);
    if (hole_ > 0 && distance < hole_ + zone_) return hole_ + zone_ * zone_ / (hole_ - distance + 2 * zone_);
    return distance;
  }

  double far_, hole_, zone_;
};

/// Goes but a share of the way from the first pose, so that no part moves further than that.
void restrain(Arm& arm, const Arm& first, double most) {
  double moved = 0;
  for (std::size_t i = 0; i < first.places().size(); ++i)
    moved = std::max(moved, (arm.places()[i] - first.places()[i]).norm());
  if (moved <= most) return;
  std::vector<double> turns = arm.turns();
  for (std::size_t i = 0; i < turns.size(); ++i)
    turns[i] = first.turns()[i] + most / moved * (turns[i] - first.turns()[i]);
  arm.set_turns(turns);
}

}  // namespace

void reach(Rig& rig, const ArmWish& wish, bool continues) {
  Arm arm(rig, wish);
  const Arm first = arm;
  if (arm.length() < kNoLength) {
    if (!wish.angle) return;
    std::vector<double> turns = arm.turns();
    turns.back() += *wish.angle - arm.end_angle();
    arm.set_turns(turns);
    return arm.write(rig, wish.turning);
  }
  const Vector2 target = Followed(arm).place(arm, wish.target, continues);
  double ahead = std::min((target - arm.end()).norm(), (wish.target - arm.end()).norm());
  if (wish.angle) ahead += arm.last_link() * std::abs(*wish.angle - arm.end_angle());
  if (wish.angle) approach(arm, target, wish.angle);
  approach(arm, target, std::nullopt);
  if (is_stuck(arm, target)) {
    Arm bent = arm;
    bend(bent);
    approach(bent, target, std::nullopt);
    if ((bent.end() - target).norm() < 0.999 * (arm.end() - target).norm()) arm = bent;
  }
  if (continues) restrain(arm, first, kGain * ahead);
  arm.write(rig, wish.turning);
}

}  // namespace icome::animation
