#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "geometry/csg/csg_tree.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"
#include "world/world.h"

namespace icome::interaction {

/// The solid that existing objects, at least one, make together (a difference takes the others from the
/// first), in the first one's frame: their places go into the tree. Primitives, CSG solids and closed meshes
/// can be combined; objects that share a mesh share it in the tree. Fails, naming the object and what to do,
/// for others.
base::Result<geometry::CsgTree> combined_solid(const world::World& world,
                                               const std::vector<world::ObjectId>& objects,
                                               geometry::CsgOperator how);

/// An operand of a tree as a shape of its own.
struct Operand {
  world::GeometryPointer shape;
  std::string kind;  // "box", "mesh", for its name
  base::Affine3 tree_from_shape = base::Affine3::Identity();
  std::optional<geometry::CsgTree::Colour> colour = {};
};

/// The leaves from left to right, as combined_solid would take them back. Primitives stand as
/// they are created: boxes along z, others along y. Leaves of one mesh have one shape.
std::vector<Operand> operands(const geometry::CsgTree& tree);

/// The node of that name: "lr" goes to the left operand and to the right one of that; "2" is the third leaf
/// from the left. Fails saying what there is.
base::Result<geometry::CsgTree::Index> operand_named(const geometry::CsgTree& tree, std::string_view name);

/// The leaves of a tree from left to right: "2" names the third of them.
std::vector<geometry::CsgTree::Index> leaves_of(const geometry::CsgTree& tree);

/// The middle of a part of a tree, in the frame in which its place is given (m); its origin where it has
/// no end.
base::Vector3 middle_of_operand(geometry::CsgTree tree, geometry::CsgTree::Index node);

/// The tree with one part carried along by a motion of the world. Fails where the solid is shrunk to
/// nothing, and for places that are too far away.
base::Result<geometry::CsgTree> with_operand_moved(const geometry::CsgTree& tree,
                                                   geometry::CsgTree::Index node,
                                                   const base::Affine3& world_from_tree,
                                                   const base::Affine3& motion);

/// The frame in which the place of a node is given, in the tree's frame; identity for the root.
base::Affine3 tree_from_parent(const geometry::CsgTree& tree, geometry::CsgTree::Index node);

}  // namespace icome::interaction
