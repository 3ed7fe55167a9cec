#pragma once
#include <array>
#include <cstddef>
#include <optional>

#include "haptics/effects/effect.h"
#include "haptics/effects/springs.h"

namespace icome::haptics {

/// A side of a plane that the tip is kept on.
struct GripStop {
  Vector3 point = Vector3::Zero();    // m, on the plane
  Vector3 normal = Vector3::UnitZ();  // unit, to where the tip may be
};

/// What a hand feels of what it holds and edits: a vertex, a control point, an object. World frame.
struct GripFeel {
  bool holds = false;  // else nothing is felt

  Vector3 start = Vector3::Zero();  // m, where the tip was when it took hold
  /// The pull back of what is deformed (thesis 4.5.3, equations 4.13 and 4.14): against the way from `start`,
  /// rising with its length from `least_pull` to `most_pull`. Both 0: none.
  double least_pull = 0.2;  // N
  double most_pull = 1.0;   // N, >= least_pull
  double reach = 0.05;      // m, > 0, the way over which the pull rises by 63 % from the least to the most

  /// Where what is held is stopped by surfaces or limits: the tip is pushed back as from a wall. It goes on
  /// by itself until the next word comes, so that a wall feels hard although nobody looks for walls at 1 kHz.
  std::array<GripStop, 3> stops = {};
  std::size_t stop_count = 0;  // of `stops`
  /// The directions in which what is held cannot go are those that this leaves: it is a symmetric projection,
  /// the identity where it can go anywhere, d d^T along a line, I - n n^T in a plane.
  base::Matrix3 freedom = base::Matrix3::Identity();
  SpringSettings hold = {.stiffness = 400.0, .damping = 2.0};  // of stops and of the way that is free

  /// The well of a place that it would snap to; see GravityWell.
  struct Well {
    Vector3 centre = Vector3::Zero();  // m, where the tip would be
    double radius = 0.01;              // m, > 0
    double stiffness = 200.0;          // N/m, at the centre
    /// The directions in which it pulls are those that this leaves, a symmetric projection: the identity to a
    /// point, I - d d^T to a line along d, n n^T to a plane.
    base::Matrix3 across = base::Matrix3::Identity();
  };
  std::optional<Well> well = {};

  Vector3 weight = Vector3::Zero();  // N, of what is held
};

/// How strongly a thing pulls back that was taken a way of `distance` (m, >= 0), N: the function l of
/// equation 4.13. Rises all the way; 0 at 0 and not all at once from there, so that nothing clicks when it is
/// taken hold of. Real-time safe.
double pull_back(const GripFeel& feel, double distance);

/// What of the device's mass (kg) its springs need; see Effect::mass_needed. Real-time safe.
double grip_mass_needed(const GripFeel& feel, double device_mass, double dt);

/// The force of what is held. A function of the input and `feel` alone. Real-time safe.
Vector3 grip_force(const GripFeel& feel, const EffectInput& input);

}  // namespace icome::haptics
