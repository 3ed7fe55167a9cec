#include "apps/csg/csg_options.h"

#include <fmt/format.h>

namespace icome::apps {

base::Result<void> check(const CsgOptions& options) {
  constexpr double kLeastCell = 1e-6;  // mm
  constexpr double kMostCell = 1e9;
  if (options.cell_mm && !(*options.cell_mm >= kLeastCell && *options.cell_mm <= kMostCell)) {
    return base::fail(fmt::format("--cell {} makes no sense: choose a value from {:g} to {:g} mm.",
                                  *options.cell_mm, kLeastCell, kMostCell));
  }
  constexpr std::size_t kMostNodes = 1'000'000'000;
  if (options.max_nodes < 1 || options.max_nodes > kMostNodes) {
    return base::fail(fmt::format("--max-nodes {} makes no sense: choose a value from 1 to {}.",
                                  options.max_nodes, kMostNodes));
  }
  if (options.cell_mm && !options.mesh)
    return base::fail("--cell is for a mesh: give --mesh OUT.stl as well.");
  if (options.mesh && (*options.mesh == options.file || options.mesh == options.inside))
    return base::fail("--mesh names a file that is read: the mesh would replace it.");
  return {};
}

const char* name(geometry::CsgForm form) {
  switch (form) {
    case geometry::CsgForm::Tree:
      return "tree";
    case geometry::CsgForm::Normal:
      return "normal";
    case geometry::CsgForm::Subnormal:
      return "subnormal";
  }
  return "";
}

}  // namespace icome::apps
