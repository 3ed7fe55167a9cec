#pragma once
#include <vector>

#include "base/result.h"
#include "base/vector.h"
#include "charts/colour.h"
#include "charts/image.h"
#include "geometry/mesh/triangle_mesh.h"
#include "render/csg/csg_geometry.h"
#include "render/gl/offscreen.h"
#include "render/model/camera.h"

namespace icome::render {

/// One mesh in a picture; refers to a mesh that must outlive the call.
struct StudioBody {
  const geometry::TriangleMesh& mesh;  ///< metres, its own frame
  base::Pose world_from_mesh = base::Pose::Identity();
  charts::Colour colour{0.80, 0.79, 0.77};
};

/// One CSG solid in a picture, drawn from images of its operands; refers to data that must outlive the call.
struct StudioSolid {
  const CsgGeometry& geometry;  ///< metres, the tree's own frame
  base::Pose world_from_tree = base::Pose::Identity();
  charts::Colour colour{0.80, 0.79, 0.77};  ///< of operands that have none of their own
};

/// The contents of the studio.
struct StudioScene {
  std::vector<StudioBody> bodies;
  std::vector<StudioSolid> solids;
};

struct StudioSettings {
  int width = 1600;                     ///< pixels, 1 ... 16384
  int height = 800;                     ///< pixels, 1 ... 16384
  base::Vector3 up{0.0, 1.0, 0.0};      ///< world direction the sky light comes from
  base::Vector3 centre{0.0, 0.0, 0.0};  ///< m, middle of a ball that holds all bodies
  double radius = 1.0;                  ///< m, its radius, > 0
  double floor = -1.0;                  ///< m along `up` from `centre`: where the shadow falls
  /// rad, sharper bends are drawn as edges; 0 ... pi. Meshes of more than 20,000 triangles are smoothed up
  /// to 2.2 rad at least: the rims of scans are full of sharp bends that are no edges.
  double crease_angle = 0.9;
  int passes = 0;                                 ///< samples a pixel, four lights each; 4 ... 64, 0 chooses
  int shadow_side = 0;                            ///< texels along a shadow map; 64 ... 4096, 0 chooses
  charts::Colour background{1.0, 1.0, 1.0};       ///< in the middle of the picture
  charts::Colour background_edge{1.0, 1.0, 1.0};  ///< in its corners
};

/// Result of the studio: a picture, and the distance from the eye of the surface in each pixel.
struct StudioPicture {
  charts::Image image;          ///< opaque
  std::vector<float> distance;  ///< m along the view axis, row by row from the top; infinite for nothing
};

/// Draws bodies the way a product is photographed: soft key light from the upper left, light from all of
/// a sky, the shadows of both on an invisible floor. Several passes, each with a few lights, their shadow
/// maps and a shift of less than a pixel, are averaged in linear light (the accumulation buffer of Haeberli
/// and Akeley 1990): that gives soft shadow, ambient occlusion and smooth edges at once. The context must be
/// current. Fails when the driver refuses the size or a shader, or, if there are solids, when it offers no
/// compatibility context.
base::Result<StudioPicture> draw_studio(const Offscreen& context, const StudioScene& scene,
                                        const Camera& camera, const StudioSettings& settings);

}  // namespace icome::render
