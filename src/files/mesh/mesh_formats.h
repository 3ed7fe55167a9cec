#pragma once
// The parsers behind read_mesh() and read_design(): bytes in, triangles out, in the file's own unit and axes.
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"
#include "io/memory_budget.h"
#include "io/time_budget.h"

namespace icome::files {

/// The content of a mesh file, not yet repaired: indices are in range, coordinates may be anything.
struct ParsedMesh {
  geometry::TriangleMesh mesh;
  std::string format;                              ///< for people, such as "binary STL"
  std::vector<std::string> notes;                  ///< what was left out
  std::vector<std::array<float, 3>> colours = {};  ///< of the vertices, in [0, 1], or none
};

/// Coordinates further out than this, m, are a mistake, and their products lose all meaning.
inline constexpr double kFarthest = 1e15;

/// Share of reading and parsing in the work of opening a mesh file.
inline constexpr double kParsedPart = 0.8;

/// Reads a file of any type below, also packed as `.xz`, by the ending of its name. When the time
/// budget ends, so does the reading, soon: "interrupted". It takes the first kParsedPart of the work
/// in the time budget.
base::Result<ParsedMesh> parse_mesh_file(const std::filesystem::path& path, std::uint64_t size_limit,
                                         io::TimeBudget& time_budget, io::MemoryBudget& memory);

// Each takes the whole file and the name for errors. Memory is bounded by the bytes that are there, never by
// a count that they declare. Errors: one sentence, with the line in text formats. TimeBudget (may be null)
// gets the progress; when it ends they fail, or the result is incomplete.

/// Wavefront OBJ: `v` and `f` lines, negative indices, continued lines; everything else is left out.
base::Result<ParsedMesh> parse_obj(std::string_view bytes, const std::string& name,
                                   io::TimeBudget* time_budget = nullptr);

/// PLY 1.0, ascii or binary of either byte order: x, y, z of `vertex`, the index lists of `face` and
/// `tristrips`.
base::Result<ParsedMesh> parse_ply(std::string_view bytes, const std::string& name,
                                   io::TimeBudget* time_budget = nullptr);

/// STL. Binary when the size fits a binary file's count, whatever word the file begins with.
base::Result<ParsedMesh> parse_stl(std::string_view bytes, const std::string& name,
                                   io::TimeBudget* time_budget = nullptr);

/// OFF, ascii or binary, also with normals, colours or texture coordinates, which are left out.
base::Result<ParsedMesh> parse_off(std::string_view bytes, const std::string& name,
                                   io::TimeBudget* time_budget = nullptr);

/// Binary glTF 2.0 that holds its own buffers: the triangles of all nodes, in the scene's frame.
base::Result<ParsedMesh> parse_glb(std::string_view bytes, const std::string& name,
                                   io::TimeBudget* time_budget = nullptr);

}  // namespace icome::files
