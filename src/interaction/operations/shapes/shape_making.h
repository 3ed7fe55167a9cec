#pragma once
#include <string>
#include <vector>

#include "interaction/operations/arguments.h"
#include "world/shape/geometry.h"

namespace icome::interaction {

// Shapes by their names and sizes. The parameters of a shape can be read back and changed later: solids
// know their sizes, meshes keep theirs as a recipe.

/// `shape`, then the parameters of all kinds of shapes.
const std::vector<Parameter>& shape_parameters();

/// The shape that arguments describe which were checked against (more than) shape_parameters(); null for
/// a group, which has none.
base::Result<world::GeometryPointer> make_shape(const Arguments& arguments);

/// `points`, `places`, `open`, `steps` and `ends`: the parameters of an extrusion.
const std::vector<Parameter>& extrusion_parameters();

/// The sweep of arguments checked against these. Fails as geometry::extrude() does.
base::Result<world::GeometryPointer> make_extrusion(const Arguments& arguments);

/// Likewise of a profile with holes, the rim of which is the arguments' `points`: a shape without a recipe.
base::Result<world::GeometryPointer> make_extrusion_with_holes(const Arguments& arguments,
                                                               std::vector<std::vector<Vector2>> holes);

/// The remark on a sweep that goes through itself, which is no solid then, or that is too intricate to be
/// tested; empty for others, such as one that only touches itself.
std::string remark_on_sweep(const world::Geometry& sweep);

/// The parameters that the shape was made with. Fails, saying what to do, for one that was bent or put
/// together by hand.
base::Result<Value::Fields> making_of(const world::Geometry& shape);

/// The shape made again with `changes` to its parameters; the others stay as they were.
base::Result<world::GeometryPointer> remade(const world::World& world, const world::Geometry& shape,
                                            const Value::Fields& changes);

/// The values, given or fallbacks, of those parameters that are for `choice` (all where it is empty), in the
/// parameters' order.
Value::Fields said_of(const std::vector<Parameter>& parameters, const Arguments& arguments,
                      const std::string& choice);

}  // namespace icome::interaction
