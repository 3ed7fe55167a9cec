#include "sketch/feel/paper.h"

#include <fmt/format.h>

#include <array>

#include "base/near_names.h"
#include "haptics/effects/texture_text.h"
#include "haptics/shapes/primitive_shape.h"

namespace icome::sketch {
namespace {

constexpr double kSoftLanding = 0.0002;  // m, over which the damper of the plane sets in

constexpr std::array<Paper, 4> kPapers = {{
    {"paper", 0.0, 0.32, "grain:0.00005,0.0006", "a sheet on a desk: fine grain"},
    {"blackboard", 0.0, 0.55, "grain:0.00012,0.0012", "chalk on slate: rough"},
    {"canvas", 400.0, 0.46, "bumps:0.0002,0.0012", "stretched cloth: soft, a weave"},
    {"glass", 0.0, 0.08, "", "hard and slippery"},
}};

}  // namespace

std::span<const Paper> papers() { return kPapers; }

base::Result<Paper> find_paper(std::string_view name) {
  std::vector<std::string> names;
  for (const Paper& paper : kPapers) {
    if (paper.name == name) return paper;
    names.emplace_back(paper.name);
  }
  return base::fail(fmt::format("there is no paper '{}'{}", name, base::suggestion(name, std::move(names))));
}

std::shared_ptr<const haptics::HapticScene> scene_of(const Paper& paper, bool eraser) {
  haptics::HapticObject sheet;
  sheet.id = {0, 1};
  sheet.shape = std::make_shared<haptics::PrimitiveShape>(geometry::Plane{});
  sheet.surface = surface_of(paper, eraser);
  return haptics::HapticScene::compile({sheet});
}

haptics::Surface surface_of(const Paper& paper, bool eraser) {
  const double more = eraser ? kEraserFriction : 1.0;
  haptics::Surface surface;
  surface.stiffness = paper.stiffness;
  surface.damping_depth = kSoftLanding;
  surface.static_friction = surface.dynamic_friction = more * paper.friction;
  if (!paper.texture.empty()) surface.texture = haptics::make_texture(paper.texture).value();
  return surface;
}

double give_of(double hand_stiffness, const devices::DeviceInfo& device, const Paper& paper, double dt) {
  haptics::Surface surface = surface_of(paper, false);
  haptics::make_stable(surface, device.nominal_stiffness, device.effective_mass, dt);
  return 1.0 / hand_stiffness + 1.0 / surface.stiffness;
}

}  // namespace icome::sketch
