#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/touch_options.h"
#include "base/result.h"
#include "geometry/csg_tree.h"
#include "geometry/primitive.h"
#include "geometry/triangle_mesh.h"
#include "geometry/triangle_tree.h"
#include "haptics/haptic_scene.h"

namespace icome::apps {

/// One MODEL of the command line, ready to be touched.
struct TouchModel {
  std::string name;                                    // as the person wrote it
  std::string kind;                                    // "binary PLY", "primitive" and so on
  std::shared_ptr<const geometry::TriangleMesh> mesh;  // never null; of a primitive, its tessellation
  std::shared_ptr<const geometry::TriangleTree> tree;  // never null; over `mesh`
  std::shared_ptr<const haptics::Shape> shape;         // never null
  std::optional<geometry::Primitive> primitive;        // what a primitive is; none for a file
  std::optional<geometry::CsgTree> csg;                // what a .csg file holds, in the world
  /// Is the point inside at that time (s)? Of solids that are touched without a mesh; else empty.
  std::function<bool(const base::Vector3& point, double time)> membership;
  bool exact = false;         // touched as what it is; `mesh` is for the eye
  std::size_t triangles = 0;  // that are touched
  bool closed = true;
  haptics::TouchableSides sides = haptics::TouchableSides::Front;
  std::vector<std::string> repairs;  // what the reader did and found, one sentence each
  double read_seconds = 0.0;         // s, reading and repairing
  double build_seconds = 0.0;        // s, building what the servo touches
};

/// Reads one MODEL: what has a primitive's keyword before a colon, or is "plane", is a primitive,
/// everything else a file. Models stand in the world as they are: files are scaled by the unit, turned
/// when y is up and scaled by `fit`, always about the origin and never moved, so that a path in the
/// world frame can rely on it.
base::Result<TouchModel> load_model(const std::string& text, const TouchOptions& options);

/// All MODELs, in the order of the command line, the surface of --implicit last. `say` hears what is read.
base::Result<std::vector<TouchModel>> load_models(const TouchOptions& options,
                                                  const std::function<void(const std::string&)>& say);

/// Is the model the unlimited plane, solid below z = 0?
bool is_half_space(const TouchModel& model);

/// The scene of all models; object i is model i.
std::shared_ptr<const haptics::HapticScene> compile_scene(const std::vector<TouchModel>& models,
                                                          const TouchOptions& options);

}  // namespace icome::apps
