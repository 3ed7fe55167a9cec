#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/result.h"
#include "session/display/display_feed.h"

class QSurfaceFormat;
class QWindow;

namespace icome::ui {

/// What a window's surface and context must be: OpenGL 3.3 with the built-in matrices of OpenGL 2, which
/// CSG solids are drawn with.
QSurfaceFormat scene_format();

/// The thread that draws a session into a window, with a context of its own. It sleeps while there is nothing
/// to draw. Main makes and destroys it, and it waits for main only to be told that the window is there. Does
/// not own the window or the feed, which outlive it.
class DisplayThread {
 public:
  /// The window has its native surface. Fails with what to do where there is no such OpenGL.
  static base::Result<std::unique_ptr<DisplayThread>> create(QWindow& window, session::DisplayFeed& feed);
  /// Waits for the frame that is being drawn.
  ~DisplayThread();

  /// The window is seen, this many pixels of the device large, or it has grown, or lost what was drawn.
  void show(int width, int height);
  /// The window is not seen: when this returns, nothing is drawn any more.
  void hide();
  /// What draws, in the driver's words; empty until the first frame.
  std::string renderer();
  /// Why it draws no more, once; nothing while all is well.
  std::optional<std::string> trouble();

 private:
  struct Parts;
  explicit DisplayThread(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
