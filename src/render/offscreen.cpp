#include "render/offscreen.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <utility>

namespace icome::render {
namespace {

base::Result<EGLDisplay> surfaceless_display() {
  // Asked before anything else: without a vendor library the platform function is not there to be called.
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    return base::fail(
        "no picture can be drawn: EGL offers no surfaceless platform here; install libegl-mesa0");
  }
  const EGLDisplay display =
      eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  EGLint major = 0;
  EGLint minor = 0;
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) {
    return base::fail("no picture can be drawn: EGL found no OpenGL driver; install libgl1-mesa-dri");
  }
  return display;
}

base::Result<EGLContext> core_context(EGLDisplay display) {
  const EGLint config_wish[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  const EGLint context_wish[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 3,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  const bool chosen =
      eglBindAPI(EGL_OPENGL_API) && eglChooseConfig(display, config_wish, &config, 1, &count) && count == 1;
  const EGLContext context =
      chosen ? eglCreateContext(display, config, EGL_NO_CONTEXT, context_wish) : EGL_NO_CONTEXT;
  if (context == EGL_NO_CONTEXT) {
    return base::fail("no picture can be drawn: the driver offers no OpenGL 3.3; install libgl1-mesa-dri");
  }
  return context;
}

}  // namespace

// The display is the process's own and shared by all contexts, so it is never terminated.
struct Offscreen::Context {
  EGLDisplay display;
  EGLContext context;

  Context(EGLDisplay d, EGLContext c) : display(d), context(c) {}
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() {
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
  }
};

base::Result<Offscreen> Offscreen::create() {
  const auto display = surfaceless_display();
  if (!display) return base::fail(display.error().message);
  const auto context = core_context(*display);
  if (!context) return base::fail(context.error().message);
  auto owned = std::make_unique<Context>(*display, *context);
  if (!eglMakeCurrent(*display, EGL_NO_SURFACE, EGL_NO_SURFACE, *context)) {
    return base::fail(fmt::format("no picture can be drawn: EGL error 0x{:x} on making the context current",
                                  eglGetError()));
  }
  return Offscreen(std::move(owned));
}

Offscreen::Offscreen(std::unique_ptr<Context> context) : context_(std::move(context)) {}
Offscreen::Offscreen(Offscreen&&) noexcept = default;
Offscreen& Offscreen::operator=(Offscreen&&) noexcept = default;
Offscreen::~Offscreen() = default;

std::string Offscreen::renderer() const { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }

}  // namespace icome::render
