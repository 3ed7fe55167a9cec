#include "geometry/deform/free_form_deformation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace icome::geometry {
namespace {

constexpr std::size_t kGrain = 4096;  // vertices a thread is worth starting for
// As a part of the box's side: points meant to lie in a face may lie beside it by rounding.
constexpr double kBesideFace = 1e-9;

/// All Bernstein polynomials of a degree at a place in [0, 1]: from those of the degree below, which adds up
/// to 1 and loses no digits.
void bernstein(int degree, double place, double* values) {
  values[0] = 1.0;
  for (int d = 1; d <= degree; ++d) {
    double carried = 0.0;
    for (int i = 0; i < d; ++i) {
      const double value = values[i];
      values[i] = carried + (1.0 - place) * value;
      carried = place * value;
    }
    values[d] = carried;
  }
}

double bernstein(int degree, int which, double place, std::vector<double>& room) {
  room.resize(std::size_t(degree) + 1);
  bernstein(degree, place, room.data());
  return room[std::size_t(which)];
}

}  // namespace

Vector3 FfdLattice::rest(const std::array<int, 3>& place) const {
  return space_from_box *
         Vector3(double(place[0]) / cells[0], double(place[1]) / cells[1], double(place[2]) / cells[2]);
}

std::optional<base::Bounds> ffd_box(base::Bounds around) {
  constexpr double kFlat = 1e-5, kThick = 0.1;  // of the longest side
  const double longest = around.isEmpty() ? 0.0 : around.sizes().maxCoeff();
  if (!(longest > 0.0) || !std::isfinite(longest)) return std::nullopt;
  for (int axis = 0; axis < 3; ++axis) {
    if (around.sizes()[axis] >= kFlat * longest) continue;
    const double middle = around.center()[axis];
    around.min()[axis] = middle - 0.5 * kThick * longest;
    around.max()[axis] = middle + 0.5 * kThick * longest;
  }
  return around;
}

base::Result<FfdLattice> make_ffd_lattice(const base::Affine3& space_from_box,
                                          const std::array<int, 3>& cells) {
  FfdLattice lattice{space_from_box, cells, {}};
  std::size_t count = 1;
  for (const int along : cells) {
    if (along < 1) return base::fail("A lattice needs at least one cell along each side of its box.");
    if (std::size_t(along) >= kMostFfdPoints || (count *= std::size_t(along) + 1) > kMostFfdPoints) {
      return base::fail(
          fmt::format("A lattice can have {} control points at most: ask for fewer cells.", kMostFfdPoints));
    }
  }
  lattice.points.resize(count);
  const auto counts = lattice.counts();
  for (int i = 0; i < counts[0]; ++i) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int k = 0; k < counts[2]; ++k) lattice.points[lattice.index({i, j, k})] = lattice.rest({i, j, k});
    }
  }
  if (const auto good = check(lattice); !good) return tl::unexpected(good.error());
  return lattice;
}

base::Result<void> check(const FfdLattice& lattice) {
  std::size_t count = 1;
  for (const int along : lattice.cells) {
    if (along < 1) return base::fail("A lattice needs at least one cell along each side of its box.");
    if (std::size_t(along) >= kMostFfdPoints || (count *= std::size_t(along) + 1) > kMostFfdPoints) break;
  }
  if (count != lattice.points.size()) {
    return base::fail(fmt::format("A lattice of {} x {} x {} cells does not have {} control points.",
                                  lattice.cells[0], lattice.cells[1], lattice.cells[2],
                                  lattice.points.size()));
  }
  const Matrix3 axes = lattice.space_from_box.linear();
  const double size = axes.colwise().norm().maxCoeff();
  const bool has_volume = std::abs((axes / size).determinant()) > 1e-12;
  if (!lattice.space_from_box.matrix().allFinite() || !(size > 0.0) || !has_volume) {
    return base::fail(
        "The lattice's box must be finite and have a volume: make it thicker where what it holds is flat.");
  }
  const auto finite = [](const Vector3& point) { return point.allFinite(); };
  if (!std::all_of(lattice.points.begin(), lattice.points.end(), finite))
    return base::fail("A control point of the lattice is not at a finite place.");
  return {};
}

FfdBinding::FfdBinding(std::span<const Vector3> positions, const FfdLattice& lattice)
    : cells_(lattice.cells) {
  const base::Affine3 box_from_space = lattice.space_from_box.inverse();
  for (std::size_t i = 0; i < positions.size(); ++i) bind(positions, std::uint32_t(i), box_from_space);
}

FfdBinding::FfdBinding(std::span<const Vector3> positions, std::span<const std::uint32_t> vertices,
                       const FfdLattice& lattice)
    : cells_(lattice.cells) {
  const base::Affine3 box_from_space = lattice.space_from_box.inverse();
  for (const std::uint32_t vertex : vertices) {
    if (vertex < positions.size()) bind(positions, vertex, box_from_space);
  }
}

void FfdBinding::bind(std::span<const Vector3> positions, std::uint32_t vertex,
                      const base::Affine3& box_from_space) {
  const Vector3 there = box_from_space * positions[vertex];
  const bool inside = (there.array() >= -kBesideFace).all() && (there.array() <= 1.0 + kBesideFace).all();
  if (!inside) return;
  vertices_.push_back(vertex);
  rest_.push_back(positions[vertex]);
  in_box_.emplace_back(there.cwiseMax(0.0).cwiseMin(1.0));
}

std::vector<Vector3> FfdBinding::deformed(const FfdLattice& lattice) const {
  // Moves are added up and not places: where no point has moved, nothing is rounded.
  const auto counts = lattice.counts();
  std::vector<Vector3> moves(lattice.points.size());
  for (int i = 0; i < counts[0]; ++i) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int k = 0; k < counts[2]; ++k) {
        const std::size_t at = lattice.index({i, j, k});
        moves[at] = lattice.points[at] - lattice.rest({i, j, k});
      }
    }
  }
  std::vector<Vector3> result(rest_.size());
  base::parallel_for(rest_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::array<std::vector<double>, 3> along;
    for (int axis = 0; axis < 3; ++axis) along[axis].resize(std::size_t(counts[axis]));
    for (std::size_t v = begin; v < end; ++v) {
      for (int axis = 0; axis < 3; ++axis) bernstein(cells_[axis], in_box_[v][axis], along[axis].data());
      Vector3 move = Vector3::Zero();
      const Vector3* next = moves.data();
      for (const double s : along[0]) {
        Vector3 plane = Vector3::Zero();
        for (const double t : along[1]) {
          Vector3 row = Vector3::Zero();
          for (const double u : along[2]) row += u * *next++;
          plane += t * row;
        }
        move += s * plane;
      }
      result[v] = rest_[v] + move;
    }
  });
  return result;
}

std::vector<double> FfdBinding::shares(const std::array<int, 3>& point) const {
  std::vector<double> result(rest_.size());
  base::parallel_for(rest_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<double> room;
    for (std::size_t v = begin; v < end; ++v) {
      double share = 1.0;
      for (int axis = 0; axis < 3; ++axis)
        share *= bernstein(cells_[axis], point[axis], in_box_[v][axis], room);
      result[v] = share;
    }
  });
  return result;
}

}  // namespace icome::geometry
