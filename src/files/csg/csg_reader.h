#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "geometry/csg/csg_tree.h"
#include "io/memory_budget.h"

namespace icome::files {

/// Limits and callbacks for reading a .csg file; guards against files made to exhaust memory.
struct CsgReadOptions {
  std::uint64_t size_limit = 256ULL << 20U;        ///< bytes, packed and unpacked, below 4 GiB
  std::size_t max_primitives = 1'000'000;          ///< about half a kilobyte each
  std::function<bool(double part)> progress = {};  ///< called now and then with [0, 1]; false stops
  io::MemoryBudget* memory = nullptr;  ///< bounds unpacking and primitives; null: that of the file
};

/// The CSG tree of a .csg file, in metres, with at least one primitive.
struct LoadedCsg {
  geometry::CsgTree tree;
  std::vector<std::string> notes;  ///< what was left out or repaired, one sentence each
  double read_seconds = 0.0;       ///< opening, unpacking, parsing and building
};

/// Reads a .csg file as OpenSCAD writes it, also packed as `.xz`: cube, sphere, cylinder, polyhedron,
/// multmatrix, color, group, union, intersection, difference and render, with OpenSCAD's meaning. Lengths are
/// millimetres in the file and metres in the tree. sphere and cylinder are truly round, but with $fn from 3
/// to 16 they are the faceted solids of OpenSCAD. An operation on several children becomes a chain that
/// begins on the left; children without volume take part as the empty solid. Parts marked `*` (disabled) or
/// `%` (background) are left out, and where a part is marked `!` only the first such part counts. Leaves
/// carry their whole transform, and the outermost colour around them.
///
/// Fails with one sentence that names the file, line and column, and says what was expected, when the text is
/// malformed; when it uses things without an exact form (hull, minkowski, extrusions, 2D shapes, text, import
/// and so on) or an unknown name; when a polyhedron is open or not manifold; when a matrix is not affine;
/// when sizes are below 1e-6 mm or coordinates beyond 1e9 mm; when nothing with a volume is left; and when it
/// is stopped: "interrupted".
base::Result<LoadedCsg> read_csg(const std::filesystem::path& path, const CsgReadOptions& options = {});

/// Reads a .csg text from memory; `name` stands for the file in errors.
base::Result<LoadedCsg> parse_csg(std::string_view text, const std::string& name,
                                  const CsgReadOptions& options = {});

}  // namespace icome::files
