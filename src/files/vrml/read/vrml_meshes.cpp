#include "files/vrml/read/vrml_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace icome::files {
namespace {

constexpr std::size_t kMostMeshUrls = 20;  // tried for a mesh
constexpr std::size_t kMostFiles = 1000;   // of a design
constexpr std::size_t kLongestName = 100;  // of a package
constexpr double kSmallestUnit = 1e-9, kLargestUnit = 1e6;

/// Is it a possible name of a package? A design may contain anything; other names are not repeated.
bool is_package_name(const std::string& name) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789+-.";
  return !name.empty() && name.size() <= kLongestName && kLetters.substr(0, 36).find(name[0]) < 36 &&
         name.find_first_not_of(kLetters) == std::string::npos;
}

std::uint64_t bytes_of(const world::MeshGeometry& shape) {
  return shape.mesh.positions.size() * sizeof(shape.mesh.positions[0]) +
         shape.mesh.triangles.size() * sizeof(shape.mesh.triangles[0]) +
         shape.colours.size() * sizeof(shape.colours[0]);
}

}  // namespace

world::GeometryPointer VrmlMeshes::shape_of(const VrmlMeshNode& node) {
  std::string why = "it has no url";
  if (!std::isfinite(node.unit) || node.unit < kSmallestUnit || node.unit > kLargestUnit) {
    why = fmt::format("its unit is not from {:g} to {:g} metres", kSmallestUnit, kLargestUnit);
  } else {
    for (std::size_t i = 0; i < node.urls.size() && i < kMostMeshUrls; ++i) {
      auto shape = fetch(node, node.urls[i]);
      if (shape) return *shape;
      // The message for the first url is most likely about the file that its author meant.
      if (i == 0) why = std::move(shape.error().message);
    }
  }
  if (is_package_name(node.package))
    why += fmt::format("; it comes with the Debian package {}, as the design says", node.package);
  findings_.tell(fmt::format("The mesh {} is left out: {}.", quoted_name(node.name), why));
  return nullptr;
}

base::Result<VrmlMeshes::Shape> VrmlMeshes::fetch(const VrmlMeshNode& node, const std::string& url) {
  const auto file = find_(node.base, url);
  if (!file) return tl::unexpected(file.error());
  const std::pair key(file->path, node.unit);
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  if (known_.size() >= kMostFiles)
    return base::fail(fmt::format("only {} mesh files of a design are read", kMostFiles));
  return known_.emplace(key, read(*file, node.unit)).first->second;
}

base::Result<VrmlMeshes::Shape> VrmlMeshes::read(const FoundMesh& file, double unit) {
  const std::string name = file.path.string();
  // The progress of a mesh is not that of the design: only the end of the budget is passed on.
  io::TimeBudget time_budget([this](double) { return time_budget_.lasts_now(); });
  auto mesh = read_mesh_shape(file.path, unit, left_, time_budget, memory_);
  // The error would repeat parts of the file, which may be someone else's.
  if (!mesh && !file.is_public) return base::fail(name + ": is not a mesh that can be read");
  if (!mesh) return tl::unexpected(mesh.error());
  if (mesh->shape->mesh.triangles.empty()) return base::fail(name + ": has no triangles");
  const std::uint64_t size = bytes_of(*mesh->shape);
  if (size > left_) return base::fail("the meshes of the file are too large together");
  left_ -= size;
  for (const std::string& remark : mesh->remarks) findings_.tell(fmt::format("{}: {}", name, remark));
  return std::move(mesh->shape);
}

}  // namespace icome::files
