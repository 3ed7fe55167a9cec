#pragma once
#include <string>
#include <vector>

#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::world {

// The conditions that every function on shapes relies on: checked before a shape is written and after it
// is read, so that what is written can be read. The answer describes the fault; empty when all is well.

std::string complaint(const geometry::TriangleMesh& mesh);
std::string complaint(const MeshGeometry& shape);
std::string complaint(const LoopGeometry& shape);
std::string complaint(const geometry::Primitive& primitive);

/// Checks the nodes of a CSG tree one after the other, from the first.
class CsgNodeCheck {
 public:
  explicit CsgNodeCheck(std::size_t nodes) : used_(nodes, false) {}

  std::string complaint(geometry::CsgTree::Index index, const geometry::CsgTree::Node& node);

 private:
  std::vector<bool> used_;  // as operands
};

}  // namespace icome::world
