#include "interaction/operations/shapes/combine_solids.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <map>
#include <unordered_map>

#include "base/parse_number.h"
#include "geometry/mesh/mesh_repair.h"
#include "interaction/operations/object_frames.h"
#include "world/shape/geometry_check.h"
#include "world/shape/visit_geometry.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::fail;
using base::Result;
using base::Vector3;
using geometry::CsgTree;
using geometry::MeshSolid;
using world::ObjectId;
using world::World;
using MeshSolidPointer = std::shared_ptr<const MeshSolid>;

// ---- Meshes as operands -------------------------------------------------------------------------------

constexpr double kLargestCoordinate = 1e70;  // what repairing a mesh can take

bool is_sound(const geometry::TriangleMesh& mesh) {
  const geometry::MeshReport report = geometry::analyse_topology(mesh).report;
  return report.closed && report.orientable && report.inconsistent_edges == 0 &&
         report.non_manifold_edges == 0 && geometry::signed_volume(mesh) > 0.0;
}

/// The mesh as a solid: as it is where it is sound, else repaired. Fails where it encloses nothing.
Result<MeshSolidPointer> solid_of(const geometry::TriangleMesh& mesh, const std::string& name) {
  if (const std::string wrong = world::complaint(mesh); !wrong.empty())
    return fail(fmt::format("{} cannot be combined: {}", name, wrong));
  for (const Vector3& position : mesh.positions)
    if (!(position.cwiseAbs().maxCoeff() < kLargestCoordinate))
      return fail(fmt::format("{} is too large to be combined: scale its vertices down", name));
  if (is_sound(mesh)) return std::make_shared<const MeshSolid>(mesh);
  geometry::TriangleMesh repaired = mesh;
  const geometry::RepairReport report = geometry::repair(repaired);
  if (report.surface.closed && report.unorientable_patches == 0 && geometry::signed_volume(repaired) > 0.0)
    return std::make_shared<const MeshSolid>(std::move(repaired));
  if (report.surface.boundary_edges > 0)
    return fail(
        fmt::format("{} is open, so it has no inside: close it first ({} edges have a triangle on one "
                    "side only)",
                    name, report.surface.boundary_edges));
  return fail(fmt::format("{} encloses nothing: combine closed shapes", name));
}

/// The most nodes of one tree: a solid that is combined with its own copies doubles each time.
constexpr std::size_t kMostNodes = 1'000'000;

// ---- Building -----------------------------------------------------------------------------------------

/// Puts shapes into one tree.
class SolidBuilder {
 public:
  SolidBuilder(const World& world, const Affine3& tree_from_world)
      : world_(world), tree_from_world_(tree_from_world) {}

  Result<CsgTree::Index> add(ObjectId id) {
    const world::PhysicalObject& object = *world_.find(id);
    const std::string name = called(world_, id);
    if (!object.geometry)
      return fail(fmt::format("{} has no shape of its own: name the objects below it", name));
    const Affine3 place = tree_from_world_ * world::world_from_object(world_, id);
    if (!place.matrix().allFinite() || !geometry::unplacing(place).matrix().allFinite())
      return fail(fmt::format("{} is shrunk to nothing: make it larger first", name));
    const world::Geometry& shape = *world_.find(object.geometry)->shape;
    using Added = Result<CsgTree::Index>;
    return world::visit_geometry(
        shape,
        [&](const world::PrimitiveGeometry& it) -> Added {
          return tree_.add_leaf(it.primitive, place * Affine3(it.shape_from_primitive()));
        },
        [&](const world::CsgGeometry& it) -> Added { return add(it.tree, place, name); },
        [&](const world::MeshGeometry& it) -> Added { return add(object.geometry, it.mesh, place, name); },
        [&](const world::Geometry& it) -> Added {
          return fail(fmt::format("{} is a {} shape, which cannot be combined: make a mesh of it first", name,
                                  it.kind()));
        });
  }

  void join(geometry::CsgOperator how, CsgTree::Index left, CsgTree::Index right) {
    tree_.add(how, left, right);
  }
  CsgTree::Index root() const { return tree_.root(); }
  CsgTree take() { return std::move(tree_); }

 private:
  Result<CsgTree::Index> add(world::GeometryId id, const geometry::TriangleMesh& mesh, const Affine3& place,
                             const std::string& name) {
    const auto [found, fresh] = meshes_.try_emplace(id);
    if (fresh) {
      auto solid = solid_of(mesh, name);
      if (!solid) return tl::unexpected(solid.error());
      found->second = std::move(*solid);
    }
    return tree_.add_leaf(found->second, place);
  }

  /// Adds a solid that was combined before: its tree goes into this one.
  Result<CsgTree::Index> add(const CsgTree& from, const Affine3& place, const std::string& name) {
    if (from.empty()) return fail(fmt::format("{} is an empty solid: leave it out", name));
    if (tree_.size() + from.size() > kMostNodes)
      return fail(
          fmt::format("the solid would have more than {} parts: make a mesh of {} first", kMostNodes, name));
    std::vector<CsgTree::Index> moved(from.root() + 1);
    for (const CsgTree::Index i : below(from)) {
      const CsgTree::Node& node = from.node(i);
      const Affine3 where = i == from.root() ? Affine3(place * node.parent_from_node) : node.parent_from_node;
      moved[i] = node.is_leaf ? tree_.add_leaf(*node.shape, where, node.colour)
                              : tree_.add(node.op, moved[node.left], moved[node.right], where);
    }
    return tree_.root();
  }

  /// The nodes of a tree that its root reaches, operands first.
  static std::vector<CsgTree::Index> below(const CsgTree& tree) {
    std::vector<bool> belongs(tree.root() + 1, false);
    belongs[tree.root()] = true;
    for (CsgTree::Index i = tree.root() + 1; i-- > 0;)
      if (belongs[i] && !tree.node(i).is_leaf)
        belongs[tree.node(i).left] = belongs[tree.node(i).right] = true;
    std::vector<CsgTree::Index> nodes;
    for (CsgTree::Index i = 0; i <= tree.root(); ++i)
      if (belongs[i]) nodes.push_back(i);
    return nodes;
  }

  const World& world_;
  Affine3 tree_from_world_;
  CsgTree tree_;
  std::map<world::GeometryId, MeshSolidPointer> meshes_;
};

// ---- Taking apart -------------------------------------------------------------------------------------

std::string kind_of_leaf(const geometry::CsgShape& shape) {
  if (std::holds_alternative<MeshSolidPointer>(shape)) return "mesh";
  const std::string name = geometry::shape_name(shape);
  return name.substr(0, name.find(':'));
}

/// The axis of new shapes: round ones stand along y, which is up; boxes have the given sizes along their own
/// axes.
world::Axis axis_of(const geometry::Primitive& primitive) {
  return std::holds_alternative<geometry::Box>(primitive) ? world::Axis::Z : world::Axis::Y;
}

/// Makes shapes of leaves, one for all leaves of a mesh.
class LeafShapes {
 public:
  Operand operand(const CsgTree::Node& leaf, const Affine3& tree_from_leaf) {
    Operand made{nullptr, kind_of_leaf(*leaf.shape), tree_from_leaf, leaf.colour};
    if (const auto* primitive = std::get_if<geometry::Primitive>(&*leaf.shape)) {
      const world::PrimitiveGeometry shape(*primitive, axis_of(*primitive));
      made.tree_from_shape = tree_from_leaf * Affine3(shape.shape_from_primitive().transpose());
      made.shape = std::make_shared<world::PrimitiveGeometry>(shape);
    } else if (const auto* mesh = std::get_if<MeshSolidPointer>(&*leaf.shape)) {
      world::GeometryPointer& shape = meshes_[mesh->get()];
      if (!shape) shape = std::make_shared<world::MeshGeometry>((*mesh)->mesh);
      made.shape = shape;
    } else {
      CsgTree alone;
      alone.add_leaf(*leaf.shape);
      made.shape = std::make_shared<world::CsgGeometry>(std::move(alone));
    }
    return made;
  }

 private:
  std::unordered_map<const MeshSolid*, world::GeometryPointer> meshes_;
};

Result<CsgTree::Index> leaf_numbered(const CsgTree& tree, std::string_view name) {
  const std::vector<CsgTree::Index> leaves = leaves_of(tree);
  const auto number = base::parse_number<std::size_t>(name);
  if (number && *number < leaves.size()) return leaves[*number];
  return fail(
      fmt::format("there is no operand '{}': name one by its way from the top, such as 'lr', or by its "
                  "number among the shapes from the left, 0 to {}",
                  name, leaves.size() - 1));
}

}  // namespace

Result<CsgTree> combined_solid(const World& world, const std::vector<ObjectId>& objects,
                               geometry::CsgOperator how) {
  const Affine3 first_from_world = world::world_from_object(world, objects.front()).inverse();
  SolidBuilder builder(world, first_from_world);
  std::optional<CsgTree::Index> left;
  for (const ObjectId id : objects) {
    const auto right = builder.add(id);
    if (!right) return tl::unexpected(right.error());
    if (left) builder.join(how, *left, *right);
    left = builder.root();
  }
  return builder.take();
}

std::vector<CsgTree::Index> leaves_of(const CsgTree& tree) {
  std::vector<CsgTree::Index> leaves;
  std::vector<CsgTree::Index> waiting;
  if (!tree.empty()) waiting.push_back(tree.root());
  while (!waiting.empty()) {
    const CsgTree::Index next = waiting.back();
    const CsgTree::Node& node = tree.node(next);
    waiting.pop_back();
    if (node.is_leaf) {
      leaves.push_back(next);
      continue;
    }
    waiting.push_back(node.right);
    waiting.push_back(node.left);
  }
  return leaves;
}

std::vector<Operand> operands(const CsgTree& tree) {
  const std::vector<Affine3> tree_from_node = tree.tree_from_node();
  LeafShapes shapes;
  std::vector<Operand> found;
  for (const CsgTree::Index leaf : leaves_of(tree))
    found.push_back(shapes.operand(tree.node(leaf), tree_from_node[leaf]));
  return found;
}

Result<CsgTree::Index> operand_named(const CsgTree& tree, std::string_view name) {
  if (tree.empty()) return fail("the solid is empty");
  if (name.empty() || name.find_first_not_of("lr") != std::string_view::npos)
    return leaf_numbered(tree, name);
  CsgTree::Index node = tree.root();
  for (const char side : name) {
    if (tree.node(node).is_leaf)
      return fail(fmt::format("there is no operand '{}': the way ends in a shape before", name));
    node = side == 'l' ? tree.node(node).left : tree.node(node).right;
  }
  return node;
}

Affine3 tree_from_parent(const CsgTree& tree, CsgTree::Index node) {
  if (node == tree.root()) return Affine3::Identity();
  const std::vector<Affine3> tree_from_node = tree.tree_from_node();
  for (CsgTree::Index i = 0; i <= tree.root(); ++i) {
    const CsgTree::Node& it = tree.node(i);
    if (!it.is_leaf && (it.left == node || it.right == node)) return tree_from_node[i];
  }
  return Affine3::Identity();
}

Vector3 middle_of_operand(CsgTree tree, CsgTree::Index node) {
  tree.set_root(node);
  const base::Bounds box = geometry::bounds(tree);
  const bool has_end = !box.isEmpty() && box.min().allFinite() && box.max().allFinite();
  return has_end ? Vector3(box.center()) : Vector3(tree.node(node).parent_from_node.translation());
}

Result<CsgTree> with_operand_moved(const CsgTree& tree, CsgTree::Index node, const Affine3& world_from_tree,
                                   const Affine3& motion) {
  const Affine3 world_from_frame = world_from_tree * tree_from_parent(tree, node);
  const Affine3 frame_from_world = world_from_frame.inverse();
  if (!frame_from_world.matrix().allFinite())
    return fail("the solid is shrunk to nothing: nothing can be moved in it");
  const Affine3 now = frame_from_world * motion * world_from_frame * tree.node(node).parent_from_node;
  if (!now.matrix().allFinite() || !geometry::unplacing(now).matrix().allFinite())
    return fail("the operand would be too far away: say less");
  CsgTree changed = tree;
  changed.set_transform(node, now);
  return changed;
}

}  // namespace icome::interaction
