#pragma once
// The parsers behind read_mesh() and read_design(): bytes in, triangles out, in the file's own unit and axes.
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "geometry/triangle_mesh.h"

namespace icome::files {

/// What a file's bytes say, not yet repaired: indices are in range, coordinates may be anything.
struct ParsedMesh {
  geometry::TriangleMesh mesh;
  std::string format;                              ///< for people, such as "binary STL"
  std::vector<std::string> notes;                  ///< what was left out
  std::vector<std::array<float, 3>> colours = {};  ///< of the vertices, in [0, 1], or none
};

/// Coordinates further out than this are a mistake, and their products lose all meaning, m.
inline constexpr double kFarthest = 1e15;

/// Reads a file of any type below, also packed as `.xz`, by the ending of its name.
base::Result<ParsedMesh> parse_mesh_file(const std::filesystem::path& path, std::uint64_t size_limit);

// Each takes the whole file and the name to use in errors. Memory taken is bounded by the bytes that
// are there, never by a count that they declare. Errors: one sentence, with the line in text formats.

/// Wavefront OBJ: `v` and `f` lines, negative indices, continued lines; everything else is left out.
base::Result<ParsedMesh> parse_obj(std::string_view bytes, const std::string& name);

/// PLY 1.0, ascii or binary of either byte order: x, y, z of `vertex`, the index list of `face`.
base::Result<ParsedMesh> parse_ply(std::string_view bytes, const std::string& name);

/// STL. Binary when the size is what a binary file's count says, whatever word the file begins with.
base::Result<ParsedMesh> parse_stl(std::string_view bytes, const std::string& name);

/// Ascii OFF, also with normals, colours or texture coordinates, which are left out.
base::Result<ParsedMesh> parse_off(std::string_view bytes, const std::string& name);

/// Binary glTF 2.0 that holds its own buffers: the triangles of all nodes, in the scene's frame.
base::Result<ParsedMesh> parse_glb(std::string_view bytes, const std::string& name);

}  // namespace icome::files
