#pragma once
#include <string>
#include <vector>

#include "interaction/operations/arguments.h"
#include "world/shape/geometry.h"

namespace icome::interaction {

// Shapes by their names and sizes. What they were made of can be asked of them and made again, so that it
// stays open to change: solids know their sizes, meshes keep theirs as a recipe.

/// `shape`, then all that shapes are made of.
const std::vector<Parameter>& shape_parameters();

/// The shape that arguments held to (more than) shape_parameters() speak of; null for a group, which has
/// none.
base::Result<world::GeometryPointer> make_shape(const Arguments& arguments);

/// `points`, `open`, `steps` and `ends`: what an extrusion is made of.
const std::vector<Parameter>& extrusion_parameters();

/// The sweep of arguments held to these. Fails as geometry::extrude() does.
base::Result<world::GeometryPointer> make_extrusion(const Arguments& arguments);

/// What people should know of a sweep that goes through itself, which is no solid then; empty for others.
/// What only touches itself is no such sweep.
std::string remark_on_sweep(const world::Geometry& sweep);

/// What the shape is made of, in the words that made it. Fails, saying what to do, for one that was bent or
/// put together by hand.
base::Result<Value::Fields> making_of(const world::Geometry& shape);

/// The shape again with `changes` to what it is made of; the rest stays as it was.
base::Result<world::GeometryPointer> remade(const world::World& world, const world::Geometry& shape,
                                            const Value::Fields& changes);

/// The values of these parameters that are for `choice` (all where it is empty), whether said or fallen back
/// to, in the parameters' order.
Value::Fields said_of(const std::vector<Parameter>& parameters, const Arguments& arguments,
                      const std::string& choice);

}  // namespace icome::interaction
