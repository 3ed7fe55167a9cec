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

/// What each turn does to the task.
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

/// The distance from its root at which the end follows a hand at `distance`.
double followed(const Arm& arm, double distance) {
  const double far = arm.length();
  if (arm.size() == 1) return far;
  const double near = std::max(0.0, 2 * arm.longest() - far);
  const double zone = std::min(kSlowZone * far, (far - near) / 4);
  if (zone <= 0) return far;
  if (distance > far - zone) return far - zone * zone / (distance - far + 2 * zone);
  if (near > 0 && distance < near + zone) return near + zone * zone / (near - distance + 2 * zone);
  return distance;
}

/// The place that the end can go to for a hand at `target`.
Vector2 place_for(const Arm& arm, const Vector2& target, bool continues) {
  const Vector2 way = target - arm.origin(), now = arm.end() - arm.origin();
  const double distance = way.norm(), radius = followed(arm, distance);
  if (distance < 1e-12 && now.norm() < 1e-12) return arm.end();
  if (distance < 1e-12) return arm.origin() + radius * now.normalized();
  const Vector2 ahead = way / distance;
  if (!continues || now.norm() < 1e-12) return arm.origin() + radius * ahead;
  const Vector2 from = now.normalized();
  const double turn = std::atan2(-cross(from, ahead), from.dot(ahead));
  const double allowed = 4 * std::abs(cross(way, from));
  if (std::abs(turn) * std::abs(radius - distance) <= allowed) return arm.origin() + radius * ahead;
  return arm.origin() + radius * turned(from, std::copysign(allowed / std::abs(radius - distance), turn));
}

}  // namespace

void reach(Rig& rig, const ArmWish& wish, bool continues) {
  Arm arm(rig, wish);
  const std::vector<double> first_turns = arm.turns();
  const std::vector<Vector2> first_places = arm.places();
  if (arm.length() < 1e-9) {
    if (!wish.angle) return;
    std::vector<double> turns = first_turns;
    turns.back() += *wish.angle - arm.end_angle();
    arm.set_turns(turns);
    return arm.write(rig, wish.turning);
  }
  const Vector2 target = place_for(arm, wish.target, continues);
  double ahead = std::min((target - arm.end()).norm(), (wish.target - arm.end()).norm());
  if (wish.angle) ahead += arm.last_link() * std::abs(*wish.angle - arm.end_angle());
  if (wish.angle) approach(arm, target, wish.angle);
  approach(arm, target, std::nullopt);
  if (is_stuck(arm, target)) {
    const std::vector<double> stuck = arm.turns();
    const double error = (arm.end() - target).norm();
    bend(arm);
    approach(arm, target, std::nullopt);
    if ((arm.end() - target).norm() > 0.999 * error) arm.set_turns(stuck);
  }
  if (continues) {
    double moved = 0;
    for (std::size_t i = 0; i < first_places.size(); ++i)
      moved = std::max(moved, (arm.places()[i] - first_places[i]).norm());
    if (moved > kGain * ahead) {
      std::vector<double> turns = arm.turns();
      const double share = kGain * ahead / moved;
      for (std::size_t i = 0; i < turns.size(); ++i)
        turns[i] = first_turns[i] + share * (turns[i] - first_turns[i]);
      arm.set_turns(turns);
    }
  }
  arm.write(rig, wish.turning);
}

}  // namespace icome::animation
