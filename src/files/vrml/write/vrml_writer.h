#pragma once
#include <filesystem>
#include <vector>

#include "base/result.h"
#include "files/remark.h"
#include "world/world.h"

namespace icome::files {

/// Writes a design as VRML 2.0 (docs/file-formats.md describes it); an existing file is replaced when all
/// is written, and stays if not. Pictures are put into a folder beside it, where no other file is changed.
/// Fails when the file cannot be written or could not be read again; remarks on what it could not hold.
base::Result<std::vector<Remark>> write_vrml(const std::filesystem::path& path, const world::World& world);

}  // namespace icome::files
