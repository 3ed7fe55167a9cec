#pragma once
#include "base/result.h"
#include "files/new_file.h"
#include "geometry/triangle_mesh.h"

namespace icome::files {

/// Writes the mesh as binary STL, which has no unit of its own: `unit` is metres per file unit; 0.001, the
/// millimetre, is what most programs take it for. Coordinates become single precision. Does not finish the
/// file. Fails when there are more triangles than STL can count, or coordinates that single precision does
/// not hold.
base::Result<void> write_stl(const geometry::TriangleMesh& mesh, double unit, NewFile& file);

}  // namespace icome::files
