#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "geometry/csg_tree.h"
#include "world/mesh_geometry.h"
#include "world/solid_geometry.h"
#include "world/world.h"

namespace icome::interaction {

/// The solid that objects, which are there and at least one, make together (the first is what others are
/// taken from), in the first one's frame: their places go into the tree. Primitives, CSG solids and closed
/// meshes can be combined; objects that share a mesh share it in the tree. Fails, naming the object and what
/// to do, for others.
base::Result<geometry::CsgTree> combined_solid(const world::World& world,
                                               const std::vector<world::ObjectId>& objects,
                                               geometry::CsgOperator how);

/// An operand of a tree for itself.
struct Operand {
  world::GeometryPointer shape;
  std::string kind;  // "box", "mesh", for its name
  base::Affine3 tree_from_shape = base::Affine3::Identity();
  std::optional<geometry::CsgTree::Colour> colour = {};
};

/// The leaves from left to right, as combined_solid would take them back. Primitives stand as
/// they are created: boxes along z, others along y. Leaves of one mesh have one shape.
std::vector<Operand> operands(const geometry::CsgTree& tree);

/// The node that is named: "lr" goes to the left operand and to the right one of that; "2" is the third leaf
/// from the left. Fails saying what there is.
base::Result<geometry::CsgTree::Index> operand_named(const geometry::CsgTree& tree, std::string_view name);

/// What the places of its operands are said in, in the tree's frame; identity for the root.
base::Affine3 tree_from_parent(const geometry::CsgTree& tree, geometry::CsgTree::Index node);

}  // namespace icome::interaction
