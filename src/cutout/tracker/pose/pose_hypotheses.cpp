#include "cutout/tracker/pose/pose_hypotheses.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace icome::cutout {
namespace {

constexpr double kAngleTolerance = 0.02;     // rad, of two long pieces
constexpr double kPixelTolerance = 0.7;      // pixels across a piece's length, which turn it
constexpr double kMostAngleTolerance = 0.1;  // rad
constexpr double kExtentTolerance = 5;       // pixels that a piece may reach beyond its edge

}  // namespace

PoseHypotheses::PoseHypotheses(std::span<const TriangleShape> shapes)
    : shapes_(shapes.begin(), shapes.end()) {
  for (const TriangleShape& shape : shapes_) largest_reach_ = std::max(largest_reach_, shape.reach);
  for (std::uint32_t triangle = 0; triangle < shapes_.size(); ++triangle)
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      corners_.push_back({shapes_[triangle].corner_angles[corner], triangle, corner});
  std::sort(corners_.begin(), corners_.end(),
            [](const Corner& a, const Corner& b) { return a.angle < b.angle; });
}

bool PoseHypotheses::place(const Corner& corner, const EdgeSegment& before, const EdgeSegment& after,
                           double pixel, PoseHypothesis& found) const {
  const TriangleShape& shape = shapes_[corner.triangle];
  const std::size_t second = corner.corner, first = (second + 2) % 3;
  const double beyond = kExtentTolerance * pixel;
  if (before.length() > shape.lengths[first] + 2 * beyond ||
      after.length() > shape.lengths[second] + 2 * beyond)
    return false;
  // The turn by both pieces, the longer one counting more.
  const double turn_first = before.angle - shape.normal_angles[first];
  const double turn_second = after.angle - shape.normal_angles[second];
  const double weight_first = before.points * before.length() * before.length();
  const double weight_second = after.points * after.length() * after.length();
  const double apart = within_half_turn(turn_second - turn_first);
  found.placed.turn = turn_first + apart * weight_second / (weight_first + weight_second);
  const double cosine = std::cos(found.placed.turn), sine = std::sin(found.placed.turn);
  // Both edges go through the middles of their pieces.
  const Vector2 normal_first = turned(shape.normals[first], cosine, sine);
  const Vector2 normal_second = turned(shape.normals[second], cosine, sine);
  const double right_first = normal_first.dot(before.middle()) - shape.offsets[first];
  const double right_second = normal_second.dot(after.middle()) - shape.offsets[second];
  const double determinant = normal_first.x() * normal_second.y() - normal_first.y() * normal_second.x();
  if (!(std::abs(determinant) > 0.02)) return false;
  found.placed.centroid = {(right_first * normal_second.y() - right_second * normal_first.y()) / determinant,
                           (normal_first.x() * right_second - normal_second.x() * right_first) / determinant};
  const auto lies_on = [&](const EdgeSegment& segment, std::size_t edge) {
    const Vector2 along = turned(shape.along[edge], cosine, sine);
    const Vector2 start = found.placed.centroid + turned(shape.corners[edge], cosine, sine);
    const double middle = along.dot(segment.middle() - start), half = segment.length() / 2;
    return middle - half > -beyond && middle + half < shape.lengths[edge] + beyond;
  };
  if (!lies_on(before, first) || !lies_on(after, second)) return false;
  found.triangle = corner.triangle;
  found.length = before.length() + after.length();
  return true;
}

void PoseHypotheses::find(std::span<const EdgeSegment> segments, double pixel,
                          const std::vector<bool>& wanted, std::vector<PoseHypothesis>& found) const {
  found.clear();
  PoseHypothesis hypothesis;
  std::size_t tries = 0;
  const double farthest = 2 * largest_reach_ + kExtentTolerance * pixel;  // between middles of two edges
  for (std::size_t second = 1; second < segments.size(); ++second)
    for (std::size_t first = 0; first < second; ++first) {
      const EdgeSegment *before = &segments[first], *after = &segments[second];
      if ((before->middle() - after->middle()).squaredNorm() > farthest * farthest) continue;
      double turn = within_half_turn(after->angle - before->angle);
      if (turn < 0) {
        std::swap(before, after);
        turn = -turn;
      }
      const double angle = std::numbers::pi - turn;
      const double tolerance =
          std::min(kMostAngleTolerance, kAngleTolerance + kPixelTolerance * pixel / before->length() +
                                            kPixelTolerance * pixel / after->length());
      auto corner = std::lower_bound(corners_.begin(), corners_.end(), angle - tolerance,
                                     [](const Corner& c, double least) { return c.angle < least; });
      for (; corner != corners_.end() && corner->angle <= angle + tolerance; ++corner) {
        if (!wanted[corner->triangle]) continue;
        if (++tries > kMostTries) return;
        if (!place(*corner, *before, *after, pixel, hypothesis)) continue;
        found.push_back(hypothesis);
        if (found.size() >= kMost) return;
      }
    }
}

}  // namespace icome::cutout
