#pragma once
#include "files/design.h"
#include "io/memory_budget.h"

namespace icome::files {

// SVG files as designs: one object, a drawing on its sheet of paper (drawing::DrawingShape).

base::Result<LoadedDesign> read_svg_design(const std::filesystem::path& path,
                                           const DesignReadOptions& options, io::MemoryBudget& memory);

/// Writes the drawing of the design. Fails for designs with none or with several.
base::Result<std::vector<Remark>> write_svg_design(const std::filesystem::path& path,
                                                   const world::World& world);

}  // namespace icome::files
