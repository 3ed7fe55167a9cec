#pragma once
#include <memory>
#include <string>

#include "base/result.h"

namespace icome::render {

/// An OpenGL 3.3 context without a window or a display server, on the machine's GPU or, where there is none,
/// in software. It is current on the thread that made it until it is destroyed; use it there only.
class Offscreen {
 public:
  /// Fails with a sentence that names the missing Debian package when EGL, its surfaceless platform or
  /// an OpenGL driver is not there.
  static base::Result<Offscreen> create();

  Offscreen(Offscreen&&) noexcept;
  Offscreen& operator=(Offscreen&&) noexcept;
  ~Offscreen();

  /// Name of the renderer, in the driver's words, such as "llvmpipe (LLVM 15.0.6, 256 bits)".
  std::string renderer() const;

  /// Does the processor do the drawing? Then it takes its time.
  bool is_software() const;

  /// Does it also have the matrices and vertex inputs of OpenGL 1 and 2 (a compatibility context)? All
  /// drivers of Mesa 21 and later do, and so do those of graphics cards' vendors.
  bool has_built_in_pipeline() const;

 private:
  struct Context;
  explicit Offscreen(std::unique_ptr<Context> context);
  std::unique_ptr<Context> context_;
};

}  // namespace icome::render
