#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>

#include "interaction/object_edits.h"
#include "interaction/operations/object_frames.h"
#include "interaction/operations/operation.h"
#include "interaction/operations/placement.h"
#include "interaction/operations/shapes/combine_solids.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::fail;
using base::Result;
using geometry::CsgTree;
using world::ObjectId;
using world::World;

/// Deletes the shape that an object is about to lose, where no other object has it.
void let_go(const World& world, world::GeometryId shape, world::EditGroup& group) {
  if (world.find(shape)->users == 1) group.edits.emplace_back(world::DeleteGeometry{shape});
}

// ---- Combine ------------------------------------------------------------------------------------------

geometry::CsgOperator operator_named(const std::string& name) {
  if (name == "union") return geometry::CsgOperator::Union;
  return name == "intersection" ? geometry::CsgOperator::Intersection : geometry::CsgOperator::Difference;
}

/// Fails for operands with objects below them, which would be lost as the operands go away.
Result<void> check_operands(const World& world, const std::vector<ObjectId>& objects) {
  if (objects.size() < 2) return fail("'objects' must be two or more");
  for (std::size_t i = 1; i < objects.size(); ++i) {
    if (!world.find(objects[i])->children.empty())
      return fail(fmt::format("{} has objects below it, which would go with it: put them elsewhere first",
                              called(world, objects[i])));
  }
  return {};
}

Result<Plan> plan_combine(const World& world, const Arguments& arguments, world::IdSource& ids) {
  const std::vector<ObjectId> objects = arguments.objects("objects");
  if (const auto good = check_operands(world, objects); !good) return tl::unexpected(good.error());
  auto tree = combined_solid(world, objects, operator_named(arguments.text("how")));
  if (!tree) return tl::unexpected(tree.error());
  const ObjectId first = objects.front();
  const auto geometry = ids.next<world::GeometryId>();
  world::EditGroup group;
  group.edits.emplace_back(
      world::CreateGeometry{geometry, std::make_shared<world::CsgGeometry>(std::move(*tree))});
  group.edits.emplace_back(world::ChooseGeometry{first, geometry});
  // A shape that only the operands have is deleted here: delete_objects() does not count the first
  // operand, which stays.
  world::Edit rest = delete_objects(world, std::span(objects).subspan(1));
  auto& deletions = std::get<world::EditGroup>(rest.what).edits;
  const world::GeometryId shape = world.find(first)->geometry;
  const auto has_it = [&](ObjectId id) { return world.find(id)->geometry == shape; };
  std::ranges::move(deletions, std::back_inserter(group.edits));
  if (world.find(shape)->users == std::uint32_t(std::ranges::count_if(objects, has_it)))
    group.edits.emplace_back(world::DeleteGeometry{shape});
  return Plan{std::move(group), {first}};
}

// ---- Take apart ---------------------------------------------------------------------------------------

Result<const CsgTree*> tree_of(const World& world, ObjectId id) {
  const world::GeometryId geometry = world.find(id)->geometry;
  const auto* solid =
      geometry ? dynamic_cast<const world::CsgGeometry*>(world.find(geometry)->shape.get()) : nullptr;
  if (solid && !solid->tree.empty()) return &solid->tree;
  return fail(fmt::format("{} is no solid that was combined of others", called(world, id)));
}

/// Materials for operands that have colours of their own: the solid's in another colour, one for each.
class OperandMaterials {
 public:
  OperandMaterials(const World& world, world::MaterialId of_solid, world::IdSource& ids)
      : world_(world), of_solid_(of_solid), ids_(ids) {}

  world::MaterialId choose(const std::optional<CsgTree::Colour>& colour, world::EditGroup& group) {
    if (!colour) return of_solid_;
    const auto [found, fresh] = made_.try_emplace(*colour);
    if (!fresh) return found->second;
    found->second = ids_.next<world::MaterialId>();
    world::Material material = of_solid_ ? *world_.find(of_solid_) : world::Material();
    material.name = fmt::format("operand {}", found->second.value);
    material.diffuse = {(*colour)[0], (*colour)[1], (*colour)[2]};
    material.transparency = 1.0F - (*colour)[3];
    group.edits.emplace_back(world::CreateMaterial{found->second, std::move(material)});
    return found->second;
  }

 private:
  const World& world_;
  world::MaterialId of_solid_;
  world::IdSource& ids_;
  std::map<CsgTree::Colour, world::MaterialId> made_;
};

/// Names for the operands after their kinds, in the operands' order.
std::vector<std::string> operand_names(const World& world, const std::vector<Operand>& parts) {
  std::map<std::string, std::size_t> counts;
  for (const Operand& part : parts) ++counts[part.kind];
  std::map<std::string, std::vector<std::string>> names;
  for (const auto& [kind, count] : counts) {
    names[kind] = unused_names(world, kind, count);
    std::ranges::reverse(names[kind]);
  }
  std::vector<std::string> given;
  for (const Operand& part : parts) {
    given.push_back(std::move(names[part.kind].back()));
    names[part.kind].pop_back();
  }
  return given;
}

Result<Plan> plan_separate(const World& world, const Arguments& arguments, world::IdSource& ids) {
  const ObjectId id = arguments.object("object");
  const auto tree = tree_of(world, id);
  if (!tree) return tl::unexpected(tree.error());
  const world::PhysicalObject& solid = *world.find(id);
  const std::vector<Operand> parts = operands(**tree);
  const std::vector<std::string> names = operand_names(world, parts);
  Plan plan{world::EditGroup{}};
  auto& group = std::get<world::EditGroup>(plan.edit.what);
  group.edits.emplace_back(world::ChooseGeometry{id, {}});
  let_go(world, solid.geometry, group);
  OperandMaterials materials(world, solid.material, ids);
  std::unordered_map<world::GeometryPointer, world::GeometryId> shapes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto [shape, fresh] = shapes.try_emplace(parts[i].shape);
    if (fresh) {
      shape->second = ids.next<world::GeometryId>();
      group.edits.emplace_back(world::CreateGeometry{shape->second, parts[i].shape});
    }
    world::PhysicalObject object;
    object.name = names[i];
    object.parent = id;
    object.parent_from_object = parts[i].tree_from_shape;
    object.geometry = shape->second;
    object.material = materials.choose(parts[i].colour, group);
    plan.objects.push_back(ids.next<ObjectId>());
    group.edits.emplace_back(
        world::CreateObject{plan.objects.back(), solid.children.size() + i, std::move(object)});
  }
  return plan;
}

// ---- Move an operand ----------------------------------------------------------------------------------

Result<Plan> plan_move_operand(const World& world, const Arguments& arguments, world::IdSource&) {
  const ObjectId id = arguments.object("object");
  const auto tree = tree_of(world, id);
  if (!tree) return tl::unexpected(tree.error());
  const auto node = operand_named(**tree, arguments.text("operand"));
  if (!node) return tl::unexpected(node.error());
  const Affine3 world_from_tree = world::world_from_object(world, id);
  const Vector3 centre =
      arguments.has("centre")
          ? arguments.vector("centre")
          : Vector3(world_from_tree * tree_from_parent(**tree, *node) * middle_of_operand(**tree, *node));
  Affine3 motion = about(centre, turn_of(arguments.vector("turn")));
  motion.translation() += arguments.vector("by");
  auto changed = with_operand_moved(**tree, *node, world_from_tree, motion);
  if (!changed) return tl::unexpected(changed.error());
  return Plan{world::ReplaceGeometry{world.find(id)->geometry,
                                     std::make_shared<world::CsgGeometry>(std::move(*changed))},
              {id}};
}

// ---- Change an operator -------------------------------------------------------------------------------

Result<Plan> plan_change_operator(const World& world, const Arguments& arguments, world::IdSource&) {
  const ObjectId id = arguments.object("object");
  const auto tree = tree_of(world, id);
  if (!tree) return tl::unexpected(tree.error());
  const auto node = arguments.has("part") ? operand_named(**tree, arguments.text("part"))
                                          : Result<CsgTree::Index>((*tree)->root());
  if (!node) return tl::unexpected(node.error());
  if ((*tree)->node(*node).is_leaf)
    return fail(
        fmt::format("that part of {} is a single shape: there is nothing to combine", called(world, id)));
  CsgTree changed = **tree;
  changed.set_operator(*node, operator_named(arguments.text("how")));
  const world::GeometryId geometry = world.find(id)->geometry;
  return Plan{world::ReplaceGeometry{geometry, std::make_shared<world::CsgGeometry>(std::move(changed))},
              {id}};
}

/// `how`: the operator that combines shapes.
Parameter how_parameter() {
  return {.name = "how",
          .kind = ParameterKind::Choice,
          .meaning = "all that is in any of them, only what is in all, or the first without the others",
          .required = true,
          .choices = {"union", "intersection", "difference"}};
}

Operation combine_operation() {
  return {"combine",
          "Combine",
          "Solids",
          "Makes one solid of several: it takes the first one's name, place and material, and can be taken "
          "apart again.",
          {{.name = "objects",
            .kind = ParameterKind::Objects,
            .meaning = "closed shapes: primitives, solids and closed meshes; the first is what others are "
                       "taken from; what is painted on meshes is left behind",
            .required = true},
           how_parameter()},
          plan_combine};
}

Operation separate_operation() {
  return {"separate",
          "Take apart",
          "Solids",
          "Makes objects again of the shapes that a solid was combined of, where they stand in it; what was "
          "the solid is their group.",
          {{.name = "object", .kind = ParameterKind::Object, .meaning = "the solid", .required = true}},
          plan_separate};
}

Operation move_operand_operation() {
  return {"move-operand",
          "Move operand",
          "Solids",
          "Moves a part of a solid within it, for all objects that share the solid.",
          {{.name = "object", .kind = ParameterKind::Object, .meaning = "the solid", .required = true},
           {.name = "operand",
            .kind = ParameterKind::Text,
            .meaning = "its way from the top, l for left and r for right (\"rl\"), or its number among the "
                       "shapes from the left, from 0 (\"2\")",
            .required = true},
           place_parameter("by", "how far along the axes of the world, m"),
           turn_parameter("an axis in the world, as long as the angle in degrees, right-handed; before by"),
           optional_place_parameter("centre", "what it turns about, m in the world; else its middle")},
          plan_move_operand};
}

Operation change_operator_operation() {
  return {
      "change-operator",
      "Change operator",
      "Solids",
      "Combines the shapes of a solid in another way, for all objects that share the solid.",
      {{.name = "object", .kind = ParameterKind::Object, .meaning = "the solid", .required = true},
       how_parameter(),
       {.name = "part",
        .kind = ParameterKind::Text,
        .meaning = "which part of it: its way from the top, l for left and r for right (\"rl\"); else the "
                   "whole"}},
      plan_change_operator};
}

}  // namespace

std::vector<Operation> solid_operations() {
  return {combine_operation(), separate_operation(), move_operand_operation(), change_operator_operation()};
}

}  // namespace icome::interaction
