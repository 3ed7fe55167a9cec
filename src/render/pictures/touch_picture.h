#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vector.h"
#include "charts/image.h"
#include "geometry/csg/csg_tree.h"
#include "geometry/mesh/triangle_mesh.h"
#include "render/pictures/studio.h"

namespace icome::render {

/// One tick of a touch session; world frame, SI units.
struct TouchSample {
  double t;             ///< s
  base::Vector3 tip;    ///< m, the device's tip
  base::Vector3 scp;    ///< m, the surface contact point; counts only while touching
  base::Vector3 force;  ///< N
  bool touching;
};

/// A CSG solid in a picture; refers to a tree that must outlive the drawing. It is drawn from images of its
/// operands where that can be done in reasonable time, and else as a mesh.
struct TouchSolid {
  const geometry::CsgTree& tree;  ///< metres, its own frame
  std::string name;               ///< for messages
  base::Pose world_from_tree = base::Pose::Identity();
  charts::Colour colour{0.80, 0.79, 0.77};  ///< of operands that have none of their own
  /// Makes a mesh of the surface, in the tree's frame. Called at most once, and only when a mesh is needed;
  /// without it such a solid cannot be drawn.
  std::function<base::Result<geometry::TriangleMesh>()> mesh = {};
};

/// The contents of a picture of a touch session. Refers to models and samples that must outlive the drawing.
struct TouchPicture {
  std::string title;                     ///< such as the model's name
  std::vector<std::string> notes;        ///< up to two short lines at the upper right
  std::vector<StudioBody> bodies;        ///< the touched bodies, where they stood
  std::vector<TouchSolid> solids;        ///< likewise, those that are CSG trees
  std::span<const TouchSample> samples;  ///< in order of time, any number
  double rate_hz = 0.0;                  ///< of the servo, for the caption; 0 leaves it out
  base::Vector3 up{0.0, 1.0, 0.0};       ///< world direction that stands upright, any length > 0
  int width = 1600;                      ///< pixels, 400 ... 16384; text grows with the picture
  int height = 1200;                     ///< pixels, 400 ... 16384
  /// Gets a sentence for each solid on how it was drawn; may be empty.
  std::function<void(const std::string&)> tell = {};
};

/// Draws the session as for a paper: the model, seen from where most contact shows; the path of the tip,
/// faint where the model hides it; the path of the surface contact point (thesis 5.3.1) coloured by the
/// magnitude of the force; a scale bar, a colour bar, and force over time under it. Samples that are not
/// finite are left out. Needs neither window nor display server. Fails when the size is out of range, when
/// OpenGL is missing, or when a solid needs a mesh and gets none.
base::Result<charts::Image> draw_touch_picture(const TouchPicture& picture);

/// Draws it into a PNG file that appears whole or not at all; fails also when it cannot be written.
base::Result<void> write_touch_picture(const TouchPicture& picture, const std::filesystem::path& path);

}  // namespace icome::render
