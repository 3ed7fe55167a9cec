#include "render/gl/gl_context.h"

#include <epoxy/gl.h>

#include <string_view>

namespace icome::render {

ContextTraits context_traits() {
  ContextTraits traits;
  GLint profile = 0;
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  traits.built_in_pipeline = (profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  if (name) traits.renderer = name;
  for (const std::string_view processor : {"llvmpipe", "softpipe", "SWR"})
    traits.software |= traits.renderer.find(processor) != std::string::npos;
  return traits;
}

}  // namespace icome::render
