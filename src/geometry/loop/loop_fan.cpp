#include "geometry/loop/loop_fan.h"

#include <algorithm>
#include <cmath>

#include "geometry/loop/loop_rules.h"

namespace icome::geometry {
namespace {

// The slowest shrinking of the scheme is 5/8 a level: 80 levels reach the last bit of a double.
constexpr int kMaxLevels = 80;
constexpr double kNegligible = 1e-17;

using Row = Eigen::RowVectorXd;

/// The control points of one face as rows of weights, in the order of FanType::points().
struct FaceRows {
  std::vector<Row> ring;
  std::vector<Row> outer;  // lattice 3, 4, 5 and the unmirrored ones of 7 and 9
};

std::array<Row, kCoarsePoints> coarse_lattice(const FanType& type, const FaceRows& rows) {
  std::array<Row, kCoarsePoints> lattice;
  loop_rules::lattice_from_ring(type, rows.ring, lattice);
  for (int i = 0; i < 3; ++i) lattice[3 + i] = rows.outer[i];
  std::size_t next = 3;
  if (!type.sharp_first()) lattice[7] = rows.outer[next++];
  if (!type.sharp_last()) lattice[9] = rows.outer[next++];
  loop_rules::mirror_outer(type, lattice);
  return lattice;
}

/// One subdivision; returns the fine lattice.
std::array<Row, kFinePoints> subdivide(const FanType& type, FaceRows& rows) {
  const auto coarse = coarse_lattice(type, rows);
  loop_rules::refine_ring(type, rows.ring);
  std::array<Row, kFinePoints> fine;
  loop_rules::lattice_from_ring(type, rows.ring, fine);
  loop_rules::refine_lattice(coarse, fine);
  loop_rules::mirror_outer(type, fine);
  for (int i = 0; i < 3; ++i) rows.outer[i] = fine[3 + i];
  std::size_t next = 3;
  if (!type.sharp_first()) rows.outer[next++] = fine[7];
  if (!type.sharp_last()) rows.outer[next++] = fine[9];
  return fine;
}

/// Subtracts the vertex's place on the limit from all rows: on every level, as rounding brings it back.
void take_limit(const FanMasks& masks, FaceRows& rows) {
  Row limit = masks.limit[0] * rows.ring[0];
  for (std::size_t i = 1; i < rows.ring.size(); ++i) limit += masks.limit[i] * rows.ring[i];
  for (Row& row : rows.ring) row -= limit;
  for (Row& row : rows.outer) row -= limit;
}

/// An orthonormal basis of the span of the tangent masks and the limit mask, by Gram and Schmidt, twice,
/// since rounding leaves something of the subtracted parts.
std::vector<Row> constraint_basis(const FanMasks& masks, Eigen::Index width) {
  std::vector<const std::vector<double>*> used = {&masks.limit};
  for (const auto& tangent : masks.tangents) {
    if (!tangent.empty()) used.push_back(&tangent);
  }
  std::vector<Row> basis;
  for (const std::vector<double>* mask : used) {
    Row row = Row::Zero(width);
    std::copy(mask->begin(), mask->end(), row.begin());
    const double length = row.norm();
    for (int pass = 0; pass < 2; ++pass) {
      for (const Row& unit : basis) row -= row.dot(unit) * unit;
    }
    constexpr double kDependent = 1e-12;
    if (row.norm() > kDependent * length) basis.push_back(row.normalized());
  }
  return basis;
}

/// The row less its components along the constraints: a height over the tangent plane vanishes under these.
Row without_constraints(Row row, std::span<const Row> constraints) {
  for (const Row& unit : constraints) row -= row.dot(unit) * unit;
  return row;
}

double largest_row_sum(const FaceRows& rows, std::span<const Row> constraints) {
  double largest = 0.0;
  for (const auto* group : {&rows.ring, &rows.outer}) {
    for (const Row& row : *group) {
      largest = std::max(largest, without_constraints(row, constraints).cwiseAbs().sum());
    }
  }
  return largest;
}

}  // namespace

const std::array<std::array<std::uint8_t, kBoxSplinePoints>, 3> kFanParts = {{
    {1, 4, 3, 2, 0, 6, 7, 12, 10, 11, 13, 5},
    {3, 2, 1, 4, 11, 13, 5, 9, 8, 0, 6, 7},
    {2, 3, 5, 9, 8, 0, 1, 4, 11, 13, 14, 15},
}};

FanTable fan_table(const FanType& type) {
  FanTable table;
  table.type = type;
  table.masks = fan_masks(type);
  const auto width = Eigen::Index(type.points());
  FaceRows rows;
  for (Eigen::Index i = 0; i < width; ++i) {
    (i <= type.spokes() ? rows.ring : rows.outer).emplace_back(Row::Unit(width, i));
  }
  take_limit(table.masks, rows);
  const std::vector<Row> constraints = constraint_basis(table.masks, width);
  for (;; ++table.levels) {
    table.reach.push_back(largest_row_sum(rows, {}));
    table.lift.push_back(largest_row_sum(rows, constraints));
    if (table.levels == kMaxLevels || table.reach.back() < kNegligible) break;
    const auto fine = subdivide(type, rows);
    for (const Row& row : fine) table.rows.insert(table.rows.end(), row.begin(), row.end());
    take_limit(table.masks, rows);
  }
  return table;
}

std::size_t FanTable::bytes() const {
  std::size_t numbers = rows.capacity() + reach.capacity() + lift.capacity() + masks.limit.capacity();
  for (const auto& tangent : masks.tangents) numbers += tangent.capacity();
  return sizeof(FanTable) + numbers * sizeof(double);
}

namespace {

/// The index of one of a face's three outer points in one level of FanRings.
std::size_t outer_index(const FanType& type, std::uint32_t face, int which) {
  return 1 + type.spokes() + 3 * std::size_t(face) + std::size_t(which);
}

FanType with_face(FanType type, std::uint32_t face) {
  type.face = face;
  return type;
}

/// The lattice around one face without its third ring. `Face` counts from spoke 0 also all round.
template <std::size_t kCount>
void lattice_of_face(const FanType& type, const Vector3* level, std::array<Vector3, kCount>& lattice) {
  const auto outer = [&](std::int64_t face, int which) {
    const std::int64_t count = type.faces;
    return level[outer_index(type, std::uint32_t((face + count) % count), which)];
  };
  const auto end = [&](std::int64_t offset) { return level[1 + type.spoke(offset)]; };
  lattice[0] = level[0];
  lattice[1] = end(0);
  lattice[2] = end(1);
  for (int i = 0; i < 3; ++i) lattice[3 + i] = outer(type.face, i);
  if (type.sharp_first()) {
    lattice[6] = lattice[0] + lattice[1] - lattice[2];
  } else {
    lattice[6] = end(-1);
    lattice[7] = outer(std::int64_t(type.face) - 1, 0);
  }
  if (type.sharp_last()) {
    lattice[8] = lattice[0] + lattice[2] - lattice[1];
  } else {
    lattice[8] = end(2);
    lattice[9] = outer(std::int64_t(type.face) + 1, 0);
  }
  loop_rules::mirror_outer(type, lattice);
}

void measure(FanRings& rings, const Vector3& normal) {
  const Vector3* level = rings.points.data() + std::size_t(rings.levels) * rings.stride;
  double reach = 0.0, lift = 0.0;
  for (std::uint32_t i = 0; i < rings.stride; ++i) {
    reach = std::max(reach, level[i].norm());
    lift = std::max(lift, std::abs(level[i].dot(normal)));
  }
  rings.reach.push_back(reach);
  rings.lift.push_back(normal.isZero() ? reach : lift);
}

void subdivide_rings(FanRings& rings, const FanMasks& masks) {
  const FanType& type = rings.type;
  const std::size_t first = rings.points.size();
  rings.points.resize(first + rings.stride);
  const Vector3* coarse = rings.points.data() + first - rings.stride;
  Vector3* fine = rings.points.data() + first;
  std::vector<Vector3> ring(coarse, coarse + 1 + type.spokes());
  loop_rules::refine_ring(type, ring);
  std::copy(ring.begin(), ring.end(), fine);
  for (std::uint32_t face = 0; face < type.faces; ++face) {
    std::array<Vector3, kCoarsePoints> lattice;
    std::array<Vector3, kFinePoints> refined;
    lattice_of_face(with_face(type, face), coarse, lattice);
    loop_rules::refine_lattice(lattice, refined);
    for (int i = 0; i < 3; ++i) fine[outer_index(type, face, i)] = refined[3 + i];
  }
  Vector3 limit = Vector3::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i) limit += masks.limit[i] * ring[i];
  for (std::uint32_t i = 0; i < rings.stride; ++i) fine[i] -= limit;
}

}  // namespace

std::array<Vector4, kFinePoints> FanRings::fine(int level, std::uint32_t face) const {
  const FanType of_face = with_face(type, face);
  const Vector3* coarse = points.data() + std::size_t(level) * stride;
  std::array<Vector3, kCoarsePoints> lattice;
  std::array<Vector3, kFinePoints> refined;
  lattice_of_face(of_face, coarse, lattice);
  loop_rules::refine_lattice(lattice, refined);
  lattice_of_face(of_face, coarse + stride, refined);
  std::array<Vector4, kFinePoints> result;
  for (int i = 0; i < kFinePoints; ++i) result[i] << refined[i], 0.0;
  return result;
}

std::size_t FanRings::bytes() const {
  return sizeof(FanRings) + points.capacity() * sizeof(Vector3) +
         (reach.capacity() + lift.capacity()) * sizeof(double);
}

FanRings fan_rings(const FanType& type, std::span<const Vector3> ring, std::span<const Vector3> outer,
                   const FanMasks& masks, const Vector3& normal) {
  FanRings rings;
  rings.type = type;
  rings.stride = std::uint32_t(ring.size() + outer.size());
  Vector3 limit = Vector3::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i) limit += masks.limit[i] * (ring[i] - ring[0]);
  for (const auto& points : {ring, outer}) {
    for (const Vector3& point : points) rings.points.emplace_back(point - ring[0] - limit);
  }
  for (measure(rings, normal); rings.levels < kMaxLevels; measure(rings, normal)) {
    if (rings.reach.back() < kNegligible * rings.reach.front()) break;
    subdivide_rings(rings, masks);
    ++rings.levels;
  }
  return rings;
}

}  // namespace icome::geometry
