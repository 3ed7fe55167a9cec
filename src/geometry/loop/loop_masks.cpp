// The limit masks of Loop's scheme: left eigenvectors of the local subdivision matrix.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "geometry/loop/loop_fan.h"
#include "geometry/loop/loop_rules.h"

namespace icome::geometry {
namespace {

// Loop 1987 and Hoppe et al. 1994: the vertex and its neighbours keep this sum from step to step.
std::vector<double> smooth_limit(std::uint32_t spokes) {
  const double share = 1.0 / (spokes + 3.0 / (8.0 * loop_rules::beta(spokes)));
  std::vector<double> weights(spokes + 1, share);
  weights[0] = 1.0 - spokes * share;
  return weights;
}

void set_smooth_tangents(std::uint32_t spokes, FanMasks& masks) {
  for (auto& tangent : masks.tangents) tangent.assign(spokes + 1, 0.0);
  for (std::uint32_t i = 0; i < spokes; ++i) {
    masks.tangents[0][1 + i] = std::cos(2.0 * std::numbers::pi * i / spokes);
    masks.tangents[1][1 + i] = std::sin(2.0 * std::numbers::pi * i / spokes);
  }
}

// Along the crease half the distance of its two ends shrinks by 1/2 at each step. Across it the ring's
// slowest wave does, sin(pi i / faces) with weights on the crease that make it an eigenvector: by 3/8 + cos
// / 4. A single face has no inner spoke; there the crease's own bend, by 1/4, says where inside is.
void set_crease_tangents(std::uint32_t faces, FanMasks& masks) {
  for (auto& tangent : masks.tangents) tangent.assign(faces + 2, 0.0);
  masks.tangents[0][1] = 0.5;
  masks.tangents[0][1 + faces] = -0.5;
  auto& across = masks.tangents[1];
  if (faces == 1) {
    across = {-2.0, 1.0, 1.0};
    return;
  }
  const double angle = std::numbers::pi / faces;
  const double value = 0.375 + 0.25 * std::cos(angle);
  for (std::uint32_t i = 1; i < faces; ++i) across[1 + i] = std::sin(i * angle);
  // Columns of the ends and of the vertex: (1/2 - value) e + v / 8 = -sin / 8 and
  // e + (3/4 - value) v = -3/8 cot(angle / 2).
  const double a = 0.5 - value, b = 0.125, c = 1.0, d = 0.75 - value;
  const double right_1 = -std::sin(angle) / 8.0, right_2 = -0.375 / std::tan(0.5 * angle);
  const double det = a * d - b * c;
  across[1] = across[1 + faces] = (right_1 * d - b * right_2) / det;
  across[0] = (a * right_2 - c * right_1) / det;
}

/// The local subdivision matrix of a dart on vectors that are even about its crease: the vertex, the crease's
/// end, then pairs of spokes.
Eigen::MatrixXd even_dart_matrix(const FanType& type) {
  const std::uint32_t spokes = type.spokes();
  const std::uint32_t count = 2 + spokes / 2;
  Eigen::MatrixXd matrix(count, count);
  for (std::uint32_t column = 0; column < count; ++column) {
    std::vector<double> ring(spokes + 1, 0.0);
    if (column == 0) {
      ring[0] = 1.0;
    } else {
      ring[1 + (type.crease + column - 1) % spokes] = 1.0;
      ring[1 + (type.crease + spokes - (column - 1)) % spokes] = 1.0;
    }
    loop_rules::refine_ring(type, ring);
    matrix(0, column) = ring[0];
    for (std::uint32_t i = 1; i < count; ++i) matrix(i, column) = ring[1 + (type.crease + i - 1) % spokes];
  }
  return matrix;
}

std::vector<double> spread_even(const FanType& type, const Eigen::VectorXd& weights) {
  const std::uint32_t spokes = type.spokes();
  std::vector<double> result(spokes + 1, 0.0);
  result[0] = weights[0];
  for (Eigen::Index i = 1; i < weights.size(); ++i) {
    const auto step = std::uint32_t(i - 1);
    result[1 + (type.crease + step) % spokes] += 0.5 * weights[i];
    result[1 + (type.crease + spokes - step) % spokes] += 0.5 * weights[i];
  }
  return result;
}

// On vectors that are odd about the crease the scheme does not see it; on even ones there is no closed form.
void set_dart_masks(const FanType& type, FanMasks& masks) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(even_dart_matrix(type).transpose());
  const Eigen::VectorXd values = solver.eigenvalues().real();
  Eigen::Index first = 0;
  for (Eigen::Index i = 1; i < values.size(); ++i) first = values[i] > values[first] ? i : first;
  Eigen::Index second = first == 0 ? 1 : 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (i != first && values[i] > values[second]) second = i;
  }
  const Eigen::VectorXd limit = solver.eigenvectors().col(first).real();
  masks.limit = spread_even(type, limit / limit.sum());
  const Eigen::VectorXd even = solver.eigenvectors().col(second).real();
  masks.tangents[0] = spread_even(type, even[1] < 0.0 ? -even : even);
  const std::uint32_t spokes = type.spokes();
  masks.tangents[1].assign(spokes + 1, 0.0);
  for (std::uint32_t i = 0; i < spokes; ++i) {
    masks.tangents[1][1 + (type.crease + i) % spokes] = std::sin(2.0 * std::numbers::pi * i / spokes);
  }
}

}  // namespace

FanMasks fan_masks(const FanType& type) {
  FanMasks masks;
  masks.limit.assign(type.spokes() + 1, 0.0);
  switch (type.rule) {
    case FanRule::Smooth:
      masks.limit = smooth_limit(type.spokes());
      set_smooth_tangents(type.spokes(), masks);
      break;
    case FanRule::Dart:
      set_dart_masks(type, masks);
      break;
    case FanRule::Crease:
      masks.limit[0] = 2.0 / 3.0;
      masks.limit[1] = masks.limit[1 + type.faces] = 1.0 / 6.0;
      set_crease_tangents(type.faces, masks);
      break;
    case FanRule::Corner:
      // The sharp edges' directions. With more than two faces the inner spokes' differ in general: the
      // scheme has no tangent plane there.
      masks.limit[0] = 1.0;
      for (auto& tangent : masks.tangents) {
        tangent.assign(type.spokes() + 1, 0.0);
        tangent[0] = -1.0;
      }
      masks.tangents[0][1] = 1.0;
      masks.tangents[1][1 + type.faces] = 1.0;
      break;
    case FanRule::Spike:
      masks.limit[0] = 1.0;
      break;
  }
  return masks;
}

Vector3 fan_normal(const FanType& type, const FanMasks& masks, std::span<const Vector4> ring) {
  Vector3 flat = Vector3::Zero();  // of the control triangles
  for (std::uint32_t i = 0; i < type.faces; ++i) {
    flat += ring[1 + i].head<3>().cross(ring[1 + (i + 1) % type.spokes()].head<3>());
  }
  Vector3 normal = Vector3::Zero();
  if (!masks.tangents[0].empty()) {
    std::array<Vector3, 2> tangents = {Vector3::Zero(), Vector3::Zero()};
    for (int k = 0; k < 2; ++k) {
      for (std::size_t i = 1; i < masks.tangents[k].size(); ++i) {
        tangents[k] += masks.tangents[k][i] * ring[i].head<3>();
      }
    }
    normal = tangents[0].cross(tangents[1]);
    if (normal.norm() < 1e-12 * tangents[0].norm() * tangents[1].norm()) normal.setZero();
    // The sharp edges of three faces or more may include more than pi.
    if (type.rule == FanRule::Corner && type.faces > 2 && normal.dot(flat) < 0.0) normal = -normal;
  }
  if (normal.isZero(0.0)) normal = flat;
  const double length = normal.norm();
  return length > 0.0 ? Vector3(normal / length) : Vector3::Zero();
}

}  // namespace icome::geometry
