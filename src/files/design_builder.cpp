#include "files/design_builder.h"

#include <fmt/format.h>

#include <utility>

#include "world/edit/edit_memory.h"
#include "world/motion.h"
#include "world/shape/solid_geometry.h"

namespace icome::files {

void DesignBuilder::put(const world::Edit& edit, std::size_t known_bytes) {
  if (!refusal_.empty()) return;
  if (!memory_.take(world::memory_of(edit) - known_bytes)) {
    refusal_ = memory_.problem().message;
  } else if (const auto applied = world::replay(design_.world, edit); !applied) {
    refusal_ = applied.error().message;
  }
}

/// The equal primitive that exists already, else the shape itself.
world::GeometryPointer DesignBuilder::known(world::GeometryPointer shape) {
  const auto* primitive = dynamic_cast<const world::PrimitiveGeometry*>(shape.get());
  if (!primitive) return shape;
  const auto [found, fresh] = primitives_.try_emplace(primitive->hash(), shape);
  const auto& other = static_cast<const world::PrimitiveGeometry&>(*found->second);
  return fresh || other.same(*primitive) ? found->second : shape;
}

world::GeometryId DesignBuilder::add(world::GeometryPointer shape) {
  const auto id = ids_.next<world::GeometryId>();
  put(world::CreateGeometry{id, known(std::move(shape))});
  return id;
}

world::MaterialId DesignBuilder::add(world::Material material) {
  const auto id = ids_.next<world::MaterialId>();
  put(world::CreateMaterial{id, std::move(material)});
  return id;
}

world::TextureId DesignBuilder::add(world::Texture texture) {
  const auto id = ids_.next<world::TextureId>();
  put(world::CreateTexture{id, std::move(texture)});
  return id;
}

world::ObjectId DesignBuilder::add(world::PhysicalObject object) {
  const auto id = ids_.next<world::ObjectId>();
  const world::PhysicalObject* const parent = world().find(object.parent);
  const std::size_t place = parent ? parent->children.size() : world().roots().size();
  const bool moves_alike = object.motion && !motions_.insert(object.motion).second;
  const std::size_t known_bytes = moves_alike ? world::bytes_of(*object.motion) : 0;
  put(world::CreateObject{id, place, std::move(object)}, known_bytes);
  return id;
}

world::SceneId DesignBuilder::add_scene(const std::string& name, const std::vector<world::ObjectId>& roots) {
  const auto id = ids_.next<world::SceneId>();
  put(world::CreateScene{id, name});
  for (std::size_t place = 0; place < roots.size(); ++place) put(world::EnterScene{id, roots[place], place});
  return id;
}

base::Result<LoadedDesign> DesignBuilder::take(std::string format, const std::string& name) {
  if (!refusal_.empty()) return base::fail(fmt::format("{}: {}", name, refusal_));
  design_.format = std::move(format);
  return std::exchange(design_, {});
}

}  // namespace icome::files
