#include "haptics/judge/witness_ways.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace icome::haptics {
namespace {

using base::Vector3;

constexpr double kAside = 1e-3;          // of the straight way: distance that it is moved off edges
constexpr int kBends = 6;                // ways that are tried
constexpr double kOffEdge = 1e-9;        // the least barycentric part of a passage that is in no doubt
constexpr double kOffCorner = 1e-3;      // of a triangle: distance within its rim from which it is left
constexpr int kMostAlongEdge = 16;       // places that an edge is left from
constexpr double kAlongEdge = 1.0 / 16;  // of the straight way: distance between these

double distance_to_edge(const Vector3& from, const Vector3& to, const Vector3& point) {
  const Vector3 way = to - from;
  const double squared = way.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((point - from).dot(way) / squared, 0.0, 1.0) : 0.0;
  return (from + t * way - point).norm();
}

Vector3 front_of(const WitnessTree::Corners& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
}

/// For each vertex the first at the same position.
std::vector<std::uint32_t> welded(const geometry::TriangleMesh& mesh) {
  const auto count = std::uint32_t(mesh.positions.size());
  const auto place = [&](std::uint32_t vertex) {
    const Vector3& p = mesh.positions[vertex];
    return std::tuple(p.x(), p.y(), p.z());
  };
  std::vector<std::uint32_t> order(count), result(count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t j) { return place(i) < place(j); });
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool same = i > 0 && place(order[i]) == place(order[i - 1]);
    result[order[i]] = same ? result[order[i - 1]] : order[i];
  }
  return result;
}

}  // namespace

WitnessWays::WitnessWays(const WitnessTree& tree, const geometry::TriangleMesh& mesh, bool two_sided)
    : tree_(tree), two_sided_(two_sided) {
  connect(mesh);
}

void WitnessWays::connect(const geometry::TriangleMesh& mesh) {
  struct Side {
    std::uint32_t low, high, index;
    bool upward;
  };
  const std::vector<std::uint32_t> vertex = welded(mesh);
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = vertex[mesh.triangles[i][k]];
      const std::uint32_t to = vertex[mesh.triangles[i][(k + 1) % 3]];
      sides.push_back({std::min(from, to), std::max(from, to), 3 * i + k, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& i, const Side& j) {
    return std::tie(i.low, i.high, i.index) < std::tie(j.low, j.high, j.index);
  });
  edge_of_.resize(sides.size());
  at_edges_.resize(sides.size());
  int upward = 0;
  for (std::uint32_t i = 0; i < sides.size(); ++i) {
    const bool same = i > 0 && sides[i].low == sides[i - 1].low && sides[i].high == sides[i - 1].high;
    if (!same) {
      edges_.push_back({i, 0, true});
      upward = 0;
    }
    upward += sides[i].upward ? 1 : -1;
    ++edges_.back().count;
    edges_.back().balanced = upward == 0 || sides[i].low == sides[i].high;
    at_edges_[i] = sides[i].index;
    edge_of_[sides[i].index] = std::uint32_t(edges_.size() - 1);
  }
}

/// The triangles that the way from `a` to `b` passes; nothing where an edge leaves one in doubt.
std::optional<std::vector<WitnessWays::Passage>> WitnessWays::passages(const Vector3& a,
                                                                       const Vector3& b) const {
  std::vector<Passage> result;
  bool clear = true;
  tree_.along(a, b, [&](std::uint32_t triangle) {
    const std::optional<Crossing> crossed = crossing(tree_.corners(triangle), a, b - a);
    if (!crossed) return;
    result.push_back({triangle, crossed->from_front ? 1 : -1});
    clear = clear && crossed->margin > kOffEdge;
  });
  return clear ? std::optional(std::move(result)) : std::nullopt;
}

/// The triangles passed by a way that is moved aside so that no edge lies on it where it begins or ends.
std::optional<std::vector<WitnessWays::Passage>> WitnessWays::bent_passages(const Vector3& a,
                                                                            const Vector3& b) const {
  const Vector3 way = b - a;
  const Vector3 side = way.unitOrthogonal(), other = way.normalized().cross(side);
  for (int i = 0; i < kBends; ++i) {
    const Vector3 aside = kAside * way.norm() * (std::cos(1.0 + i) * side + std::sin(1.0 + i) * other);
    const std::array<Vector3, 4> places{a, a + aside, b + aside, b};
    std::vector<Passage> result;
    bool clear = true;
    for (std::size_t k = 0; k + 1 < places.size() && clear; ++k) {
      const auto leg = passages(places[k], places[k + 1]);
      clear = leg.has_value();
      if (clear) result.insert(result.end(), leg->begin(), leg->end());
    }
    if (clear) return result;
  }
  return std::nullopt;
}

bool WitnessWays::apart(const Vector3& a, const Vector3& b, const Vector3& centre, int& steps) const {
  const double bend = 2.0 * kAside * (b - a).norm();
  if (bend <= 0.0) return false;
  const auto all = bent_passages(a, b);
  if (!all) return false;
  Ball ball{centre, std::max((a - centre).norm(), (b - centre).norm()) + bend};
  std::unordered_map<std::uint32_t, std::size_t> part_of;
  std::vector<int> passed;   // by part: passages from the front less those from behind
  std::vector<bool> rimmed;  // has it a rim in the ball?
  for (const auto& [triangle, side] : *all) {
    if (!part_of.contains(triangle)) {
      rimmed.push_back(mark_part(triangle, passed.size(), ball, part_of, steps));
      passed.push_back(0);
    }
    passed[part_of[triangle]] += side;
  }
  for (std::size_t i = 0; i < passed.size(); ++i) {
    if (!rimmed[i] && (passed[i] > 0 || (two_sided_ && passed[i] != 0))) return true;
  }
  return false;
}

/// Marks the triangles connected with one within the ball. Have they a rim there, as far as the steps go?
bool WitnessWays::mark_part(std::uint32_t start, std::size_t part, const Ball& ball,
                            std::unordered_map<std::uint32_t, std::size_t>& part_of, int& steps) const {
  bool rimmed = false;
  std::vector<std::uint32_t> open{start};
  part_of[start] = part;
  while (!open.empty()) {
    if (steps <= 0) return true;  // untested triangles may have one
    --steps;
    const std::uint32_t triangle = open.back();
    open.pop_back();
    const WitnessTree::Corners corners = tree_.corners(triangle);
    for (int k = 0; k < 3; ++k) {
      if (distance_to_edge(corners[k], corners[(k + 1) % 3], ball.centre) > ball.radius) continue;
      const Edge& between = edge(triangle, k);
      rimmed = rimmed || !between.balanced;
      for (std::uint32_t i = 0; i < between.count; ++i) {
        const std::uint32_t next = at_edges_[between.first + i] / 3;
        if (part_of.emplace(next, part).second) open.push_back(next);
      }
    }
  }
  return rimmed;
}

/// One search along the surface: from the triangle with the highest place known to the next, so that each is
/// gone on from once.
class WitnessWays::Walk {
 public:
  /// `glides`: from each place the point also goes on through the air, as one does that slides over an edge.
  Walk(const WitnessWays& ways, const Vector3& b, const Vector3& tip, double noise, double apart, bool glides,
       int& steps)
      : ways_(ways),
        b_(b),
        tip_(tip),
        noise_(noise),
        apart_(kAlongEdge * apart),
        glides_(glides),
        steps_(steps) {
    goal_ = (b - tip).norm() - 4.0 * noise;
  }

  WaySearch run(const Vector3& a) {
    touch(a, (a - tip_).norm());
    leave(a);
    while (!found_ && !open_.empty()) {
      if (--steps_ < 0) return WaySearch::GaveUp;
      const auto [level, node] = open_.top();
      open_.pop();
      if (level < level_[node]) continue;
      go_on(node, level);
    }
    return found_ ? WaySearch::Found : WaySearch::None;
  }

 private:
  using Node = std::uint32_t;  // twice the triangle, plus 1 for its back

  /// Unit normal of the node's side: its triangle's front or back.
  Vector3 out_of(Node node) const {
    const Vector3 front = front_of(ways_.tree_.corners(node / 2));
    return node % 2 == 1 ? Vector3(-front) : front;
  }

  /// Notes that the point can come to a place of that node as far from the tip as `level`.
  void reach(Node node, double level) {
    if (level < goal_) return;
    const auto [known, is_new] = level_.emplace(node, level);
    if (!is_new && level <= known->second) return;
    known->second = level;
    open_.emplace(level, node);
    found_ = found_ || (nearest(node / 2, b_) - b_).norm() <= 4.0 * noise_;
  }

  Vector3 nearest(std::uint32_t triangle, const Vector3& point) const {
    return nearest_on(ways_.tree_.corners(triangle), point);
  }

  /// Notes that the point is at a place, which may lie on some triangles.
  void touch(const Vector3& place, double level) {
    const double near = 4.0 * noise_;
    ways_.tree_.around(place, near, [&](std::uint32_t triangle) {
      if ((nearest(triangle, place) - place).norm() > near) return;
      for (Node node = 2 * triangle; node <= 2 * triangle + (ways_.two_sided_ ? 1 : 0); ++node) {
        if (out_of(node).dot(place - nearest(triangle, place)) >= -noise_) reach(node, level);
      }
    });
  }

  /// Lets the point fall from a place off the surface to the tip, or go straight to its goal.
  void leave(const Vector3& place) {
    --steps_;
    if ((place - tip_).norm() >= goal_) found_ = found_ || comes_to_goal(place);
    const std::optional<std::pair<double, Node>> met = first_met(place, tip_);
    if (met) reach(met->second, (1.0 - met->first) * (place - tip_).norm());
  }

  /// Lets the point go on in the plane with that normal, as it does that slides over the edge of a face, to
  /// the place nearest to the tip.
  void glide(const Vector3& place, const Vector3& out) {
    --steps_;
    const Vector3 way = (tip_ - place) - out.dot(tip_ - place) * out;
    const std::optional<std::pair<double, Node>> met = first_met(place, place + way);
    if (met) {
      reach(met->second, (place + met->first * way - tip_).norm());
    } else {
      leave(place + way);
    }
  }

  bool comes_to_goal(const Vector3& place) const {
    const std::optional<std::pair<double, Node>> met = first_met(place, b_);
    return !met || (1.0 - met->first) * (b_ - place).norm() <= 4.0 * noise_;
  }

  /// The share of the way that is free, and the node that ends it; nothing where all is free.
  std::optional<std::pair<double, Node>> first_met(const Vector3& from, const Vector3& to) const {
    std::optional<std::pair<double, Node>> first;
    ways_.tree_.along(from, to, [&](std::uint32_t triangle) {
      const std::optional<Crossing> crossed = crossing(ways_.tree_.corners(triangle), from, to - from);
      if (!crossed || !(ways_.two_sided_ || crossed->from_front)) return;
      if (!first || crossed->t < first->first)
        first = {crossed->t, 2 * triangle + (crossed->from_front ? 0u : 1u)};
    });
    return first;
  }

  void go_on(Node node, double level) {
    const std::uint32_t triangle = node / 2;
    const WitnessTree::Corners corners = ways_.tree_.corners(triangle);
    for (int k = 0; k < 3; ++k) {
      const Vector3 &from = corners[k], &to = corners[(k + 1) % 3];
      if (distance_to_edge(from, to, tip_) > level + noise_) continue;
      const double highest = std::max((from - tip_).norm(), (to - tip_).norm());
      cross(node, k, std::min(level, highest));
    }
    const Vector3 out = out_of(node);
    if (out.dot(tip_ - corners[0]) <= 0.0 && out.dot(b_ - corners[0]) <= noise_) return;
    leave_from(corners, out, level);
  }

  /// Goes over an edge to the triangles beyond: those that run along it the other way show the same side.
  void cross(Node node, int k, double level) {
    const Edge& between = ways_.edge(node / 2, k);
    if (between.count == 1) {
      if (ways_.two_sided_) reach(node ^ 1u, level);
      return;
    }
    for (std::uint32_t i = 0; i < between.count; ++i) {
      const std::uint32_t side = ways_.at_edges_[between.first + i];
      if (side / 3 == node / 2) continue;
      const bool turned = between.count == 2 && !between.balanced;
      const Node next = 2 * (side / 3) + (turned ? 1 - node % 2 : node % 2);
      if (next % 2 == 0 || ways_.two_sided_) reach(next, level);
    }
  }

  /// Leaves from places along the rim, from the middle, and from the place nearest to the tip.
  void leave_from(const WitnessTree::Corners& corners, const Vector3& out, double level) {
    const Vector3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const auto from = [&](const Vector3& place) {
      const Vector3 inner = place + kOffCorner * (middle - place);
      if (found_ || (inner - tip_).norm() > level + noise_) return;
      const Vector3 off = inner + 2.0 * noise_ * out;
      // Beside a sharp concave crease the place may lie behind the next triangle.
      if (first_met(middle + 2.0 * noise_ * out, off)) return;
      leave(off);
      if (glides_) glide(off, out);
    };
    from(middle);
    from(nearest_on(corners, tip_));
    for (int k = 0; k < 3; ++k) {
      const Vector3 along = corners[(k + 1) % 3] - corners[k];
      const int count = std::clamp(int(std::ceil(along.norm() / apart_)), 1, kMostAlongEdge);
      for (int i = 0; i < count; ++i) from(corners[k] + (double(i) / count) * along);
    }
  }

  const WitnessWays& ways_;
  Vector3 b_, tip_;
  double noise_;
  double apart_;  // m, places along an edge
  bool glides_;
  int& steps_;
  double goal_;  // m, distance from the tip that must be within reach of the point to come to `b_`
  bool found_ = false;
  std::unordered_map<Node, double> level_;
  std::priority_queue<std::pair<double, Node>> open_;
};

WaySearch WitnessWays::leads(const Vector3& a, const Vector3& b, const Vector3& tip, double noise,
                             int& steps) const {
  const double apart = (b - a).norm();
  const WaySearch found = Walk(*this, b, tip, noise, apart, false, steps).run(a);
  // Few ways need it, and it doubles the cost.
  return found == WaySearch::None ? Walk(*this, b, tip, noise, apart, true, steps).run(a) : found;
}

}  // namespace icome::haptics
