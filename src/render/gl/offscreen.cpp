#include "render/gl/offscreen.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <utility>

#include "render/gl/gl_context.h"

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

/// No context when the driver does not offer that profile.
EGLContext context_of_profile(EGLDisplay display, EGLConfig config, EGLint profile) {
  const EGLint wish[] = {EGL_CONTEXT_MAJOR_VERSION,
                         3,
                         EGL_CONTEXT_MINOR_VERSION,
                         3,
                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                         profile,
                         EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, wish);
}

struct MadeContext {
  EGLContext context;
  bool compatible;
};

/// Compatible if possible, since images of CSG need that; core does for all else.
base::Result<MadeContext> make_context(EGLDisplay display) {
  const EGLint config_wish[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglBindAPI(EGL_OPENGL_API) && eglChooseConfig(display, config_wish, &config, 1, &count) && count == 1) {
    for (const bool compatible : {true, false}) {
      const EGLContext context = context_of_profile(
          display, config,
          compatible ? EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT : EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT);
      if (context != EGL_NO_CONTEXT) return MadeContext{context, compatible};
    }
  }
  return base::fail("no picture can be drawn: the driver offers no OpenGL 3.3; install libgl1-mesa-dri");
}

}  // namespace

// The display is the process's own and shared by all contexts, so it is never terminated.
struct Offscreen::Context {
  EGLDisplay display;
  EGLContext context;
  bool compatible;

  Context(EGLDisplay d, const MadeContext& made)
      : display(d), context(made.context), compatible(made.compatible) {}
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
  const auto made = make_context(*display);
  if (!made) return base::fail(made.error().message);
  auto owned = std::make_unique<Context>(*display, *made);
  if (!eglMakeCurrent(*display, EGL_NO_SURFACE, EGL_NO_SURFACE, made->context)) {
    return base::fail(fmt::format("no picture can be drawn: EGL error 0x{:x} on making the context current",
                                  eglGetError()));
  }
  return Offscreen(std::move(owned));
}

Offscreen::Offscreen(std::unique_ptr<Context> context) : context_(std::move(context)) {}
Offscreen::Offscreen(Offscreen&&) noexcept = default;
Offscreen& Offscreen::operator=(Offscreen&&) noexcept = default;
Offscreen::~Offscreen() = default;

std::string Offscreen::renderer() const { return context_traits().renderer; }

bool Offscreen::is_software() const { return context_traits().software; }

bool Offscreen::has_built_in_pipeline() const { return context_->compatible; }

}  // namespace icome::render
