#pragma once
#include <filesystem>
#include <vector>

#include "base/result.h"
#include "files/remark.h"
#include "world/world.h"

namespace icome::files {

/// Writes a design as glTF 2.0, binary for names that end in .glb, else text that contains its own
/// data. docs/file-formats.md tells the mapping. An existing file is replaced when all is written.
base::Result<std::vector<Remark>> write_gltf(const std::filesystem::path& path, const world::World& world);

}  // namespace icome::files
