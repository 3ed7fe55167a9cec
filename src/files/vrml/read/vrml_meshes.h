#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "files/findings.h"
#include "files/mesh/mesh_design.h"

namespace icome::files {

/// A file that a design names as a mesh.
struct FoundMesh {
  std::filesystem::path path = {};  // with links resolved
  bool is_public = false;  // came with the design or with a package: errors about it may quote its content
};

/// Finds the mesh file that `url` means in the file `base`.
using FindMesh = std::function<base::Result<FoundMesh>(const std::string& base, const std::string& url)>;

/// The fields of an IcomeMesh, none of them checked.
struct VrmlMeshNode {
  std::string name = {};  // of the shape, for findings
  std::string base = {};  // the file that urls are relative to
  std::vector<std::string> urls = {};
  double unit = 1.0;         // metres per unit of the mesh file
  std::string package = {};  // name of the Debian package with the mesh; or empty
};

/// Reads the mesh files that a design names, each once. Refers to its arguments.
class VrmlMeshes {
 public:
  /// All files together may have `limit` bytes, and so may their content in memory. When the time budget
  /// ends, no more is read.
  VrmlMeshes(const FindMesh& find, std::uint64_t limit, Findings& findings, io::TimeBudget& time_budget,
             io::MemoryBudget& memory)
      : find_(find), left_(limit), findings_(findings), time_budget_(time_budget), memory_(memory) {}

  /// The first of the urls that leads to a mesh; null, with a finding, when none does.
  world::GeometryPointer shape_of(const VrmlMeshNode& node);

 private:
  using Shape = std::shared_ptr<const world::MeshGeometry>;

  base::Result<Shape> fetch(const VrmlMeshNode& node, const std::string& url);
  base::Result<Shape> read(const FoundMesh& file, double unit);

  const FindMesh& find_;
  std::uint64_t left_;  // bytes that may still be taken
  Findings& findings_;
  io::TimeBudget& time_budget_;
  io::MemoryBudget& memory_;
  std::map<std::pair<std::filesystem::path, double>, base::Result<Shape>> known_;
};

}  // namespace icome::files
