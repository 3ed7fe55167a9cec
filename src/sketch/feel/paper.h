#pragma once
#include <memory>
#include <span>
#include <string_view>

#include "base/result.h"
#include "devices/pointer_device.h"
#include "haptics/contact/haptic_scene.h"
#include "haptics/effects/surface_force.h"

namespace icome::sketch {

/// A surface to draw on, as it is felt (thesis 4.5): how hard it is, how it holds the pen back, its grain.
/// Values were chosen, to tell four materials apart on devices of 1 N and more; they are not measured on real
/// ones.
struct Paper {
  std::string_view name = {};
  double stiffness = 0.0;  ///< N/m; 0: the hardest that the device renders well
  /// Coulomb coefficient of a pen, at rest and sliding: with less of it sliding the force would leap where a
  /// pen begins to move.
  double friction = 0.0;
  std::string_view texture = {};  ///< haptic texture (docs/effects.md); empty: smooth
  std::string_view about = {};    ///< a phrase for people
};

/// paper, blackboard, canvas and glass.
std::span<const Paper> papers();
/// The paper of that name; fails with the names that there are.
base::Result<Paper> find_paper(std::string_view name);

/// An eraser rubs on the paper so many times as hard as a pen (thesis 4.5.5).
constexpr double kEraserFriction = 1.8;

/// The paper as a surface that the servo renders, for a pen or an eraser.
haptics::Surface surface_of(const Paper& paper, bool eraser);

/// The paper as all that there is to touch: the plane z = 0, from above.
std::shared_ptr<const haptics::HapticScene> scene_of(const Paper& paper, bool eraser);

/// m for each N by which a hand's spring and the paper give way together, when a device presses on it that is
/// read every `dt` s.
double give_of(double hand_stiffness, const devices::DeviceInfo& device, const Paper& paper, double dt);

/// The force (N) with which a pen that presses so hard has full pressure. A plane is a spring with a damper,
/// so no hand can press a line wider than that.
constexpr double kFullPressure = 2.0;

}  // namespace icome::sketch
