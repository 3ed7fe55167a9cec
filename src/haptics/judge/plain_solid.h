#pragma once
#include "geometry/csg/csg_tree.h"
#include "geometry/primitive/primitive.h"
#include "haptics/judge/contact_judge.h"

namespace icome::haptics {

// Models evaluated in the plainest way, by none of the code that finds contacts: for the
// judge.

/// Distance from `point` to the surface of a primitive, in its frame (m); negative inside.
double plain_distance(const geometry::Primitive& primitive, const base::Vector3& point);

/// The solid of a CSG tree: primitives by their inequalities, polyhedra by winding numbers, put together by
/// the operations of the tree. Keeps a copy of the tree's primitives, and shares its custom ones. Copies
/// share the cubes that space was divided into for `nearest`: one thread at a time.
MembershipSolid plain_solid(const geometry::CsgTree& tree);

}  // namespace icome::haptics
