#include "geometry/loop/loop_patches.h"

#include <algorithm>
#include <cmath>

namespace icome::geometry {
namespace {

// s = scale u + s0 and so on of the three parts, for a ring of scale 1.
constexpr std::array<double, 3> kPartSign = {1.0, -1.0, 1.0};
constexpr std::array<std::array<double, 2>, 3> kPartStart = {{{-1.0, 0.0}, {1.0, 1.0}, {0.0, -1.0}}};

}  // namespace

void LoopPatches::load(std::uint32_t piece, BoxSplineControl& control, Vector3& origin) const {
  const std::uint32_t* stencil = stencil_.data() + pieces_[piece].first;
  origin = points_[stencil[0]];
  control[0].setZero();
  for (int i = 1; i < kBoxSplinePoints; ++i) control[i] = vector4(points_[stencil[i]] - origin);
}

void LoopPatches::load(std::uint32_t piece, LoopCell& cell) const {
  BoxSplineControl control;
  load(piece, control, cell.origin);
  cell.shape = box_spline_triangle(control);
  cell.scale = 1.0;
  cell.s0 = cell.t0 = 0.0;
}

namespace {

// Sum over the vertex and its spokes' ends; the vertex itself stands at 0.
Vector4 masked(const std::vector<double>& mask, const std::array<Vector4, LoopFanPoints::kMost>& points) {
  Vector4 sum = Vector4::Zero();
  for (std::size_t i = 1; i < mask.size(); ++i) sum += mask[i] * points[i];
  return sum;
}

}  // namespace

void LoopPatches::load(std::uint32_t piece, LoopFanPoints& fan) const {
  const Piece& what = pieces_[piece];
  const std::uint32_t* stencil = stencil_.data() + what.first;
  if (what.kind % 2 == 0) {
    const Rings& rings = rings_[what.kind / 2 - 1];
    fan.table = nullptr;
    fan.rings = &rings.rings;
    fan.face = stencil[3];
    fan.levels = rings.rings.levels;
    fan.apex = rings.apex;
    fan.normal = rings.normal;
    fan.far = fan.high = 1.0;
    return;
  }
  const FanTable& table = tables_[what.kind / 2];
  fan.table = &table;
  fan.rings = nullptr;
  fan.levels = table.levels;
  const Vector3& vertex = points_[stencil[0]];
  const std::uint32_t count = table.type.points();
  fan.points[0].setZero();
  for (std::uint32_t i = 1; i < count; ++i) fan.points[i] = vector4(points_[stencil[i]] - vertex);
  const Vector4 limit = masked(table.masks.limit, fan.points);
  fan.apex = vertex + vector3(limit);
  fan.normal = fan_normal(table.type, table.masks, {fan.points.data(), count});
  const Vector4 normal = vector4(fan.normal);
  double far = 0.0, high = std::abs(normal.dot(limit));
  for (std::uint32_t i = 1; i < count; ++i) {
    far = std::max(far, fan.points[i].squaredNorm());
    high = std::max(high, std::abs(normal.dot(fan.points[i] - limit)));
  }
  fan.far = std::sqrt(far);
  fan.high = fan.normal.isZero(0.0) ? fan.far : high;
}

namespace {

Vector4 fine_point(const LoopFanPoints& fan, int level, int which) {
  const auto weights = fan.table->row(level, which);
  Vector4 sum = Vector4::Zero();
  for (std::size_t j = 1; j < weights.size(); ++j) sum += weights[j] * fan.points[j];
  return sum;
}

}  // namespace

std::array<Vector4, kFinePoints> LoopPatches::fine_points(const LoopFanPoints& fan, int level) {
  if (fan.rings) return fan.rings->fine(level, fan.face);
  std::array<Vector4, kFinePoints> fine;
  for (int i = 0; i < kFinePoints; ++i) fine[i] = fine_point(fan, level, i);
  return fine;
}

void LoopPatches::place_part(int level, int part, LoopCell& cell) {
  cell.scale = std::ldexp(kPartSign[part], level + 1);
  cell.s0 = kPartStart[part][0];
  cell.t0 = kPartStart[part][1];
}

void LoopPatches::load(const LoopFanPoints& fan, int level, int part, LoopCell& cell) {
  BoxSplineControl control;
  if (fan.rings) {
    const auto fine = fan.rings->fine(level, fan.face);
    for (int i = 0; i < kBoxSplinePoints; ++i) control[i] = fine[kFanParts[part][i]];
  } else {
    for (int i = 0; i < kBoxSplinePoints; ++i) control[i] = fine_point(fan, level, kFanParts[part][i]);
  }
  cell.shape = box_spline_triangle(control);
  cell.origin = fan.apex;
  place_part(level, part, cell);
}

std::uint32_t LoopPatches::across(std::uint32_t piece, int edge) const {
  const std::uint32_t slot = piece / 4, part = piece % 4;
  if (part == 3) {  // the middle's edges are the others' edge 1
    constexpr std::array<std::uint32_t, 3> kBeyond = {2, 0, 1};
    return 4 * (4 * slot + kBeyond[edge]) + 1;
  }
  if (edge == 1) {
    constexpr std::array<std::uint32_t, 3> kEdge = {1, 2, 0};
    return 4 * (4 * slot + 3) + kEdge[part];
  }
  // Sides run the other way in the neighbour: the half at their start is the half at its end.
  const std::uint32_t side = edge == 0 ? part : (part + 2) % 3;
  const std::uint32_t other = sides_[slot][side];
  if (other == kNone) return kNone;
  const std::uint32_t other_slot = other / 3, other_side = other % 3;
  return edge == 0 ? 4 * (4 * other_slot + (other_side + 1) % 3) + 2 : 4 * (4 * other_slot + other_side);
}

bool LoopPatches::adjoin(std::uint32_t one, std::uint32_t other) const {
  if (one / 4 == other / 4) return true;
  const auto fans = [this](std::uint32_t piece) -> std::array<std::uint32_t, 3> {
    const auto& of_slot = fans_[piece / 4];
    const std::uint32_t part = piece % 4;
    if (part == 3) return {of_slot[3], of_slot[4], of_slot[5]};
    return {of_slot[part], of_slot[3 + part], of_slot[3 + (part + 2) % 3]};
  };
  for (const std::uint32_t a : fans(one)) {
    for (const std::uint32_t b : fans(other)) {
      if (a == b) return true;
    }
  }
  return false;
}

std::array<std::uint32_t, 3> LoopPatches::corner_ids(std::uint32_t piece) const {
  const std::uint32_t* middle = stencil_.data() + pieces_[piece | 3].first;
  const std::uint32_t part = piece % 4;
  if (part == 3) return {middle[0], middle[1], middle[2]};
  const std::uint32_t* own = stencil_.data() + pieces_[piece].first;
  constexpr std::array<std::uint32_t, 3> kMiddleOfSide = {2, 0, 1};
  return {own[0], middle[kMiddleOfSide[part]], middle[kMiddleOfSide[(part + 2) % 3]]};
}

std::size_t LoopPatches::bytes() const {
  std::size_t sum = sizeof(LoopPatches) + tree_.bytes() + points_.capacity() * sizeof(Vector3) +
                    stencil_.capacity() * sizeof(std::uint32_t) + pieces_.capacity() * sizeof(Piece) +
                    sides_.capacity() * sizeof(sides_[0]) + fans_.capacity() * sizeof(fans_[0]) +
                    slot_of_triangle_.capacity() * sizeof(std::uint32_t) + slabs_.capacity() * sizeof(Slab);
  for (const FanTable& table : tables_) sum += table.bytes();
  for (const Rings& rings : rings_) sum += rings.rings.bytes() + sizeof(Rings) - sizeof(FanRings);
  return sum;
}

bool LoopCursor::go(std::uint32_t piece, double u, double v) {
  if (patches_.regular(piece)) {
    if (piece != piece_) patches_.load(piece, cell_);
    piece_ = piece;
    s_ = u;
    t_ = v;
    return true;
  }
  if (piece != piece_) {
    patches_.load(piece, fan_);
    piece_ = piece;
    level_ = -1;
  }
  int exponent = 0;
  std::frexp(u + v, &exponent);  // u + v in [1/2, 1) * 2^exponent
  const int level = std::max(0, -exponent);
  if (!(u + v > 0.0) || level >= fan_.levels) return false;
  const double scale = std::ldexp(1.0, level + 1);
  const int part = scale * u >= 1.0 ? 0 : scale * v >= 1.0 ? 2 : 1;
  if (level != level_ || part != part_) {
    LoopPatches::load(fan_, level, part, cell_);
    level_ = level;
    part_ = part;
  }
  s_ = cell_.scale * u + cell_.s0;
  t_ = cell_.scale * v + cell_.t0;
  return true;
}

}  // namespace icome::geometry
