#include "haptics/effects/haptic_texture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/random.h"

namespace icome::haptics {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Perlin's quintic fade: 0 to 1 with first and second derivative 0 at both ends.
double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }
double fade_slope(double t) { return 30.0 * t * t * (t - 1.0) * (t - 1.0); }

// A number in [0, 1) that belongs to a lattice point.
double lattice_value(std::uint64_t seed, std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto mixed = [](std::uint64_t state, std::int64_t next) {
    return base::Random(state ^ static_cast<std::uint64_t>(next)).bits();
  };
  return base::Random(mixed(mixed(mixed(seed, x), y), z)).uniform();
}

}  // namespace

GrooveTexture::GrooveTexture(const Vector3& across, double wavelength, double depth)
    : wave_(across.normalized() * (kTurn / wavelength)), depth_(depth) {
  assert(wavelength > 0.0 && depth >= 0.0 && across.squaredNorm() > 0.0);
}

TextureSample GrooveTexture::sample(const Vector3& point, const Vector3& /*normal*/) const {
  const double phase = wave_.dot(point);
  return {0.5 * depth_ * (std::cos(phase) - 1.0), -0.5 * depth_ * std::sin(phase) * wave_};
}

BumpTexture::BumpTexture(double spacing, double depth) : wave_(kTurn / spacing), depth_(depth) {
  assert(spacing > 0.0 && depth >= 0.0);
}

TextureSample BumpTexture::sample(const Vector3& point, const Vector3& /*normal*/) const {
  // A sum, not a product: a product of sines vanishes on every lattice plane, where flat faces like to be.
  const Vector3 phase = wave_ * point;
  const double share = depth_ / 6.0;  // three cosines, each spanning 2
  return {share * (phase.array().cos().sum() - 3.0), (-share * wave_) * phase.array().sin().matrix()};
}

GrainTexture::GrainTexture(double grain, double depth, std::uint64_t seed)
    : grain_(grain), depth_(depth), seed_(seed) {
  assert(grain > 0.0 && depth >= 0.0);
}

TextureSample GrainTexture::sample(const Vector3& point, const Vector3& /*normal*/) const {
  const Vector3 scaled = point / grain_;
  const Vector3 cell = scaled.array().floor();
  const Vector3 inside = scaled - cell;
  const std::array<std::int64_t, 3> corner = {static_cast<std::int64_t>(cell.x()),
                                              static_cast<std::int64_t>(cell.y()),
                                              static_cast<std::int64_t>(cell.z())};
  // Weights of the two lattice planes of each axis, and their slopes.
  std::array<std::array<double, 2>, 3> weight{};
  std::array<double, 3> slope{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double t = inside[static_cast<Eigen::Index>(axis)];
    weight[axis] = {1.0 - fade(t), fade(t)};
    slope[axis] = fade_slope(t);
  }
  double value = 0.0;
  Vector3 gradient = Vector3::Zero();
  for (std::size_t bits = 0; bits < 8; ++bits) {
    const std::size_t i = bits & 1, j = (bits >> 1) & 1, k = bits >> 2;
    const double v =
        lattice_value(seed_, corner[0] + static_cast<std::int64_t>(i),
                      corner[1] + static_cast<std::int64_t>(j), corner[2] + static_cast<std::int64_t>(k));
    const double wx = weight[0][i], wy = weight[1][j], wz = weight[2][k];
    value += v * wx * wy * wz;
    gradient += v * Vector3((i ? slope[0] : -slope[0]) * wy * wz, (j ? slope[1] : -slope[1]) * wx * wz,
                            (k ? slope[2] : -slope[2]) * wx * wy);
  }
  return {depth_ * (value - 1.0), gradient * (depth_ / grain_)};
}

Vector3 textured_force(const Vector3& force, const Vector3& normal, double stiffness,
                       const TextureSample& texture) {
  const double flat = force.dot(normal);  // N, of the surface without relief
  const double raised = std::max(0.0, flat + stiffness * texture.height);
  const Vector3 slope = texture.gradient - texture.gradient.dot(normal) * normal;
  return force - flat * normal + raised * (normal - slope);
}

}  // namespace icome::haptics
