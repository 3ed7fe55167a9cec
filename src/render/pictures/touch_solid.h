#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "render/csg/csg_geometry.h"
#include "render/gl/offscreen.h"
#include "render/model/camera.h"
#include "render/pictures/studio.h"
#include "render/pictures/touch_picture.h"

namespace icome::render {

/// A solid of a touch picture on its way into the studio, as images of its operands or as a mesh. Owns the
/// data it is drawn from; refers to the solid that it was made of.
class PreparedSolid {
 public:
  /// Fails when the solid can only be drawn as a mesh and none can be had.
  static base::Result<PreparedSolid> prepare(const TouchSolid& solid);

  /// Points all over it, to frame a view; world frame, metres.
  std::vector<base::Vector3> points() const;

  /// Adds it to the scene, which must not outlive it, and says how. Takes the mesh where images would take
  /// too long or the driver cannot make them. Fails when there is no mesh then.
  base::Result<void> place(StudioScene& scene, const Offscreen& context, const Camera& camera, double pixels,
                           const std::function<void(const std::string&)>& tell);

 private:
  explicit PreparedSolid(const TouchSolid& solid) : solid_(solid) {}
  base::Result<void> take_mesh(const std::string& reason);

  std::reference_wrapper<const TouchSolid> solid_;
  std::optional<CsgGeometry> geometry_;
  std::optional<geometry::TriangleMesh> mesh_;  // drawn instead where there is one
  std::string reason_;                          // for the mesh
};

base::Result<std::vector<PreparedSolid>> prepare_solids(const std::vector<TouchSolid>& solids);

}  // namespace icome::render
