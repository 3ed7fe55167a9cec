#pragma once
#include <string>

#include "apps/touch/touch_models.h"
#include "geometry/implicit/implicit_surface.h"
#include "geometry/loop/loop_surface.h"

namespace icome::apps {

// What options make of MODELs that is touched without meshing it; a mesh is made only when a picture needs
// it. A sphere tip feels them exactly, too, unless there is no exact surface for its centre: then it feels a
// mesh. The model says so among its sentences.

/// A mesh of a CSG tree for the eye. Fails as geometry::contour does.
base::Result<geometry::TriangleMesh> picture_mesh(const geometry::CsgTree& tree);

/// Has a primitive or CSG tree of the model touched as the thesis does; fails for all else.
base::Result<void> render_as_thesis(const TouchModel& model, TouchBody& body, const TouchOptions& options);

/// Takes a mesh of the model for a control mesh: what is touched then is the limit, or as the thesis does.
base::Result<void> subdivide(TouchModel& model, TouchBody& control, const TouchOptions& options);

/// The solid of an implicit surface, by plain evaluation of its formula: for those who judge.
base::Result<haptics::MembershipSolid> negative_inside(const std::string& formula,
                                                       const geometry::ImplicitSurface& surface);

/// A mesh of the limit of a control mesh, for those who judge.
base::Result<JudgedMesh> judged_limit(const geometry::ControlMesh& control);

/// The surface of --implicit.
base::Result<TouchModel> load_implicit(const TouchOptions& options);

}  // namespace icome::apps
