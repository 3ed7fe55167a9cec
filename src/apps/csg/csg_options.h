#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "base/result.h"
#include "geometry/csg/csg_normal_form.h"

namespace icome::apps {

/// What a person asked `icome csg` for, as the command line says it.
struct CsgOptions {
  std::filesystem::path file;
  geometry::CsgForm form = geometry::CsgForm::Tree;
  std::size_t max_nodes = geometry::NormaliseOptions{}.max_nodes;  // of the form; beyond it gives up
  std::optional<std::filesystem::path> inside;                     // points to be judged
  std::optional<std::filesystem::path> mesh;                       // STL to be written
  std::optional<double> cell_mm;  // of the mesh's grid; none: kCellsAlong of the longest side
  bool json = false;
};

constexpr double kCellsAlong = 200.0;  // cells along the longest side of the solid

/// Says which option has a value that makes no sense, or which two contradict each other.
base::Result<void> check(const CsgOptions& options);

/// "tree", "normal" or "subnormal".
const char* name(geometry::CsgForm form);

}  // namespace icome::apps
