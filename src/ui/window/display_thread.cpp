#include "ui/window/display_thread.h"

#include <fmt/format.h>

#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QScreen>
#include <QSurfaceFormat>
#include <QThread>
#include <QWindow>
#include <chrono>
#include <condition_variable>
#include <mutex>

#include "realtime/latest_value.h"
#include "render/scene/scene_renderer.h"

namespace icome::ui {
namespace {

using Clock = std::chrono::steady_clock;

// Longest delay of a change while nothing else is drawn.
constexpr auto kLook = std::chrono::milliseconds(4);

std::string needed() {
  return "The scene needs OpenGL 3.3. Install the graphics card's driver, or the package libgl1-mesa-dri, "
         "which also draws without a card";
}

}  // namespace

QSurfaceFormat scene_format() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 3);
  // The profile alone gives a core context; the option is what asks for the built-in matrices.
  format.setProfile(QSurfaceFormat::CompatibilityProfile);
  format.setOption(QSurfaceFormat::DeprecatedFunctions);
  format.setDepthBufferSize(24);
  format.setStencilBufferSize(8);
  format.setSwapBehavior(QSurfaceFormat::DoubleBuffer);
  return format;
}

/// State that both threads use. Main sets under the lock whether there is a window to draw into, since it
/// must not take the window's surface away during a frame; all else goes through the feed.
struct DisplayThread::Parts {
  Parts(QWindow& shown, session::DisplayFeed& source) : window(shown), feed(source) {}

  QWindow& window;
  session::DisplayFeed& feed;
  std::unique_ptr<QOpenGLContext> context;
  std::unique_ptr<QThread> thread;
  std::chrono::nanoseconds shortest_frame = {};

  std::mutex lock;
  std::condition_variable changed;
  bool seen = false;
  bool lost = false;  // the picture, or the size: draw also without news
  bool ending = false;
  bool drawing = false;
  int width = 0, height = 0;

  realtime::LatestValue<std::string> trouble;
  realtime::LatestValue<std::string> driver;

  bool wait_for_turn(Clock::time_point last);
  std::unique_ptr<render::SceneRenderer> start();
  base::Result<void> draw(render::SceneRenderer& renderer);
  void run();
};

/// Waits until there is something to draw and the window is visible; false: the thread must end.
bool DisplayThread::Parts::wait_for_turn(Clock::time_point last) {
  std::unique_lock hold(lock);
  changed.wait_until(hold, last + shortest_frame, [this] { return ending || lost; });
  while (!ending) {
    if (seen) {
      const bool due = feed.is_due();
      if (due || lost) break;
      changed.wait_for(hold, kLook);
    } else {
      changed.wait(hold);
    }
  }
  lost = false;
  drawing = !ending;
  return drawing;
}

base::Result<void> DisplayThread::Parts::draw(render::SceneRenderer& renderer) {
  if (!context->makeCurrent(&window))
    return base::fail(needed() + " (the driver took the window's context away).");
  render::SceneTarget target;
  target.frame = context->defaultFramebufferObject();
  {
    const std::lock_guard hold(lock);
    target.width = width;
    target.height = height;
  }
  auto drawn = feed.draw(renderer, target);
  if (drawn) context->swapBuffers(&window);
  return drawn;
}

std::unique_ptr<render::SceneRenderer> DisplayThread::Parts::start() {
  if (!context->makeCurrent(&window)) return nullptr;
  const auto* name = reinterpret_cast<const char*>(context->functions()->glGetString(GL_RENDERER));
  driver.publish(name ? name : "");
  return std::make_unique<render::SceneRenderer>();
}

void DisplayThread::Parts::run() {
  std::unique_ptr<render::SceneRenderer> renderer;
  Clock::time_point last = {};
  while (wait_for_turn(last)) {
    last = Clock::now();
    base::Result<void> drawn;
    if (!renderer) renderer = start();
    drawn = renderer ? draw(*renderer) : base::fail(needed() + " (the driver refused the window).");
    {
      const std::lock_guard hold(lock);
      drawing = false;
    }
    changed.notify_all();
    if (drawn) continue;
    trouble.publish(drawn.error().message);
    break;
  }
  // Without the context, OpenGL objects cannot be freed; they go along with the context.
  if (renderer && !context->makeCurrent(&window)) static_cast<void>(renderer.release());
  renderer.reset();
  context->doneCurrent();
  context.reset();
}

base::Result<std::unique_ptr<DisplayThread>> DisplayThread::create(QWindow& window,
                                                                   session::DisplayFeed& feed) {
  auto parts = std::make_unique<Parts>(window, feed);
  parts->context = std::make_unique<QOpenGLContext>();
  parts->context->setFormat(window.requestedFormat());
  if (!parts->context->create()) return base::fail(needed() + " (there is no OpenGL here at all).");
  const QSurfaceFormat given = parts->context->format();
  if (given.version() < qMakePair(3, 3)) {
    return base::fail(fmt::format("{} (what is there has OpenGL {}.{}).", needed(), given.majorVersion(),
                                  given.minorVersion()));
  }
  const double rate = window.screen() ? window.screen()->refreshRate() : 60.0;
  // A little less than a screen's frame: where swapping waits for the screen, that alone sets the pace.
  parts->shortest_frame = std::chrono::nanoseconds(std::int64_t(0.85e9 / std::clamp(rate, 20.0, 500.0)));
  return std::unique_ptr<DisplayThread>(new DisplayThread(std::move(parts)));
}

DisplayThread::DisplayThread(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {
  parts_->thread.reset(QThread::create([this] { parts_->run(); }));
  parts_->thread->setObjectName("display");
  parts_->context->moveToThread(parts_->thread.get());
  parts_->thread->start();
}

DisplayThread::~DisplayThread() {
  {
    const std::lock_guard hold(parts_->lock);
    parts_->ending = true;
  }
  parts_->changed.notify_all();
  parts_->thread->wait();
}

void DisplayThread::show(int width, int height) {
  {
    const std::lock_guard hold(parts_->lock);
    parts_->seen = width > 0 && height > 0;
    parts_->lost = true;
    parts_->width = width;
    parts_->height = height;
  }
  parts_->changed.notify_all();
}

void DisplayThread::hide() {
  std::unique_lock hold(parts_->lock);
  parts_->seen = false;
  parts_->changed.wait(hold, [this] { return !parts_->drawing; });
}

std::string DisplayThread::renderer() {
  parts_->driver.update();
  return parts_->driver.read();
}

std::optional<std::string> DisplayThread::trouble() {
  if (!parts_->trouble.update()) return std::nullopt;
  return parts_->trouble.read();
}

}  // namespace icome::ui
