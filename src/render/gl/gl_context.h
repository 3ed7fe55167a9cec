#pragma once
#include <string>

namespace icome::render {

/// Abilities of the current OpenGL context, whoever made it: a window or Offscreen.
struct ContextTraits {
  /// Has it the matrices and vertex inputs of OpenGL 1 and 2 (a compatibility context)?
  bool built_in_pipeline = false;
  bool software = false;      ///< does the processor do the drawing? Then it takes its time
  std::string renderer = {};  ///< name of the renderer, in the driver's words
};
ContextTraits context_traits();

}  // namespace icome::render
