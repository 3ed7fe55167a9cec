#include "haptics/servo/renderer.h"

#include <fmt/format.h>

#include "haptics/thesis/direct_shape.h"
#include "haptics/thesis/thesis_solver.h"

namespace icome::haptics {

base::Result<Renderer> parse_renderer(std::string_view name) {
  if (name == "exact" || name == "limit") return Renderer::Exact;
  if (name == "thesis") return Renderer::Thesis;
  return base::fail(fmt::format("\"{}\" is no renderer: choose exact, limit or thesis", name));
}

std::unique_ptr<ContactSolver> make_solver(Renderer renderer, const ScpSettings& settings) {
  if (renderer == Renderer::Thesis) return std::make_unique<ThesisSolver>();
  return std::make_unique<ScpSolver>(settings);
}

base::Result<void> check_renderer(Renderer renderer, const HapticScene& scene, const ScpSettings& settings) {
  if (renderer == Renderer::Thesis && settings.tip_radius > 0.0)
    return base::fail("the thesis renderer touches with a point: set the tip's radius to 0 or use exact");
  for (std::size_t i = 0; i < scene.objects().size(); ++i) {
    const bool direct = dynamic_cast<const DirectShape*>(scene.objects()[i].shape.get()) != nullptr;
    if (renderer == Renderer::Thesis && !direct)
      return base::fail(
          fmt::format("object {} is neither a CSG tree nor a Loop surface, and the thesis "
                      "renderer takes no others: use exact",
                      i + 1));
    if (renderer == Renderer::Exact && direct)
      return base::fail(fmt::format("object {} was made for the thesis renderer: choose that", i + 1));
  }
  return {};
}

}  // namespace icome::haptics
