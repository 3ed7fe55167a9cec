#pragma once
#include <cstdint>

#include "base/vector.h"

namespace icome::haptics {

using base::Vector3;

/// A texture at one surface point.
struct TextureSample {
  double height = 0.0;                 // m, along the normal; <= 0 carves into the surface
  Vector3 gradient = Vector3::Zero();  // of the height in space, m/m, same frame as the point
};

/// A relief felt on a surface without being in its geometry. It is a height field through all of space,
/// cut by the surface, so no texture coordinates are needed. Derive to add one. Heights should lie in
/// [-depth, 0]: a texture that only carves makes the force begin at zero when the tip touches.
class HapticTexture {
 public:
  virtual ~HapticTexture() = default;
  /// The relief at a surface point (m) with the unit normal there, both in the object's frame.
  /// Must be smooth: the force tilts with the gradient. Real-time safe.
  virtual TextureSample sample(const Vector3& point, const Vector3& normal) const = 0;
};

/// Parallel sinusoidal grooves.
class GrooveTexture final : public HapticTexture {
 public:
  /// `across` is the direction in which heights change (normalised here), `wavelength` > 0 and `depth`
  /// from ridge to bottom in m.
  GrooveTexture(const Vector3& across, double wavelength, double depth);
  TextureSample sample(const Vector3& point, const Vector3& normal) const override;

 private:
  Vector3 wave_;  // rad/m
  double depth_;  // m
};

/// A lattice of bumps with the same spacing along x, y and z.
class BumpTexture final : public HapticTexture {
 public:
  /// `spacing` > 0 of neighbouring bumps and `depth` from the highest to the lowest point in m.
  BumpTexture(double spacing, double depth);
  TextureSample sample(const Vector3& point, const Vector3& normal) const override;

 private:
  double wave_;   // rad/m
  double depth_;  // m
};

/// Smooth random grain, like cast metal or stone: lattice noise with continuous second derivatives.
/// The same seed gives the same grain on every machine.
class GrainTexture final : public HapticTexture {
 public:
  /// `grain` > 0: size of the grains, `depth`: from the highest to the lowest possible point, in m.
  GrainTexture(double grain, double depth, std::uint64_t seed);
  TextureSample sample(const Vector3& point, const Vector3& normal) const override;

 private:
  double grain_;  // m
  double depth_;  // m
  std::uint64_t seed_;
};

/// The force (N) of a surface with relief, made from the surface's `force` (N, e.g. from spring_damper_force)
/// at a contact with unit normal `normal`, on a surface of `stiffness` N/m: the height changes the depth and
/// the slope tilts the force (Minsky's gradient method, 1995, in the form of Ho, Basdogan and Srinivasan,
/// 1999). On a flat undamped surface the result is the gradient of the energy K/2 (depth + height)^2, so the
/// relief itself neither gives nor takes energy. Never pulls inwards. Real-time safe.
Vector3 textured_force(const Vector3& force, const Vector3& normal, double stiffness,
                       const TextureSample& texture);

}  // namespace icome::haptics
