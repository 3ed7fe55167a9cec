#pragma once
#include <map>
#include <memory>
#include <string>

#include "geometry/triangle_tree.h"
#include "haptics/smooth_shape.h"
#include "session/felt_shape.h"
#include "world/world.h"

namespace icome::apps {

/// What the eye sees of shapes that are felt: for pictures, and for where the simulated hand looks. Made once
/// for all bodies that share one. In the felt frame.
class DesignEyes {
 public:
  struct Eye {
    std::shared_ptr<const geometry::TriangleMesh> mesh;  // empty where the shape has no triangles
    std::shared_ptr<const geometry::TriangleTree> tree;
    std::shared_ptr<const haptics::SmoothShape> solid = nullptr;  // a CSG tree's, instead of these two
    std::string problem = {};                                     // a sentence, where there are none
  };

  const Eye& eye(const world::Geometry& shape, const session::FeltShapePointer& felt);

 private:
  std::map<session::FeltShapePointer, Eye> eyes_;
};

/// The length of the longest side of the box around all objects of a design that have an end, m.
double longest_side(const world::World& world);

}  // namespace icome::apps
