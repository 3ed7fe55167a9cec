#pragma once
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "base/result.h"
#include "charts/colour.h"
#include "charts/image.h"
#include "render/csg/scene_solids.h"
#include "render/model/camera.h"
#include "render/model/render_scene.h"
#include "render/scene/scene_lighting.h"
#include "render/scene/scene_plan.h"

namespace icome::render {

/// Things drawn over a scene for a moment: markers of the hand, guides, measures. World frame. Parts that
/// lie behind something are drawn faintly, so that a marker is never lost.
struct SceneOverlay {
  struct Ball {
    base::Vector3 centre;
    double radius;  ///< m, > 0
    charts::Colour colour;
  };
  struct Arrow {
    base::Vector3 from, to;
    double radius;  ///< m, of its shaft, > 0
    charts::Colour colour;
  };
  struct Line {
    std::vector<base::Vector3> points;  ///< those that are not finite part it
    charts::Colour colour;
    double width = 2.0;  ///< pixels
  };

  /// Round dots, of one size however far they are; a little before the surface on which they lie.
  struct Dots {
    std::vector<base::Vector3> points;  ///< those that are not finite are passed over
    charts::Colour colour;
    double width = 7.0;  ///< pixels
  };

  /// Text and other pictures, drawn by the caller: they face the eye or lie in the scene, and are never
  /// hidden.
  struct Panel {
    /// sRGB, premultiplied, unlike other images; kept on the graphics card for as long as somebody has it.
    std::shared_ptr<const charts::Image> picture;
    std::optional<base::Vector3> at = {};             ///< m, world frame; nothing: in the window
    base::Vector2 in_window = base::Vector2::Zero();  ///< without `at`: shares from the left and the bottom
    base::Vector2 anchor = {0.5, 0.5};  ///< place of the panel that comes there: shares, as in_window
    base::Vector2 shift = base::Vector2::Zero();  ///< pixels to the right and up from there
    /// With `at`, its middle: from there to the middle of its right edge and of its upper one, m. It then
    /// lies in the scene, and what places a panel that faces the eye does not count.
    std::optional<std::array<base::Vector3, 2>> lying = {};
    /// Of one that lies in the scene: what of balls, arrows, lines and dots is farther than this behind it is
    /// hidden by it, m; what is nearer, such as a tip that pushes it, is not. Infinite: all is before it.
    double hides_beyond = std::numeric_limits<double>::infinity();
    double scale = 1.0;  ///< pixels of the window for one of the picture, > 0
    double alpha = 1.0;  ///< 0 ... 1, of all of it
  };

  /// A scene once more, elsewhere and of another size: a world in miniature. Transparent objects are drawn
  /// opaque.
  struct Copy {
    RenderScenePointer scene;  ///< null: nothing
    base::Affine3 world_from_scene = base::Affine3::Identity();
  };

  std::vector<Ball> balls = {};
  std::vector<Arrow> arrows = {};
  std::vector<Line> lines = {};
  std::vector<Dots> dots = {};
  std::vector<Panel> panels = {};
  std::vector<Copy> copies = {};

  bool empty() const {
    return balls.empty() && arrows.empty() && lines.empty() && dots.empty() && panels.empty() &&
           copies.empty();
  }
};

/// A line around what is seen of objects.
struct SceneOutline {
  std::vector<world::ObjectId> objects = {};  ///< in any order
  charts::Colour colour{1.0, 0.55, 0.10};
};

/// The look in which a scene is drawn.
struct SceneLook {
  charts::Colour above{0.80, 0.84, 0.88};  ///< background at the top; alpha 0 leaves it clear
  charts::Colour below{0.96, 0.96, 0.95};  ///< background at the bottom
  LightChoice lights = LightChoice::Automatic;
  bool shadows = true;
  bool ground = true;  ///< shadows also fall on a plane below all that is drawn (not seen from below)
  /// Lines on the plane y = 0, as far apart as suits the view: a tenth, one and ten of a power of ten (m).
  /// They fade far away. `grid_colour` is that of the strongest, `x_axis` and `z_axis` of those through the
  /// origin.
  bool grid = false;
  charts::Colour grid_colour{0.33, 0.37, 0.42, 0.5};
  charts::Colour x_axis{0.80, 0.25, 0.25, 0.8};
  charts::Colour z_axis{0.25, 0.40, 0.85, 0.8};
  int shadow_side = 1024;  ///< texels, 64 ... 4096
  /// 1 draws at once, as a view that is turned does. More, up to 256, are averaged: smooth edges, soft
  /// shadows, light from all of the sky; for views at rest and pictures.
  int passes = 1;
  CsgWay csg = CsgWay::Automatic;
  std::vector<SceneOutline> outlines = {};  ///< later ones cover earlier ones
  int outline_width = 2;                    ///< pixels, 1 ... 8
  SceneOverlay overlay = {};
};

/// The target of a picture.
struct SceneTarget {
  unsigned frame =
      0;           ///< OpenGL's name of the framebuffer, drawn from its corner (0, 0); 0 is a window's own
  int width = 1;   ///< pixels
  int height = 1;  ///< pixels
  PictureWindow window = {};  ///< the part of the camera's picture that it takes
};

class StereoPass;

/// The cameras of both eyes.
struct EyeCameras {
  Camera left, right;
};

/// The place of each eye's picture in a stereo picture: red of the left eye with green and blue of the right,
/// left beside right, or left above right.
enum class StereoLayout : std::uint8_t { Anaglyph, SideBySide, TopBottom };

/// The shares of the whole picture's width and height that the picture of an eye takes.
base::Vector2 share_of_eye(StereoLayout layout);

/// Draws scenes in the OpenGL context (3.3, core or compatible) that is current where it is made, used and
/// destroyed; knows no window. Keeps shapes, pictures and shaders on the graphics card from one picture to
/// the next. It never waits for a world: scenes are immutable. Owns all it has in the context.
class SceneRenderer {
 public:
  SceneRenderer();
  SceneRenderer(SceneRenderer&&) noexcept;
  SceneRenderer& operator=(SceneRenderer&&) noexcept;
  ~SceneRenderer();

  /// Fails with the driver's words when it refuses the size or a shader. Leaves the target bound, and depth
  /// test, blending, culling and scissor off.
  base::Result<void> draw(const RenderScene& scene, const Camera& camera, const SceneLook& look,
                          const SceneTarget& target);

  /// For windows, which show a picture at once and better it while nothing moves. Call it with 0 where
  /// something moved: that draws as with one pass. Each further number, up to look.passes - 1, adds one more
  /// pass of the same picture and shows their result so far, melting from the first into the result of
  /// draw(), which the last one gives. From look.passes on it shows that again, at little cost. Overlay and
  /// selection may differ in each call, so that a moving hand does not start the picture anew; scene, camera
  /// and the rest of the look must stay as they were with 0. A target of another size begins anew by itself.
  /// Otherwise as draw().
  base::Result<void> draw_pass(const RenderScene& scene, const Camera& camera, const SceneLook& look,
                               const SceneTarget& target, int number);

  /// As draw_pass(), with a picture for each eye. The window of the target must be all of the picture. What
  /// this keeps on the graphics card besides goes with the next draw_pass().
  base::Result<void> draw_stereo_pass(const RenderScene& scene, const EyeCameras& eyes, StereoLayout layout,
                                      const SceneLook& look, const SceneTarget& target, int number);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
  std::unique_ptr<StereoPass> stereo_;  // null: not drawn in stereo
};

}  // namespace icome::render
