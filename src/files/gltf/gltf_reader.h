#pragma once
#include "files/design.h"
#include "io/memory_budget.h"

namespace icome::files {

/// glTF 2.0, binary or text, with what stands beside it. docs/file-formats.md tells what becomes of what.
base::Result<LoadedDesign> read_gltf(const std::filesystem::path& path, const DesignReadOptions& options,
                                     io::MemoryBudget& memory);

/// The same of bytes that are in memory; `path` is for errors, and for what stands beside.
base::Result<LoadedDesign> read_gltf_bytes(std::string_view bytes, const std::filesystem::path& path,
                                           const DesignReadOptions& options, io::MemoryBudget& memory);

}  // namespace icome::files
