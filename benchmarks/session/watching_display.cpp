#include "watching_display.h"

#include <epoxy/gl.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "base/clock.h"
#include "render/gl/offscreen.h"
#include "render/scene/scene_targets.h"

namespace icome::benchmarks {

WatchingDisplay::WatchingDisplay(session::DisplayFeed& feed, int width, int height, Pace pace)
    : feed_(feed), width_(width), height_(height), pace_(pace), thread_([this] { run(); }) {}

WatchingDisplay::~WatchingDisplay() {
  stop_ = true;
  thread_.join();
}

WatchingDisplay::Change WatchingDisplay::last_change() const {
  return {changed_begun_.load(), changed_done_.load(), changed_frame_.load(), red_.load()};
}

void WatchingDisplay::run() {
  const auto context = render::Offscreen::create();
  if (!context) {
    std::fprintf(stderr, "%s\n", context.error().message.c_str());
    std::exit(1);
  }
  render::SceneCanvas canvas;
  render::SceneRenderer renderer;
  if (!canvas.fit(width_, height_, GL_RGBA8, 0)) std::exit(1);
  while (!stop_) {
    if (pace_ == Pace::WhenDue && !feed_.is_due()) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      continue;
    }
    const std::int64_t begun = base::steady_nanoseconds();
    (void)feed_.draw(renderer, {canvas.frame.name(), width_, height_, {}});
    std::array<std::uint8_t, 4> middle{};
    glBindFramebuffer(GL_FRAMEBUFFER, canvas.frame.name());
    glReadPixels(width_ / 2, height_ / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, middle.data());
    const std::int64_t done = base::steady_nanoseconds();
    const std::uint64_t frame = frames_.fetch_add(1) + 1;
    const bool red = middle[0] > middle[1];
    if (red != red_.load()) {
      changed_begun_ = begun;
      changed_done_ = done;
      changed_frame_ = frame;
      red_.store(red, std::memory_order_release);
    }
    last_done_.store(done, std::memory_order_release);
  }
}

}  // namespace icome::benchmarks
