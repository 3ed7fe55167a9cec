#pragma once
#include "files/design.h"
#include "io/memory_budget.h"

namespace icome::files {

/// Reads glTF 2.0, binary or text, with the files beside it, as told by docs/file-formats.md.
base::Result<LoadedDesign> read_gltf(const std::filesystem::path& path, const DesignReadOptions& options,
                                     io::MemoryBudget& memory);

/// Reads glTF from bytes in memory; `path` is for errors, and for files beside it.
base::Result<LoadedDesign> read_gltf_bytes(std::string_view bytes, const std::filesystem::path& path,
                                           const DesignReadOptions& options, io::MemoryBudget& memory);

}  // namespace icome::files
