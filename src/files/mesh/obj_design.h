#pragma once
#include "files/design.h"
#include "io/memory_budget.h"

namespace icome::files {

/// Wavefront OBJ, also packed, with the materials and pictures beside it. Each object or group becomes an
/// object; one in several materials gets a child for each.
base::Result<LoadedDesign> read_obj_design(const std::filesystem::path& path,
                                           const DesignReadOptions& options, io::MemoryBudget& memory);

/// Writes all objects at their places in the world, materials into a library beside, pictures into a
/// folder beside. The file itself takes its place last.
base::Result<std::vector<Remark>> write_obj_design(const std::filesystem::path& path,
                                                   const world::World& world);

}  // namespace icome::files
