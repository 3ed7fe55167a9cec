#pragma once
#include <filesystem>
#include <vector>

#include "base/result.h"
#include "files/design.h"

namespace icome::files {

/// Reads a design by the ending of its name: VRML 2.0 (.wrl, .vrml), glTF 2.0 (.glb, .gltf), OBJ, PLY, STL,
/// OFF (also packed as .xz), OpenSCAD's .csg and ICOME's own .icome. Fails with one sentence that names the
/// file (and the line in text formats) when it cannot be read at all.
base::Result<LoadedDesign> read_design(const std::filesystem::path& path,
                                       const DesignReadOptions& options = {});

/// Fails where write_design() does not know the format, naming those that it knows.
base::Result<void> check_can_write(const std::filesystem::path& path);

/// Writes a design by the ending of the name, as above without .xz and .csg; an old file is replaced when all
/// is written, and stays if not; .stl has z up, as is its custom. Tells what the format cannot hold.
base::Result<std::vector<Remark>> write_design(const std::filesystem::path& path, const world::World& world);

}  // namespace icome::files
