#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/touch/model_motion.h"
#include "apps/touch/touch_eye.h"
#include "apps/touch/touch_options.h"
#include "base/result.h"
#include "charts/colour.h"
#include "geometry/csg/csg_tree.h"
#include "geometry/primitive/primitive.h"
#include "haptics/contact/haptic_scene.h"
#include "haptics/judge/contact_judge.h"
#include "haptics/servo/effect_feed.h"
#include "haptics/shapes/smooth_shape.h"

namespace icome::apps {

/// A mesh that stands for an exact surface before the judge, within `error` (m).
struct JudgedMesh {
  std::shared_ptr<const geometry::TriangleMesh> mesh;  // null: none
  double error = 0.0;
};

/// A body that is touched: an object of a design, or all of another MODEL. Clones share what pointers hold.
struct TouchBody {
  std::shared_ptr<TouchEye> eye;  // the felt mesh, unless `exact`; may be null where `solid` is set
  std::shared_ptr<const haptics::Shape> shape;             // never null
  base::Pose world_from_body = base::Pose::Identity();     // at the moment 0
  Course course = {};                                      // by the motions of its file
  std::optional<geometry::Primitive> primitive = {};       // of a primitive
  std::shared_ptr<const geometry::CsgTree> csg = nullptr;  // of a CSG tree that is drawn as one; else null
  /// The surface of a body that is touched without a mesh, as a point touches it. Else null.
  std::shared_ptr<const haptics::SmoothShape> solid = nullptr;
  /// The inside of a solid that is touched without a mesh, as its model defines it; else empty.
  std::optional<haptics::MembershipSolid> membership = {};
  JudgedMesh judged = {};  // of a Loop surface, in its own frame; only where it is judged
  bool exact = false;      // its surface itself is touched, not a mesh of it; true of primitives
  bool is_mesh = false;    // it is a mesh in its file
  bool closed = true;
  haptics::Surface surface = {};              // as the model gives it; the options take precedence
  std::optional<charts::Colour> colour = {};  // none: the picture's own
};

inline constexpr const char* kPrimitive = "primitive";

/// One MODEL of the command line, ready to be touched.
struct TouchModel {
  std::string name;  // as the person wrote it
  std::string kind;  // "binary PLY", "primitive" and so on
  /// One for a primitive or a formula, none for a design that has effects alone.
  std::vector<TouchBody> bodies = std::vector<TouchBody>(1);
  std::size_t triangles = 0;                            // that are touched
  std::vector<haptics::PlacedEffect> effects = {};      // of a design
  std::vector<Course> effect_courses = {};              // of each of these
  std::shared_ptr<const ModelMotion> motion = nullptr;  // null: it stands where it is
  std::vector<std::string> repairs = {};                // sentences on what the reader did and found
  double read_seconds = 0.0;                            // s, reading and repairing
  double build_seconds = 0.0;                           // s, building what the servo touches

  TouchBody& body() { return bodies.front(); }
  const TouchBody& body() const { return bodies.front(); }
};

/// Is this MODEL a primitive (a keyword before a colon, or "plane"), not a file?
bool names_primitive(std::string_view text);

/// Reads one MODEL: what has a primitive's keyword before a colon, or is "plane", is a primitive, everything
/// else the file of a design. Models stand in the world as they are: a design as read_design() gives it,
/// which all commands have in common, scaled by `fit` about the origin and never moved, so that a path in
/// the world frame can rely on it.
base::Result<TouchModel> load_model(const std::string& text, const TouchOptions& options);

/// All MODELs, in the order of the command line, the surface of --implicit last. `say` announces each.
base::Result<std::vector<TouchModel>> load_models(const TouchOptions& options,
                                                  const std::function<void(const std::string&)>& say);

/// The box around its surface, or around the square that pictures show of a half-space; in its own frame or
/// the world's.
base::Bounds own_bounds(const TouchBody& body);
base::Bounds bounds(const TouchBody& body);
base::Bounds bounds(const TouchModel& model);

/// Is the body the unlimited plane, solid below the z = 0 of its own frame?
bool is_half_space(const TouchBody& body);

/// The feel of the body: as the options say, else as its model does.
haptics::Surface surface_of(const TouchBody& body, const TouchOptions& options);

/// The scene of all models. Bodies of model i have the index i in their ids, and their number, from 1, as the
/// generation.
std::shared_ptr<const haptics::HapticScene> compile_scene(const std::vector<TouchModel>& models,
                                                          const TouchOptions& options);

}  // namespace icome::apps
