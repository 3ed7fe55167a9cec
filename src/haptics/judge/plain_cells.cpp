#include "haptics/judge/plain_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace icome::haptics {
namespace {

using base::Vector3;
using geometry::CsgOperator;

constexpr std::uint32_t kOperation = 0xffff'ffff;
// Stand in place of a step for a part that is all free, or all solid.
constexpr std::uint32_t kFree = 0xffff'ffff, kSolid = 0xffff'fffe;

double of_constant(std::uint32_t part) {
  return (part == kFree ? 1.0 : -1.0) * std::numeric_limits<double>::infinity();
}

double combined(CsgOperator op, double left, double right) {
  if (op == CsgOperator::Union) return std::min(left, right);
  return std::max(left, op == CsgOperator::Difference ? -right : right);
}

/// The result of an operation one operand of which is a constant; nothing where it must be computed.
std::optional<std::uint32_t> simplified(CsgOperator op, std::uint32_t left, std::uint32_t right) {
  if (op == CsgOperator::Union) {
    if (left == kSolid || right == kFree) return left;
    if (right == kSolid || left == kFree) return right;
  } else if (op == CsgOperator::Intersection) {
    if (left == kFree || right == kSolid) return left;
    if (right == kFree || left == kSolid) return right;
  } else {
    if (left == kFree || right == kFree) return left;
    if (right == kSolid) return kFree;
  }
  return std::nullopt;
}

Vector3 eighth_of_cube(const Vector3& centre, double half, unsigned number) {
  return centre + 0.5 * half * Vector3(number & 1 ? 1 : -1, number & 2 ? 1 : -1, number & 4 ? 1 : -1);
}

double corner_of_cube(double half) { return std::sqrt(3.0) * half; }

}  // namespace

// The cubes that may hold the nearest place come first. Small ones are tested at their centres only.
std::optional<Vector3> PlainCells::nearest(const Vector3& point, double limit, double fineness) {
  if (solid_.empty() || !(limit > 0.0)) return std::nullopt;
  make_room(limit);
  asked_ = nullptr;
  Queue queue;
  wait_at_roots(queue, point, limit);
  std::optional<Vector3> found;
  double least = limit;
  const auto take = [&](const Vector3& place) {
    const double distance = (place - point).norm();
    if (distance < least) found = place;
    least = std::min(least, distance);
  };
  while (!queue.empty() && queue.top().least < (found ? least - fineness : least)) {
    const Waiting next = queue.top();
    queue.pop();
    const Cell cell = cells_[next.cell];
    if (cell.bound <= 0.0) take(next.centre);
    if (cell.program == nullptr) {
      const Vector3 reach = Vector3::Constant(next.half);
      take(point.cwiseMax(next.centre - reach).cwiseMin(next.centre + reach));
    } else if (corner_of_cube(next.half) > fineness) {
      const std::uint32_t first = eighths(next);
      for (unsigned i = 0; i < 8; ++i)
        wait_at(queue, first + i, eighth_of_cube(next.centre, next.half, i), 0.5 * next.half, point, least);
    }
  }
  return found;
}

/// Fits the size of undivided cubes to the reach of questions; forgets all when there are too many.
void PlainCells::make_room(double limit) {
  if (limit > size_) {
    forget();
    size_ = 2.0 * limit;
  }
  if (kept() > kMostKept) forget();
}

void PlainCells::forget() {
  roots_.clear();
  cells_.clear();
  programs_.clear();
  kept_steps_ = 0;
}

void PlainCells::wait_at_roots(Queue& queue, const Vector3& point, double limit) {
  const auto place = [&](int axis, double off) {
    return static_cast<std::int64_t>(std::floor((point[axis] + off) / size_));
  };
  for (std::int64_t i = place(0, -limit); i <= place(0, limit); ++i) {
    for (std::int64_t j = place(1, -limit); j <= place(1, limit); ++j) {
      for (std::int64_t k = place(2, -limit); k <= place(2, limit); ++k) {
        const Vector3 centre = size_ * Vector3(double(i) + 0.5, double(j) + 0.5, double(k) + 0.5);
        wait_at(queue, root({i, j, k}), centre, 0.5 * size_, point, limit);
      }
    }
  }
}

void PlainCells::wait_at(Queue& queue, std::uint32_t cell, const Vector3& centre, double half,
                         const Vector3& point, double limit) {
  const Program* program = cells_[cell].program;
  if (program == nullptr && cells_[cell].bound > 0.0) return;
  const Vector3 reach = Vector3::Constant(half);
  const Vector3 over = point.cwiseMax(centre - reach).cwiseMin(centre + reach) - point;
  double least = over.norm();
  if (least < limit && program != nullptr)
    least = std::max(least, least_distance(*program, point, over, limit));
  if (least < limit) queue.push({least, cell, centre, half});
}

/// A distance within which a program's solid has no place in a cube, or `limit` or more. `over` leads to the
/// cube. A solid is at least as far from anywhere as its bound says. And the way to a place of it in the cube
/// turns by no acute angle at the foot on the endless beam of which the cube is a part: from there it is at
/// least as long as the bound. The beam runs along the axis on which the cube lies.
double PlainCells::least_distance(const Program& program, const Vector3& point, const Vector3& over,
                                  double limit) {
  if (asked_ != &program) {  // cubes side by side have the same, as a rule
    asked_ = &program;
    answer_ = bound(program, point);
  }
  Vector3 aside = over;
  Eigen::Index along = 0;
  over.cwiseAbs().maxCoeff(&along);
  aside[along] = 0.0;
  if (answer_ >= limit || aside.isZero(0.0)) return answer_;
  return std::max(answer_, std::hypot(aside.norm(), std::max(0.0, bound(program, point + aside))));
}

std::uint32_t PlainCells::root(const std::array<std::int64_t, 3>& place) {
  const auto [found, is_new] = roots_.try_emplace(place, static_cast<std::uint32_t>(cells_.size()));
  if (is_new) {
    const Vector3 centre(double(place[0]) + 0.5, double(place[1]) + 0.5, double(place[2]) + 0.5);
    cells_.push_back(made(whole(), size_ * centre, 0.5 * size_));
  }
  return found->second;
}

std::uint32_t PlainCells::eighths(const Waiting& of) {
  if (cells_[of.cell].eighths == 0) {
    const Program& around = *cells_[of.cell].program;
    cells_[of.cell].eighths = static_cast<std::uint32_t>(cells_.size());
    for (unsigned i = 0; i < 8; ++i)
      cells_.push_back(made(around, eighth_of_cube(of.centre, of.half, i), 0.5 * of.half));
  }
  return cells_[of.cell].eighths;
}

PlainCells::Cell PlainCells::made(const Program& around, const Vector3& centre, double half) {
  const double there = bound(around, centre), corner = corner_of_cube(half);
  return {there, std::abs(there) > corner ? nullptr : local(around, corner), 0};
}

/// The program without the steps whose values at a cube's centre, which were computed last, show that their
/// surfaces are farther away than its corners.
const PlainCells::Program* PlainCells::local(const Program& around, double corner) {
  Program program;
  std::vector<std::uint32_t> now(around.steps.size());
  const auto operand = [&](std::uint32_t step) { return step < kSolid ? now[step] : step; };
  for (std::size_t i = 0; i < around.steps.size(); ++i) {
    LocalStep step = around.steps[i];
    if (std::abs(values_[i]) > corner) {
      now[i] = values_[i] > 0.0 ? kFree : kSolid;
      continue;
    }
    if (step.leaf == kOperation) {
      step.left = operand(step.left);
      step.right = operand(step.right);
      if (const auto simple = simplified(step.op, step.left, step.right)) {
        now[i] = *simple;
        continue;
      }
    }
    now[i] = static_cast<std::uint32_t>(program.steps.size());
    program.steps.push_back(step);
  }
  program.root = operand(around.root);
  const auto [kept, is_new] = programs_.insert(std::move(program));
  if (is_new) kept_steps_ += kept->steps.size();
  return &*kept;
}

double PlainCells::bound(const Program& program, const Vector3& point) {
  values_.resize(std::max(values_.size(), program.steps.size()));
  const auto value = [&](std::uint32_t step) { return step < kSolid ? values_[step] : of_constant(step); };
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const LocalStep& step = program.steps[i];
    values_[i] = step.leaf != kOperation ? solid_[step.leaf].bound(point)
                                         : combined(step.op, value(step.left), value(step.right));
  }
  return value(program.root);
}

const PlainCells::Program& PlainCells::whole() {
  Program program;
  for (std::uint32_t i = 0; i < solid_.size(); ++i) {
    const PlainStep& step = solid_[i];
    program.steps.push_back({step.bound ? i : kOperation, step.op, step.operands[0], step.operands[1]});
  }
  program.root = static_cast<std::uint32_t>(solid_.size() - 1);
  return *programs_.insert(std::move(program)).first;
}

}  // namespace icome::haptics
