#pragma once
#include <string>

#include "apps/touch/touch_models.h"
#include "geometry/implicit/implicit_surface.h"
#include "geometry/loop/loop_surface.h"

namespace icome::apps {

// Surfaces that options make of MODELs, touched without a mesh; one is made only where it is needed, as for a
// picture. A sphere tip feels them exactly, too, unless there is no exact surface for its centre: then it
// feels a mesh, and the model says so among its sentences.

/// A mesh of a CSG tree for pictures. Fails as geometry::contour does.
base::Result<geometry::TriangleMesh> picture_mesh(const geometry::CsgTree& tree);

/// Has a primitive or CSG tree of the model touched by the thesis's renderer; fails for all else.
base::Result<void> render_as_thesis(const TouchModel& model, TouchBody& body, const TouchOptions& options);

/// Takes a mesh of the model as a control mesh: its limit is touched, or levels as in the thesis.
base::Result<void> subdivide(TouchModel& model, TouchBody& control, const TouchOptions& options);

/// The solid of an implicit surface, by plain evaluation of its formula: for the judge.
base::Result<haptics::MembershipSolid> negative_inside(const std::string& formula,
                                                       const geometry::ImplicitSurface& surface);

/// A mesh of the limit of a control mesh, for the judge.
base::Result<JudgedMesh> judged_limit(const geometry::ControlMesh& control);

/// Loads the surface of --implicit.
base::Result<TouchModel> load_implicit(const TouchOptions& options);

}  // namespace icome::apps
