#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/mesh_repair.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::files {

/// Unit, size and limits for reading a mesh file. Mesh formats do not name their unit, so the person who
/// opens the file gives it.
struct ReadOptions {
  double unit = 1.0;                               ///< metres per file unit, > 0; usually 1, 0.01 or 0.001
  std::optional<double> fit = {};                  ///< scale so that the longest side is this, m; usually 0.1
  std::uint64_t size_limit = 2ULL << 30U;          ///< bytes, packed and unpacked; guards against xz bombs
  std::optional<std::uint64_t> memory_limit = {};  ///< bytes that reading may take; none: MemoryBudget's
};

/// A mesh read by read_mesh(), in metres, repaired, with at least one triangle.
struct LoadedMesh {
  geometry::TriangleMesh mesh;
  geometry::RepairReport repair;
  std::string format;              ///< for people: "OBJ", "binary PLY", "ascii STL, xz" and so on
  std::vector<std::string> notes;  ///< losses in the reader itself, one sentence each
  double read_seconds = 0.0;       ///< opening, unpacking and parsing
  double repair_seconds = 0.0;

  /// The notes, then the findings of the repair: all that a person should know about this file.
  std::vector<std::string> sentences() const;
};

/// Reads the triangles alone of OBJ, PLY (ascii, binary), STL (ascii, binary), OFF or GLB, each also packed
/// as xz, in the file's own axes: for touching them without a world; read_design() reads whole designs. The
/// type follows from the name's extension in any case, the variant from the content. Polygons are cut into
/// triangles, points and lines left out, and the mesh repaired (geometry::repair).
///
/// Fails with one sentence that names the file, and the line in text formats, when the file cannot be
/// opened, does not match its name, is cut short or malformed, refers to missing vertices, has coordinates
/// above 1e15 m, exceeds the size limit, or leaves no triangle with an area.
base::Result<LoadedMesh> read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// Metres per unit for "m", "dm", "cm", "mm", "um" or "in". The error lists these names.
base::Result<double> parse_unit(std::string_view name);

}  // namespace icome::files
