#pragma once
#include <array>
#include <cstddef>
#include <optional>

#include "haptics/effects/effect.h"
#include "haptics/effects/springs.h"

namespace icome::haptics {

/// A plane, on one side of which the tip is kept.
struct GripStop {
  Vector3 point = Vector3::Zero();    // m, on the plane
  Vector3 normal = Vector3::UnitZ();  // unit, towards the side of the tip
};

/// The feel of a thing that the hand holds and edits: a vertex, a control point, an object. World frame.
struct GripFeel {
  bool holds = false;  // else nothing is felt

  Vector3 start = Vector3::Zero();  // m, place of the tip when it took hold
  /// The pull back of a deformed thing (thesis 4.5.3, equations 4.13 and 4.14): against the displacement from
  /// `start`, rising with its length from `least_pull` to `most_pull`. Both 0: none.
  double least_pull = 0.2;  // N
  double most_pull = 1.0;   // N, >= least_pull
  double reach = 0.05;      // m, > 0, the distance over which the pull rises by 63 % from least to most

  /// Walls at which surfaces or limits stop the held thing: they push the tip back. They stay in force until
  /// the next GripFeel comes, so that a wall feels hard although nothing looks for walls at 1 kHz.
  std::array<GripStop, 3> stops = {};
  std::size_t stop_count = 0;  // of `stops`
  /// Symmetric projection onto the directions in which the held thing can go: the identity for anywhere,
  /// d d^T along a line, I - n n^T in a plane. Guidance holds the tip in all other directions.
  base::Matrix3 freedom = base::Matrix3::Identity();
  SpringSettings hold = {.stiffness = 400.0, .damping = 2.0};  // of stops and of guidance

  /// The well of a place to which the held thing would snap; see GravityWell.
  struct Well {
    Vector3 centre = Vector3::Zero();  // m, place of the tip when snapped
    double radius = 0.01;              // m, > 0
    double stiffness = 200.0;          // N/m, at the centre
    /// Symmetric projection onto the directions in which the well pulls: the identity to a point,
    /// I - d d^T to a line along d, n n^T to a plane.
    base::Matrix3 across = base::Matrix3::Identity();
  };
  std::optional<Well> well = {};

  Vector3 weight = Vector3::Zero();  // N, of the held thing
};

/// The pull back, N, of a thing that was displaced by `distance` (m, >= 0): the function l of equation 4.13.
/// Rises throughout, from 0 at 0 and without a jump, so that nothing clicks when it is taken hold of.
/// Real-time safe.
double pull_back(const GripFeel& feel, double distance);

/// The part of the device's mass (kg) that the grip's springs need; see Effect::mass_needed. Real-time safe.
double grip_mass_needed(const GripFeel& feel, double device_mass, double dt);

/// The force (N) of the held thing on the tip. A function of the input and `feel` alone. Real-time safe.
Vector3 grip_force(const GripFeel& feel, const EffectInput& input);

}  // namespace icome::haptics
