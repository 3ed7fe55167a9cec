#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/result.h"
#include "session/display/display_feed.h"

class QSurfaceFormat;
class QWindow;

namespace icome::ui {

/// The format of a window's surface and context: OpenGL 3.3 with the built-in matrices of OpenGL 2, which the
/// drawing of CSG solids needs.
QSurfaceFormat scene_format();

/// The thread that draws a session into a window, with a context of its own. It sleeps while there is nothing
/// to draw. Main makes and destroys it, and it waits for main only to be told that the window is there. Does
/// not own the window or the feed, which outlive it.
class DisplayThread {
 public:
  /// The window must have its native surface. Fails with what to do where there is no such OpenGL.
  static base::Result<std::unique_ptr<DisplayThread>> create(QWindow& window, session::DisplayFeed& feed);
  /// Waits for the frame that is being drawn.
  ~DisplayThread();

  /// The window is visible, with this size in device pixels, or that has changed, or the picture was lost.
  void show(int width, int height);
  /// The window is not visible: when this returns, nothing is drawn any more.
  void hide();
  /// Name of the renderer, in the driver's words; empty until the first frame.
  std::string renderer();
  /// The reason why it has stopped drawing, once; nothing while all is well.
  std::optional<std::string> trouble();

 private:
  struct Parts;
  explicit DisplayThread(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
