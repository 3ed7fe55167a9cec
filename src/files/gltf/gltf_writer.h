#pragma once
#include <filesystem>
#include <vector>

#include "base/result.h"
#include "files/remark.h"
#include "world/world.h"

namespace icome::files {

/// Writes a design as glTF 2.0, binary for names that end in .glb, else text that holds its own data.
/// docs/file-formats.md tells what becomes of what. What was there is replaced when all is written.
base::Result<std::vector<Remark>> write_gltf(const std::filesystem::path& path, const world::World& world);

}  // namespace icome::files
