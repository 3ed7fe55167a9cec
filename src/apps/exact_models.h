#pragma once
#include <string>

#include "apps/touch_models.h"
#include "geometry/implicit_surface.h"
#include "geometry/loop_surface.h"

namespace icome::apps {

// MODELs that are touched without meshing them; a mesh is made only when a picture needs it. A sphere tip
// feels them exactly, too, unless there is no exact surface for its centre: then it feels a mesh. The model
// says so among its sentences.

/// Does the MODEL name an OpenSCAD file?
bool names_csg(const std::string& text);

/// Reads a .csg file, always in its millimetres, turned and scaled as the options say.
base::Result<TouchModel> load_csg(const std::string& text, const TouchOptions& options);

/// A mesh of a CSG tree for the eye. Fails as geometry::contour does.
base::Result<geometry::TriangleMesh> picture_mesh(const geometry::CsgTree& tree);

/// A primitive as a CSG tree of one leaf, as the renderer of the thesis takes it.
base::Result<TouchModel> as_csg(TouchModel primitive, const TouchOptions& options);

/// Makes the limit of a control mesh, just read, of its file's mesh.
base::Result<TouchModel> as_loop_surface(TouchModel control, const TouchOptions& options);

/// The solid of an implicit surface, by plain evaluation of its formula: for those who judge.
base::Result<haptics::MembershipSolid> negative_inside(const std::string& formula,
                                                       const geometry::ImplicitSurface& surface);

/// A mesh of the limit of a control mesh, for those who judge.
base::Result<JudgedMesh> judged_limit(const geometry::ControlMesh& control);

/// The surface of --implicit.
base::Result<TouchModel> load_implicit(const TouchOptions& options);

}  // namespace icome::apps
