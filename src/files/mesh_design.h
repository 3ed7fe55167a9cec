#pragma once
#include "files/design.h"

namespace icome::files {

/// PLY, STL and OFF, also packed: a design of one object, named after the file.
base::Result<LoadedDesign> read_mesh_design(const std::filesystem::path& path,
                                            const DesignReadOptions& options);

/// OpenSCAD's .csg, also packed: a design of one solid. Millimetres become metres.
base::Result<LoadedDesign> read_csg_design(const std::filesystem::path& path,
                                           const DesignReadOptions& options);

}  // namespace icome::files
