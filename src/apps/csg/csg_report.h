#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/csg/csg_normal_form.h"
#include "geometry/csg/csg_tree.h"

namespace icome::apps {

/// The figures of a solid that `icome csg` reports. SI units.
struct CsgFigures {
  std::string file;
  std::vector<std::string> notes;  // on what the reader left out or repaired
  geometry::CsgCount counted;      // of the tree as it was read
  double read_seconds = 0.0;

  geometry::CsgForm form = geometry::CsgForm::Tree;
  geometry::CsgCount form_counted;
  std::size_t pruned = 0;    // nodes
  std::size_t products = 0;  // operands of the union at the top of the form
  double form_seconds = 0.0;
  geometry::Bounds bounds;  // empty for an empty solid

  struct Mesh {
    std::filesystem::path file;
    std::size_t triangles = 0;
    double cell = 0.0;   // m
    double error = 0.0;  // m
  };
  std::optional<Mesh> mesh;
  std::optional<std::vector<std::uint8_t>> inside;  // 0 or 1 for each point
};

/// The number of operands of the chain of unions at the top of the tree; 0 for an empty tree.
std::size_t count_products(const geometry::CsgTree& tree);

/// "part.stl: 12,345 triangles, at most 4 um off the surface, cells of 250 um".
std::string mesh_text(const CsgFigures::Mesh& mesh);

/// The figures as a JSON object: the names are a contract with scripts (see the help).
std::string json_report(const CsgFigures& figures);

/// The figures as a table for a person.
std::string text_report(const CsgFigures& figures);

}  // namespace icome::apps
