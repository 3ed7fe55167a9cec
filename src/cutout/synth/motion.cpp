#include "cutout/synth/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace icome::cutout {
namespace {

constexpr double kHalfCircle = std::numbers::pi;
constexpr double kEdgeMargin = 6.0;   // mm that stay free along the table's edges
constexpr double kLeastGap = 2.5;     // mm between triangles that pass
constexpr double kScatterGap = 10.0;  // mm between triangles that were laid down
constexpr double kTopSpeed = 350.0;   // mm/s
constexpr double kTopTurn = 4.0;      // rad/s
constexpr double kPull = 40.0;        // 1/s^2 towards the goal, critically damped
constexpr int kStepsInFrame = 4;
constexpr std::uint64_t kMotionSeed = 0x6d6f74696f6e0000ULL;
constexpr std::uint64_t kStillSeed = 0x7374696c6c000000ULL;

using TriangleCorners = std::array<base::Vector2, 3>;

/// Way by which the corners must be moved to lie on the table.
base::Vector2 way_onto_table(const TriangleCorners& corners, const SyntheticOptions& options) {
  base::Vector2 least = corners[0], most = corners[0];
  for (const base::Vector2& corner : corners) {
    least = least.cwiseMin(corner);
    most = most.cwiseMax(corner);
  }
  base::Vector2 way = base::Vector2::Zero();
  const base::Vector2 low(kEdgeMargin, kEdgeMargin);
  const base::Vector2 high(options.table_width - kEdgeMargin, options.table_height - kEdgeMargin);
  for (int axis = 0; axis < 2; ++axis) {
    if (most[axis] > high[axis]) way[axis] = high[axis] - most[axis];
    if (least[axis] < low[axis]) way[axis] = low[axis] - least[axis];
  }
  return way;
}

TrianglePose any_pose(const SyntheticOptions& options, base::Random& random) {
  TrianglePose pose;
  pose.centroid = {random.uniform(0, options.table_width), random.uniform(0, options.table_height)};
  pose.angle = random.uniform(-kHalfCircle, kHalfCircle);
  return pose;
}

double wrapped_turn(double angle) { return std::remainder(angle, 2.0 * kHalfCircle); }

/// Tries to lay all down with that gap; what finds no place lies beyond the table.
std::vector<TrianglePose> scattered_apart(const SyntheticOptions& options, base::Random& random, double gap,
                                          bool& all) {
  constexpr int kTries = 400;
  std::vector<TrianglePose> poses;
  std::vector<TriangleCorners> lying;
  all = true;
  for (const KnownTriangle& triangle : options.known.triangles) {
    bool found = false;
    for (int i = 0; i < kTries && !found; ++i) {
      TrianglePose pose = any_pose(options, random);
      const TriangleCorners corners = synthetic_corners(triangle, pose);
      found = way_onto_table(corners, options).isZero() &&
              std::ranges::all_of(lying,
                                  [&](const TriangleCorners& other) { return apart(corners, other) > gap; });
      if (!found) continue;
      poses.push_back(pose);
      lying.push_back(corners);
    }
    if (found) continue;
    all = false;
    poses.push_back({{-10.0 * options.table_width, -10.0 * options.table_height}, 0.0});
  }
  return poses;
}

SyntheticHand holding(const SyntheticOptions& options, const TrianglePose& pose, std::size_t which,
                      double lean, int look) {
  SyntheticHand hand;
  hand.left = which % 2 == 0;
  hand.look = look;
  hand.grip = pose.centroid;
  // Arms reach in from the side of the table that is lowest in the frame, where the user sits.
  const base::Vector2 shoulder(options.table_width * (hand.left ? 0.25 : 0.75), 1.6 * options.table_height);
  const base::Vector2 way = pose.centroid - shoulder;
  hand.angle = wrapped_turn(std::atan2(-way.y(), way.x()) + lean);
  return hand;
}

/// Moves triangles from frame to frame.
class SlidingTriangles {
 public:
  explicit SlidingTriangles(const SyntheticOptions& options)
      : options_(options), random_(options.seed ^ kMotionSeed), bodies_(options.known.triangles.size()) {
    const std::vector<TrianglePose> poses = scattered(options, random_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i].pose = poses[i];
      bodies_[i].goal = poses[i];
      bodies_[i].rests_until = random_.uniform(0.0, 0.5);
      bodies_[i].absent = poses[i].centroid.x() < 0;
      if (bodies_[i].absent) bodies_[i].rests_until = std::numeric_limits<double>::infinity();
    }
    if (options.hands && !bodies_.empty())
      for (std::size_t i = 0; i < std::min<std::size_t>(2, bodies_.size()); ++i) {
        hands_.push_back({.holds = i, .lean = random_.uniform(-0.3, 0.3)});
        hands_.back().grip = bodies_[i].pose.centroid;
        hands_.back().look = int(random_.index(1000));
      }
  }

  SyntheticScene scene() const {
    SyntheticScene scene;
    for (const Body& body : bodies_)
      scene.poses.push_back({body.pose.centroid, wrapped_turn(body.pose.angle)});
    for (std::size_t i = 0; i < hands_.size(); ++i)
      scene.hands.push_back(holding(options_, {hands_[i].grip, 0.0}, i, hands_[i].lean, hands_[i].look));
    return scene;
  }

  void step(double seconds) {
    for (int i = 0; i < kStepsInFrame; ++i) {
      time_ += seconds / kStepsInFrame;
      for (std::size_t k = 0; k < bodies_.size(); ++k) move(k, seconds / kStepsInFrame);
      for (Held& hand : hands_) move_hand(hand, seconds / kStepsInFrame);
      keep_apart();
    }
  }

 private:
  struct Body {
    TrianglePose pose, goal;
    base::Vector2 speed = base::Vector2::Zero();
    double turn = 0;
    double rests_until = 0;
    double goal_until = 0;
    bool absent = false;
  };
  struct Held {
    std::size_t holds = 0;
    double lean = 0;
    base::Vector2 grip = base::Vector2::Zero();
    base::Vector2 speed = base::Vector2::Zero();
    double until = 0;
    int look = 0;
  };

  bool may_move(std::size_t which) const {
    if (bodies_[which].absent) return false;
    if (!options_.hands) return true;
    return std::ranges::any_of(hands_, [&](const Held& hand) {
      return hand.holds == which && (hand.grip - bodies_[which].pose.centroid).norm() < 12.0;
    });
  }

  void choose_goal(std::size_t which) {
    Body& body = bodies_[which];
    body.goal_until = time_ + random_.uniform(1.0, 2.5);
    const std::size_t other = random_.index(bodies_.size());
    if (random_.uniform() < 0.6 && other != which && may_move(other)) {
      const TrianglePose mine = body.pose;
      body.goal = bodies_[other].pose;
      bodies_[other].goal = mine;
      bodies_[other].goal_until = body.goal_until;
      bodies_[other].rests_until = 0;
    } else {
      body.goal = any_pose(options_, random_);
    }
    body.goal.angle = body.pose.angle + random_.uniform(-2.0, 2.0);
  }

  void move(std::size_t which, double seconds) {
    Body& body = bodies_[which];
    const bool still = !may_move(which) || time_ < body.rests_until;
    if (still) {
      body.speed.setZero();
      body.turn = 0;
      return;
    }
    if (time_ > body.goal_until) {
      if (body.goal_until > 0 && random_.uniform() < 0.4) {
        body.rests_until = time_ + random_.uniform(0.2, 1.2);
        body.goal_until = 0;
        return;
      }
      choose_goal(which);
    }
    const double damping = 2.0 * std::sqrt(kPull);
    body.speed += seconds * (kPull * (body.goal.centroid - body.pose.centroid) - damping * body.speed);
    if (body.speed.norm() > kTopSpeed) body.speed *= kTopSpeed / body.speed.norm();
    body.turn += seconds * (kPull * (body.goal.angle - body.pose.angle) - damping * body.turn);
    body.turn = std::clamp(body.turn, -kTopTurn, kTopTurn);
    body.pose.centroid += seconds * body.speed;
    body.pose.angle += seconds * body.turn;
  }

  void move_hand(Held& hand, double seconds) {
    if (time_ > hand.until) {
      if (hand.until > 0) {
        const std::size_t next = random_.index(bodies_.size());
        const bool held = std::ranges::any_of(hands_, [&](const Held& other) { return other.holds == next; });
        if (!held && !bodies_[next].absent) hand.holds = next;
      }
      hand.until = time_ + random_.uniform(2.0, 4.0);
    }
    const base::Vector2 way = bodies_[hand.holds].pose.centroid - hand.grip;
    const double farthest = 1.6 * kTopSpeed * seconds;
    hand.grip += way.norm() > farthest ? base::Vector2(way * (farthest / way.norm())) : way;
  }

  void keep_apart() {
    constexpr int kRounds = 40;
    for (int round = 0; round < kRounds; ++round) {
      bool any = false;
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (bodies_[i].absent) continue;
        bodies_[i].pose.centroid +=
            way_onto_table(synthetic_corners(options_.known.triangles[i], bodies_[i].pose), options_);
        for (std::size_t k = i + 1; k < bodies_.size(); ++k) any = push_apart(i, k) || any;
      }
      if (!any) return;
    }
  }

  bool push_apart(std::size_t one, std::size_t other) {
    Body& a = bodies_[one];
    Body& b = bodies_[other];
    if (b.absent) return false;
    const auto& known = options_.known.triangles;
    const auto reach = [](const KnownTriangle& it) {
      return it.height + it.height / std::tan(it.base_angle);
    };
    const double far = reach(known[one]) + reach(known[other]) + kLeastGap;
    if ((a.pose.centroid - b.pose.centroid).squaredNorm() > far * far) return false;
    base::Vector2 way;
    const double gap =
        apart(synthetic_corners(known[one], a.pose), synthetic_corners(known[other], b.pose), &way);
    if (gap >= kLeastGap) return false;
    // Both turn aside to their right, so that two that meet do not stand before one another.
    const base::Vector2 push =
        0.5 * (kLeastGap + 0.01 - gap) * (way + 0.35 * base::Vector2(-way.y(), way.x()));
    a.pose.centroid -= push;
    b.pose.centroid += push;
    return true;
  }

  const SyntheticOptions& options_;
  base::Random random_;
  std::vector<Body> bodies_;
  std::vector<Held> hands_;
  double time_ = 0;
};

}  // namespace

TriangleCorners synthetic_corners(const KnownTriangle& triangle, const TrianglePose& pose) {
  const base::Vector2 up(std::cos(pose.angle), -std::sin(pose.angle));
  const base::Vector2 left(-std::sin(pose.angle), -std::cos(pose.angle));
  const double half = triangle.height / std::tan(triangle.base_angle);
  const base::Vector2 foot = pose.centroid - up * (triangle.height / 3.0);
  return {foot + up * triangle.height, foot + left * half, foot - left * half};
}

double apart(const TriangleCorners& one, const TriangleCorners& other, base::Vector2* way) {
  double best = -std::numeric_limits<double>::infinity();
  for (const bool of_one : {true, false}) {
    const TriangleCorners& edges = of_one ? one : other;
    const TriangleCorners& points = of_one ? other : one;
    const base::Vector2 middle = (edges[0] + edges[1] + edges[2]) / 3.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const base::Vector2 along = edges[(i + 1) % 3] - edges[i];
      base::Vector2 normal = base::Vector2(along.y(), -along.x()).normalized();
      if (normal.dot(middle - edges[i]) > 0) normal = -normal;
      double gap = std::numeric_limits<double>::infinity();
      for (const base::Vector2& point : points) gap = std::min(gap, normal.dot(point - edges[i]));
      if (gap <= best) continue;
      best = gap;
      if (way != nullptr) *way = of_one ? normal : base::Vector2(-normal);
    }
  }
  return best;
}

std::vector<TrianglePose> scattered(const SyntheticOptions& options, base::Random& random) {
  std::vector<TrianglePose> poses;
  bool all = false;
  for (double gap = kScatterGap; !all && gap > 0.3 * kLeastGap; gap *= 0.7)
    for (int i = 0; !all && i < 3; ++i) poses = scattered_apart(options, random, gap, all);
  return poses;
}

bool all_on_table(const SyntheticOptions& options, const std::vector<TrianglePose>& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (!way_onto_table(synthetic_corners(options.known.triangles[i], poses[i]), options).isZero())
      return false;
  return true;
}

std::vector<SyntheticScene> moving_scenes(const SyntheticOptions& options) {
  SlidingTriangles sliding(options);
  std::vector<SyntheticScene> scenes;
  scenes.reserve(std::size_t(options.frames));
  for (int i = 0; i < options.frames; ++i) {
    scenes.push_back(sliding.scene());
    sliding.step(1.0 / options.rate);
  }
  return scenes;
}

SyntheticScene still_scene(const SyntheticOptions& options, int number) {
  base::Random random(options.seed ^ kStillSeed ^ (std::uint64_t(number) * 0x9e3779b97f4a7c15ULL));
  random.bits();
  SyntheticScene scene;
  scene.poses = scattered(options, random);
  if (!options.hands || scene.poses.empty()) return scene;
  for (std::size_t i = 0; i < 2; ++i)
    scene.hands.push_back(holding(options, scene.poses[random.index(scene.poses.size())], i,
                                  random.uniform(-0.5, 0.5), int(random.index(1000))));
  return scene;
}

}  // namespace icome::cutout
