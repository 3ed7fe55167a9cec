#pragma once
#include <map>
#include <memory>

#include "apps/touch/touch_eye.h"
#include "session/felt/felt_shape.h"
#include "world/world.h"

namespace icome::apps {

/// The eyes of shapes that are felt, each made once for all bodies that share one. In the felt frame.
class DesignEyes {
 public:
  /// Null for a CSG tree that is felt exactly, which needs no triangles to be seen. A shape that cannot be
  /// made triangles has an eye without any.
  const std::shared_ptr<TouchEye>& eye(const world::GeometryPointer& shape,
                                       const session::FeltShapePointer& felt);

 private:
  std::map<const session::FeltShape*, std::shared_ptr<TouchEye>> eyes_;
};

/// The length of the longest side of the box around all bounded objects of a design, m.
double longest_side(const world::World& world);

}  // namespace icome::apps
