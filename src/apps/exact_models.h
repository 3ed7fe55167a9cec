#pragma once
#include <string>

#include "apps/touch_models.h"

namespace icome::apps {

// MODELs that are touched without meshing them. Loop and implicit surfaces still get a mesh, for the picture
// and for where the simulated hand looks; a CSG tree gets one only when a picture needs it. A sphere tip
// feels a CSG tree exactly, too, unless its surface at a distance has no closed form; that, and the others,
// it feels as a mesh. The model says so among its sentences.

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

/// The solid where a formula is negative, within a box, by plain evaluation: for those who judge.
base::Result<haptics::MembershipSolid> negative_inside(const std::string& formula, const base::Bounds& box);

/// The surface of --implicit.
base::Result<TouchModel> load_implicit(const TouchOptions& options);

}  // namespace icome::apps
