#pragma once
#include <span>

#include "haptics/contact/haptic_scene.h"

namespace icome::haptics {

/// Result of a solver in one tick.
struct ScpState {
  Vector3 scp = Vector3::Zero();               // m, world; the tip's own position while nothing is touched
  Vector3 normal = Vector3::UnitZ();           // unit, towards the free side, of the surface at the SCP
  Vector3 surface_velocity = Vector3::Zero();  // m/s, of the touched object at the SCP
  bool touching = false;
  bool started_inside = false;       // the SCP was put on the surface because the tip began inside
  bool converged = true;             // false: the budget ran out; the SCP is valid but may still move
  std::uint32_t object = kNoObject;  // in the scene, of the contact that carries most
  std::uint32_t feature = 0;
  int iterations = 0;
};

/// An object that differs between two scenes, and the box of everything it swept in between.
struct SceneChange {
  ObjectId id;
  geometry::FloatBox swept;
};

/// Finds the surface contact point (SCP), tick by tick: the one interface of the renderers that a person
/// chooses by name. One thread owns a solver; it keeps a pointer to the scene, which the caller keeps alive.
class ContactSolver {
 public:
  virtual ~ContactSolver() = default;

  /// Forgets the SCP: the next step starts at the tip, or at the surface if that is inside a solid.
  /// Real-time safe.
  virtual void reset() = 0;

  /// Adopts another scene. `changes` name the objects that differ from the last one and may
  /// name more. Real-time safe.
  virtual void adopt(const HapticScene& scene, std::span<const SceneChange> changes) = 0;

  /// Moves the SCP after the tip. `elapsed`: seconds since the moment of the scene's poses; `tip` is
  /// finite (m, world). Real-time safe.
  virtual const ScpState& step(const Vector3& tip, double elapsed) = 0;

  /// Prepares the data that the next step will probably need, when the force of this one is out: the cost
  /// loads the servo, but does not delay the force. The state stays as it is. Real-time safe.
  virtual void look_ahead() {}

  virtual const ScpState& state() const = 0;
};

}  // namespace icome::haptics
