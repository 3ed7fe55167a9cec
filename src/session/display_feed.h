#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "interaction/navigation.h"
#include "realtime/latest_value.h"
#include "realtime/recorder.h"
#include "render/scene_renderer.h"
#include "session/pointer_view.h"

namespace icome::session {

/// How the main thread wants the world to be shown.
struct DisplayWish {
  interaction::View view = {};
  render::SceneLook look = {};  // its passes: how many a view at rest is refined to
  bool pointers = true;         // tips, surface contact points and forces are shown
  double marker_size = 0.004;   // share of the distance to the eye: radius of the tip's ball
};

/// What brings the world to the eye: the display thread asks it what to draw, and never waits for anybody.
/// Knows no window; whoever has an OpenGL context draws with it (a window's thread, an off-screen one).
class DisplayFeed {
 public:
  explicit DisplayFeed(std::size_t pointers);

  // The main thread.
  void wish(const DisplayWish& wish) { wish_.publish(wish); }
  /// The frames drawn so far: how long each took, and when.
  const realtime::LoopRecorder& recorder() const { return recorder_; }
  std::uint64_t frames() const;

  // The thread that makes versions of the world for drawing.
  void publish(render::RenderScenePointer scene);

  // The servo thread. Real-time safe.
  void publish(std::size_t pointer, const PointerView& view);

  // The display thread.
  /// Is there something to draw: news since the last frame, or a picture that can be refined? Call it before
  /// draw().
  bool is_due();
  /// Draws the newest of all, or refines the last frame where there is no news, into the target.
  base::Result<void> draw(render::SceneRenderer& renderer, const render::SceneTarget& target);

 private:
  struct PointerBox {
    realtime::LatestValue<PointerView> newest;
  };
  realtime::LatestValue<DisplayWish> wish_;
  realtime::LatestValue<render::RenderScenePointer> scene_;
  std::vector<std::unique_ptr<PointerBox>> pointers_;
  realtime::LoopRecorder recorder_;
};

}  // namespace icome::session
