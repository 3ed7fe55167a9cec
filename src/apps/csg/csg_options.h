#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "base/result.h"
#include "geometry/csg/csg_normal_form.h"

namespace icome::apps {

/// The options of `icome csg`, as the command line gives them.
struct CsgOptions {
  std::filesystem::path file;
  geometry::CsgForm form = geometry::CsgForm::Tree;
  std::size_t max_nodes = geometry::NormaliseOptions{}.max_nodes;  // of the form; more are an error
  std::optional<std::filesystem::path> inside;                     // points to be judged
  std::optional<std::filesystem::path> mesh;                       // STL to be written
  std::optional<double> cell_mm;  // of the mesh's grid; none: kCellsAlong of the longest side
  bool json = false;
};

constexpr double kCellsAlong = 200.0;  // cells along the longest side of the solid

/// Fails, naming the option whose value makes no sense, or the two that contradict each other.
base::Result<void> check(const CsgOptions& options);

/// "tree", "normal" or "subnormal".
const char* name(geometry::CsgForm form);

}  // namespace icome::apps
