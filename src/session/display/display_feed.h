#pragma once
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "interaction/navigation.h"
#include "interaction/screen_view.h"
#include "realtime/latest_value.h"
#include "realtime/recorder.h"
#include "render/scene/scene_renderer.h"
#include "session/hands/pointer_view.h"

namespace icome::session {

/// The main thread's wish for the display of the world.
struct DisplayWish {
  interaction::View view = {};
  interaction::StereoSettings stereo = {};
  interaction::View left = {}, right = {};  // of the eyes, where each gets a picture
  render::SceneLook look = {};              // its passes: the number that a view at rest is refined to
  bool pointers = true;                     // tips, surface contact points and forces are shown
  /// The map from the scene to a copy of it that is drawn over it, when there is one.
  std::optional<base::Affine3> miniature = {};
  /// The sign beside a hand whose force is held down, as the motors would become too warm; null: none.
  std::shared_ptr<const charts::Image> spared_sign = nullptr;
  /// The names of others who are at work in the design, by author.
  std::map<std::uint32_t, std::shared_ptr<const charts::Image>> name_signs = {};
  /// The pointer that lies aside, which is not shown; none: all are shown.
  std::optional<std::size_t> aside = {};
  charts::Colour selection = {1.0, 0.55, 0.10};        // of the line around what is selected
  charts::Colour workspace = {0.16, 0.47, 0.90, 0.6};  // of the lines of a device's workspace
  /// Places that are to be seen besides the scene, wherever they lie in depth.
  std::vector<base::Vector3> in_sight = {};
  double marker_size = 0.004;  // share of the distance to the eye: radius of the tip's ball
};

/// The layout of a way of stereo that is not off.
render::StereoLayout layout_of(interaction::StereoKind kind);

/// Brings the world to the eye: the display thread asks it for the things to draw, and never waits for
/// anybody. Knows no window; any thread with an OpenGL context draws with it (a window's, an off-screen one).
class DisplayFeed {
 public:
  /// Shows up to that many pointers, those of which something is published.
  explicit DisplayFeed(std::size_t pointers);

  // The main thread.
  void wish(const DisplayWish& wish) { wish_.publish(wish); }
  /// The frames drawn so far: their durations and times.
  const realtime::LoopRecorder& recorder() const { return recorder_; }
  std::uint64_t frames() const { return frames_.load(std::memory_order_acquire); }

  // The thread that makes versions of the world for drawing.
  void publish(const render::RenderScenePointer& scene) { scene_.publish(scene); }

  // The servo thread. Real-time safe.
  void publish(std::size_t pointer, const PointerView& view) { pointers_[pointer]->newest.publish(view); }

  // The display thread.
  /// Is there something to draw: news since the last frame, or a picture that can be refined? Call it before
  /// draw().
  bool is_due();
  /// Draws the newest of all, or refines the last frame where there is no news, into the target.
  base::Result<void> draw(render::SceneRenderer& renderer, const render::SceneTarget& target);
  /// The scene that is drawn next.
  const render::RenderScenePointer& scene() const { return scene_.read(); }

 private:
  struct PointerBox {
    realtime::LatestValue<PointerView> newest;
    PointerView drawn;       // in the last frame
    std::size_t number = 0;  // of the pointer
  };

  void take_news();
  void take_wish();
  void note_target(const render::SceneRenderer& renderer, const render::SceneTarget& target);
  bool has_moved(const PointerBox& box) const;
  bool is_shown(const PointerBox& box, const PointerView& pointer) const;
  render::Camera camera(const interaction::View& view, double aspect) const;
  base::Result<void> draw_eyes(render::SceneRenderer& renderer, const render::SceneLook& look,
                               const render::SceneTarget& target, double aspect);
  base::Result<void> draw_middle(render::SceneRenderer& renderer, const render::SceneLook& look,
                                 const render::SceneTarget& target, double aspect);
  int begin_pass(const render::Matrix4& lens, const render::Matrix4& other_lens, int passes);
  void add_markers(render::SceneOverlay& overlay) const;

  realtime::LatestValue<DisplayWish> wish_;
  realtime::LatestValue<render::RenderScenePointer> scene_;
  std::vector<std::unique_ptr<PointerBox>> pointers_;
  realtime::LoopRecorder recorder_;
  std::atomic<std::uint64_t> frames_ = 0;

  // The display thread's.
  DisplayWish shown_ = {};                          // the newest wish
  bool is_new_ = true;                              // another picture: what was refined is of no use
  bool has_moved_ = false;                          // only the overlay of the picture is another
  int passes_ = 0;                                  // of this picture, so far
  render::SceneTarget target_ = {};                 // the last
  render::Matrix4 lens_ = render::Matrix4::Zero();  // of the last frame, of the left eye where there are two
  render::Matrix4 other_lens_ = render::Matrix4::Zero();
  const render::SceneRenderer* renderer_ = nullptr;  // the last; only compared
};

}  // namespace icome::session
