#include "interaction/shaping/placed_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "interaction/object_move.h"
#include "interaction/operations/looks/texture_projector.h"
#include "interaction/operations/object_frames.h"
#include "interaction/operations/shapes/combine_solids.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::fail;
using base::Result;
using base::Vector3;
using geometry::CsgTree;
using world::ObjectId;
using world::World;

/// Pictures on meshes of more triangles are thrown when the drag is over.
constexpr std::size_t kMostThrownLive = 20'000;
/// Solids of more nodes show no operands.
constexpr std::size_t kMostNodesShown = 10'000;

world::GeometryPointer shape_of_object(const World& world, ObjectId id) {
  const world::PhysicalObject* const object = world.find(id);
  const world::GeometryObject* const geometry = object ? world.find(object->geometry) : nullptr;
  return geometry ? geometry->shape : nullptr;
}

void add_parts(const World& world, ObjectId id, std::size_t most, std::vector<PlacedPart>& parts) {
  const world::GeometryPointer shape = shape_of_object(world, id);
  if (!shape) return;
  if (const auto* solid = dynamic_cast<const world::CsgGeometry*>(shape.get())) {
    if (solid->tree.size() > kMostNodesShown) return;
    for (const CsgTree::Index leaf : leaves_of(solid->tree))
      if (parts.size() < most) parts.push_back({id, leaf});
  } else if (parts.size() < most && projector_in(*shape)) {
    parts.push_back({id, std::nullopt});
  }
}

}  // namespace

std::vector<PlacedPart> placed_parts(const World& world, std::span<const ObjectId> objects,
                                     std::size_t most) {
  std::vector<PlacedPart> parts;
  for (const ObjectId root : topmost(world, objects))
    for (const ObjectId id : world::subtree(world, root)) add_parts(world, id, most, parts);
  return parts;
}

const CsgTree* solid_of_part(const World& world, const PlacedPart& part) {
  const auto* solid = dynamic_cast<const world::CsgGeometry*>(shape_of_object(world, part.object).get());
  const bool is_there =
      solid && part.operand && *part.operand < solid->tree.size() && solid->tree.node(*part.operand).is_leaf;
  return is_there ? &solid->tree : nullptr;
}

std::optional<geometry::TextureProjector> projector_of_part(const World& world, const PlacedPart& part) {
  const world::GeometryPointer shape = shape_of_object(world, part.object);
  return shape && !part.operand ? projector_in(*shape) : std::nullopt;
}

std::optional<Affine3> world_from_part(const World& world, const PlacedPart& part) {
  std::optional<Affine3> place;
  if (const CsgTree* const tree = solid_of_part(world, part)) {
    place = tree_from_parent(*tree, *part.operand) * tree->node(*part.operand).parent_from_node;
  } else if (const auto projector = projector_of_part(world, part)) {
    place = projector->mesh_from_projector;
  }
  if (place) place = world::world_from_object(world, part.object) * *place;
  return place && place->matrix().allFinite() ? place : std::nullopt;
}

std::string name_of(const World& world, const PlacedPart& part) {
  const world::PhysicalObject* const object = world.find(part.object);
  if (!object) return {};
  const std::string whose = object->name.empty() ? called(world, part.object) : object->name;
  const CsgTree* const tree = solid_of_part(world, part);
  if (!tree) return fmt::format("projector of {}", whose);
  const std::vector<CsgTree::Index> leaves = leaves_of(*tree);
  const auto number = std::ranges::find(leaves, *part.operand) - leaves.begin();
  return fmt::format("operand {} of {}", number, whose);
}

Result<PartDrag> PartDrag::take(const World& world, const PlacedPart& part) {
  const auto place = world_from_part(world, part);
  if (!place) return fail("It is gone: select again what it was a part of.");
  PartDrag drag(part, world.find(part.object)->geometry, shape_of_object(world, part.object));
  drag.world_from_object_ = world::world_from_object(world, part.object);
  drag.centre_ = place->translation();
  if (const CsgTree* const tree = solid_of_part(world, part))
    drag.centre_ = drag.world_from_object_ * tree_from_parent(*tree, *part.operand) *
                   middle_of_operand(*tree, *part.operand);
  drag.name_ = "Move " + name_of(world, part);
  return drag;
}

bool PartDrag::is_live() const {
  const auto* const mesh = dynamic_cast<const world::MeshGeometry*>(before_.get());
  return !mesh || mesh->mesh.triangles.size() <= kMostThrownLive;
}

Result<world::Edit> PartDrag::by(const Affine3& motion) const {
  if (const auto* solid = dynamic_cast<const world::CsgGeometry*>(before_.get())) {
    auto moved = with_operand_moved(solid->tree, *part_.operand, world_from_object_, motion);
    if (!moved) return tl::unexpected(moved.error());
    return world::Edit(
        world::ReplaceGeometry{geometry_, std::make_shared<world::CsgGeometry>(std::move(*moved))});
  }
  const auto& mesh = static_cast<const world::MeshGeometry&>(*before_);
  auto moved = with_projector(mesh, moved_projector(*projector_in(mesh), world_from_object_, motion));
  if (!moved) return tl::unexpected(moved.error());
  return world::Edit(world::ReplaceGeometry{geometry_, std::move(*moved)});
}

}  // namespace icome::interaction
