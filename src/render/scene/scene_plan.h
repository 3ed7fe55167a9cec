#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

#include "render/model/camera.h"
#include "render/model/render_scene.h"

namespace icome::render {

constexpr int kFullLevel = -1;

/// One object that may appear in a picture. Refers to the scene.
struct PlannedItem {
  const RenderItem* item = nullptr;
  Matrix4 clip_from_buffer = Matrix4::Identity();
  Matrix4 camera_from_buffer = Matrix4::Identity();
  base::Matrix3 direction_from_buffer = base::Matrix3::Identity();  ///< turns normals; not of unit length
  double distance = 0.0;                                            ///< m, from the eye to its middle
  int level = kFullLevel;                                           ///< one of the shape's coarser ones
  bool mirrored = false;                                            ///< fronts are clockwise
};

/// The objects of a scene that a camera may see, in the order of drawing.
struct ScenePlan {
  std::vector<PlannedItem> opaque;   ///< objects drawn alike side by side, near before far
  std::vector<PlannedItem> blended;  ///< seen through, far before near
};

/// The fineness with which shapes are drawn.
struct SceneDetail {
  double height = 0.0;  ///< pixels of the picture; 0: all as fine as they are
  double cell = 0.7;    ///< pixels: smaller cells are not seen
  /// With more triangles, shapes get coarser, up to cells of a few pixels.
  std::size_t most_triangles = std::numeric_limits<std::size_t>::max();
};

ScenePlan plan_scene(const RenderScene& scene, const Camera& camera, const SceneDetail& detail = {});

/// All objects that may throw a shadow into the region that a light's lens (light_camera) covers.
std::vector<PlannedItem> plan_casters(const RenderScene& scene, const Camera& lens,
                                      const SceneDetail& detail = {});

/// The box around all that the camera may see; empty for nothing.
base::Bounds visible_bounds(const RenderScene& scene, const Camera& camera);

/// The matrices of one object, as a camera sees it.
PlannedItem plan_item(const RenderItem& item, const Camera& camera);

/// The variant of the shaders that draws an object: equal for objects that the same one draws.
struct SurfaceKind {
  bool textured = false;
  bool coloured = false;
  bool cut_out = false;
  bool shiny = false;     ///< has highlights of its own
  bool blended = false;   ///< something is seen through it
  bool unlit = false;     ///< shows its colour, whatever the light
  bool built_in = false;  ///< inputs and matrix are those of OpenGL 1, as operands of CSG have

  auto operator<=>(const SurfaceKind&) const = default;
};
SurfaceKind surface_kind(const RenderItem& item);

/// Is something seen through it?
bool is_blended(const RenderItem& item);

/// The colour and opacity that a picture on it, if there is one, is multiplied with: white and 1 where the
/// picture replaces them.
Eigen::Vector4f body_colour(const RenderItem& item);

/// The part of a picture's rectangle; a picture can be drawn in tiles.
struct PictureWindow {
  double left = 0.0, bottom = 0.0, width = 1.0, height = 1.0;  ///< shares of the picture
};

/// The camera that sees just that part.
Camera windowed(const Camera& camera, const PictureWindow& window);

}  // namespace icome::render
