#pragma once
#include <filesystem>

#include "base/result.h"
#include "files/design.h"
#include "io/memory_budget.h"

namespace icome::files {

/// Reads VRML 2.0 (.wrl, .vrml), also packed by gzip (.wrz): the text is scanned here for parts that are left
/// out (vrml_scanner.h), parsed by a process of its own (vrml_process.h) and made into a world
/// (vrml_builder.h). Pictures and inlined files are looked for beside the file. Fails with a sentence.
base::Result<LoadedDesign> read_vrml(const std::filesystem::path& path, const DesignReadOptions& options,
                                     io::MemoryBudget& memory);

}  // namespace icome::files
