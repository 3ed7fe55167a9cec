#pragma once
#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <vector>

#include "geometry/csg/csg_tree.h"

namespace icome::haptics {

/// A step of a solid that is put together of others: a leaf, or an operation on two steps before.
struct PlainStep {
  /// Lower bound on the distance (m) of a leaf's surface; negative inside. Empty in an operation.
  std::function<double(const base::Vector3&)> bound = {};
  geometry::CsgOperator op = geometry::CsgOperator::Union;
  std::array<std::uint32_t, 2> operands = {};
};

/// Space divided into cubes that are all solid, all free, or halved further. Cubes are divided when a
/// question needs them, and kept for the next, which is most likely about the same place; when there are too
/// many, all are forgotten. One thread at a time.
class PlainCells {
 public:
  static constexpr std::size_t kMostKept = 1 << 19;  // cubes, and steps of programs: some tens of MB

  /// The last of the steps is the solid.
  explicit PlainCells(std::vector<PlainStep> solid) : solid_(std::move(solid)) {}

  /// See MembershipSolid::nearest.
  std::optional<base::Vector3> nearest(const base::Vector3& point, double limit, double fineness);

  std::size_t kept() const { return cells_.size() + kept_steps_; }

 private:
  /// A step of the solid in a cube, without the parts that are all solid or all free there.
  struct LocalStep {
    std::uint32_t leaf;  // in the solid's steps; kOperation: none
    geometry::CsgOperator op;
    std::uint32_t left, right;
    auto operator<=>(const LocalStep&) const = default;
  };
  struct Program {
    std::vector<LocalStep> steps;
    std::uint32_t root;
    auto operator<=>(const Program&) const = default;
  };

  struct Cell {
    double bound;            // m, at its centre: the surface is at least so far away; negative inside
    const Program* program;  // null: all solid or all free
    std::uint32_t eighths;   // the first of eight; 0: not divided yet
  };
  /// A cell to be tested: no place of the solid in it is nearer than `least`.
  struct Waiting {
    double least;
    std::uint32_t cell;
    base::Vector3 centre;
    double half;
  };
  struct Later {
    bool operator()(const Waiting& one, const Waiting& other) const { return one.least > other.least; }
  };
  using Queue = std::priority_queue<Waiting, std::vector<Waiting>, Later>;

  void make_room(double limit);
  void forget();
  void wait_at_roots(Queue& queue, const base::Vector3& point, double limit);
  void wait_at(Queue& queue, std::uint32_t cell, const base::Vector3& centre, double half,
               const base::Vector3& point, double limit);
  std::uint32_t root(const std::array<std::int64_t, 3>& place);
  std::uint32_t eighths(const Waiting& of);
  Cell made(const Program& around, const base::Vector3& centre, double half);
  const Program* local(const Program& around, double corner);
  double bound(const Program& program, const base::Vector3& point);
  double least_distance(const Program& program, const base::Vector3& point, const base::Vector3& over,
                        double limit);
  const Program& whole();

  std::vector<PlainStep> solid_;
  double size_ = 0.0;  // m, of the cubes that are not parts of others
  std::map<std::array<std::int64_t, 3>, std::uint32_t> roots_;  // by place, in sizes
  std::vector<Cell> cells_;
  std::set<Program> programs_;
  std::size_t kept_steps_ = 0;
  std::vector<double> values_;      // of the steps of the last program
  const Program* asked_ = nullptr;  // whose bound at the place in question is `answer_` (m)
  double answer_ = 0.0;
};

}  // namespace icome::haptics
