#include "cutout/calibration/learning.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cutout/calibration/table_corners.h"

namespace icome::cutout {
namespace {

using base::Vector2;

constexpr double kMostUneven = 4.0 * std::numbers::pi / 180.0;

/// The upper face's corners from those of the outline, whose sides towards the camera are those of walls'
/// feet.
std::array<Vector2, 3> face_of(const std::array<Vector2, 3>& outline, const TableView& view) {
  std::array<Vector2, 3> normals;
  std::array<double, 3> offsets;
  const Vector2 middle = (outline[0] + outline[1] + outline[2]) / 3.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2 along = (outline[(i + 1) % 3] - outline[i]).normalized();
    Vector2 outwards(along.y(), -along.x());
    if (outwards.dot(middle - outline[i]) > 0) outwards = -outwards;
    const Vector2 centre = 0.5 * (outline[i] + outline[(i + 1) % 3]);
    normals[i] = outwards;
    offsets[i] = outwards.dot(outline[i]) - std::max(0.0, outwards.dot(view.wall_at(centre)));
  }
  std::array<Vector2, 3> face;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 2) % 3;
    const double determinant = normals[i].x() * normals[k].y() - normals[i].y() * normals[k].x();
    face[i] = {(offsets[i] * normals[k].y() - normals[i].y() * offsets[k]) / determinant,
               (normals[i].x() * offsets[k] - offsets[i] * normals[k].x()) / determinant};
  }
  return face;
}

}  // namespace

base::Result<LearntTriangle> learn_triangle(const FrameView& frame, const TableView& view) {
  if (frame.width != view.frame_width() || frame.height != view.frame_height())
    return base::fail(fmt::format("the frame is {} x {} pixels large, and the view was made for {} x {}",
                                  frame.width, frame.height, view.frame_width(), view.frame_height()));
  const auto seen = find_triangle_corners(frame);
  if (!seen) return tl::unexpected(seen.error());
  std::array<Vector2, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = view.to_table((*seen)[i]);
  corners = face_of(corners, view);
  std::array<double, 3> angles;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2 one = (corners[(i + 1) % 3] - corners[i]).normalized();
    const Vector2 other = (corners[(i + 2) % 3] - corners[i]).normalized();
    angles[i] = std::acos(std::clamp(one.dot(other), -1.0, 1.0));
  }
  std::size_t apex = 0;
  const auto unevenness = [&](std::size_t i) { return std::abs(angles[(i + 1) % 3] - angles[(i + 2) % 3]); };
  for (std::size_t i = 1; i < 3; ++i)
    if (unevenness(i) < unevenness(apex)) apex = i;
  if (unevenness(apex) > kMostUneven)
    return base::fail(
        fmt::format("the triangle is not isosceles: its angles are {:.1f}, {:.1f} and {:.1f} degrees",
                    angles[0] * 180 / std::numbers::pi, angles[1] * 180 / std::numbers::pi,
                    angles[2] * 180 / std::numbers::pi));
  const Vector2 foot = 0.5 * (corners[(apex + 1) % 3] + corners[(apex + 2) % 3]);
  return LearntTriangle{0.5 * (angles[(apex + 1) % 3] + angles[(apex + 2) % 3]),
                        (corners[apex] - foot).norm(), unevenness(apex)};
}

LearntTriangle middle_of(std::vector<LearntTriangle> measured) {
  const auto middle = measured.begin() + std::ptrdiff_t(measured.size() / 2);
  LearntTriangle learnt;
  std::ranges::nth_element(measured, middle, {}, &LearntTriangle::base_angle);
  learnt.base_angle = middle->base_angle;
  std::ranges::nth_element(measured, middle, {}, &LearntTriangle::height);
  learnt.height = middle->height;
  for (const LearntTriangle& one : measured) learnt.uneven = std::max(learnt.uneven, one.uneven);
  return learnt;
}

}  // namespace icome::cutout
