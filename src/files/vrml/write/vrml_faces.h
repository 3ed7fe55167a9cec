#pragma once
#include <string_view>

#include "files/vrml/write/vrml_text.h"
#include "world/shape/mesh_geometry.h"

namespace icome::files {

/// The look in other programs where corner normals do not decide it: edges between faces at less than this
/// angle (rad) look smooth.
enum class VrmlEdges { Smooth, SharpWhereBent };

/// Writes the coordinates and faces of a mesh, and whether it is closed: fields of an IndexedFaceSet or of
/// a PROTO that shows one. `mesh` passes geometry_check.h.
void write_coordinates(const geometry::TriangleMesh& mesh, VrmlText& text);
void write_crease_angle(VrmlEdges edges, VrmlText& text);

/// Writes a mesh as an IndexedFaceSet; `head` is the text before its brace.
void write_faces(const world::MeshGeometry& shape, std::string_view head, VrmlText& text);

}  // namespace icome::files
