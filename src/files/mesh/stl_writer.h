#pragma once
#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"
#include "io/new_file.h"

namespace icome::files {

/// Writes the mesh as binary STL, which has no unit of its own: `unit` is metres per file unit; most
/// programs assume 0.001, the millimetre. Coordinates become single precision. Does not finish the file.
/// Fails when there are more triangles than STL can count, or coordinates that single precision does not
/// hold.
base::Result<void> write_stl(const geometry::TriangleMesh& mesh, double unit, io::NewFile& file);

}  // namespace icome::files
