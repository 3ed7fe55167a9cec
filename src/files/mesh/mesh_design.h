#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "files/design.h"
#include "io/memory_budget.h"
#include "io/time_budget.h"
#include "world/shape/mesh_geometry.h"

namespace icome::files {

/// The triangles of a mesh file as a shape of a world.
struct MeshShape {
  std::shared_ptr<const world::MeshGeometry> shape = nullptr;
  std::string format = {};                // for people: "binary PLY, xz" and so on
  std::vector<std::string> remarks = {};  // sentences on what was left out or repaired
};

/// Reads a file of any type of mesh_formats.h; `unit` is metres per unit of the file. The time budget gets
/// the progress; when it ends, so does the reading, soon: "interrupted".
base::Result<MeshShape> read_mesh_shape(const std::filesystem::path& path, double unit,
                                        std::uint64_t size_limit, io::TimeBudget& time_budget,
                                        io::MemoryBudget& memory);

/// PLY, STL and OFF, also packed: a design of one object, named after the file.
base::Result<LoadedDesign> read_mesh_design(const std::filesystem::path& path,
                                            const DesignReadOptions& options, io::MemoryBudget& memory);

/// OpenSCAD's .csg, also packed: a design of one solid. Millimetres become metres.
base::Result<LoadedDesign> read_csg_design(const std::filesystem::path& path,
                                           const DesignReadOptions& options, io::MemoryBudget& memory);

}  // namespace icome::files
