#pragma once
#include <memory>
#include <string_view>

#include "base/result.h"
#include "haptics/contact/scp_solver.h"

namespace icome::haptics {

/// The ways to find the surface contact point that a person chooses from by name.
enum class Renderer {
  Exact,   // "exact", for Loop surfaces also called "limit": the constrained SCP on the true surface
  Thesis,  // "thesis": sections 5.4 and 5.5 as printed and corrected, for CSG trees and Loop surfaces
};

/// Reads "exact", "limit" or "thesis".
base::Result<Renderer> parse_renderer(std::string_view name);

/// The solver of this renderer. The thesis renders a point tip and has no budget of its own to set.
std::unique_ptr<ContactSolver> make_solver(Renderer renderer, const ScpSettings& settings);

/// Fails with a sentence when the scene holds an object that the renderer cannot touch.
base::Result<void> check_renderer(Renderer renderer, const HapticScene& scene, const ScpSettings& settings);

}  // namespace icome::haptics
