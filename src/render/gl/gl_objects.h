#pragma once
#include <string_view>

#include "base/result.h"
#include "base/vector.h"
#include "render/model/camera.h"

namespace icome::render {

/// Owns one OpenGL object of the context that is current where it is made and destroyed.
class GlObject {
 public:
  enum class Kind { None, Buffer, VertexArray, Texture, Framebuffer, Shader, Program };

  GlObject() = default;
  /// Takes over an object that was made elsewhere.
  GlObject(Kind kind, unsigned name) : kind_(kind), name_(name) {}
  /// Makes a new one; for a shader or program see compile_program.
  explicit GlObject(Kind kind);
  GlObject(GlObject&& other) noexcept;
  GlObject& operator=(GlObject&& other) noexcept;
  ~GlObject();

  unsigned name() const { return name_; }

 private:
  Kind kind_ = Kind::None;
  unsigned name_ = 0;
};

/// Compiles and links a variant of a shader pair (GLSL 3.30 without the #version line); `defines` are
/// lines such as "#define FLOOR\n" put before both. Vertex inputs: 0 is `position`, 1 `normal`,
/// 2 `picture_place` and 3 `corner_colour`, or what OpenGL 2 has built in where the profile is
/// "compatibility". Fails with the driver's message.
base::Result<GlObject> compile_program(std::string_view vertex, std::string_view fragment,
                                       std::string_view defines, std::string_view profile = "core");

// Uniforms of the program in use, by name; a name that the variant does not use is ignored.
void set_uniform(const GlObject& program, const char* name, int value);
void set_uniform(const GlObject& program, const char* name, float value);
void set_uniform(const GlObject& program, const char* name, const base::Vector3& value);
void set_uniform(const GlObject& program, const char* name, const Matrix4& value);

/// A texture without mipmaps to draw into: `format` is GL_DEPTH24_STENCIL8 or a sized colour format such as
/// GL_RGBA16F.
GlObject make_target(unsigned format, int width, int height);

/// A frame that draws into those textures; `colour` may be null for a frame of depth and stencil only.
/// Fails when the driver does not take the combination.
base::Result<GlObject> make_frame(const GlObject* colour, const GlObject* depth);

}  // namespace icome::render
