#pragma once
// Are two worlds the same design? For what files keep of one: ids do not count, and numbers may differ by
// what a format rounds.
#include <string>

#include "world/world.h"

namespace icome::files {

/// What has to be the same. Formats that cannot hold something leave it out.
struct Likeness {
  double tolerance = 1e-6;  // of numbers, as a part of the largest of their kind: a shape's vertices, a
                            // frame's axes, its shift
  bool shapes = true;       // their kinds and all that they say; else the bounds and the sharing
  bool touch = true;
  bool scenes = true;
  bool fixtures = true;
  bool texture_names = true;
  bool recipes = true;
  bool scopes = true;  // whether lights are for their group alone
};

/// What is different first, for people; empty when the designs are the same. What no object has (shapes,
/// materials) and no material shows (textures) does not count.
std::string difference(const world::World& one, const world::World& other, const Likeness& likeness = {});

}  // namespace icome::files
