#include "render/gl/gl_objects.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <string>
#include <utility>

namespace icome::render {
namespace {

unsigned make(GlObject::Kind kind) {
  GLuint name = 0;
  switch (kind) {
    case GlObject::Kind::Buffer:
      glGenBuffers(1, &name);
      break;
    case GlObject::Kind::VertexArray:
      glGenVertexArrays(1, &name);
      break;
    case GlObject::Kind::Texture:
      glGenTextures(1, &name);
      break;
    case GlObject::Kind::Framebuffer:
      glGenFramebuffers(1, &name);
      break;
    case GlObject::Kind::Program:
      name = glCreateProgram();
      break;
    case GlObject::Kind::Shader:
    case GlObject::Kind::None:
      break;
  }
  return name;
}

void remove(GlObject::Kind kind, GLuint name) {
  switch (kind) {
    case GlObject::Kind::Buffer:
      glDeleteBuffers(1, &name);
      break;
    case GlObject::Kind::VertexArray:
      glDeleteVertexArrays(1, &name);
      break;
    case GlObject::Kind::Texture:
      glDeleteTextures(1, &name);
      break;
    case GlObject::Kind::Framebuffer:
      glDeleteFramebuffers(1, &name);
      break;
    case GlObject::Kind::Shader:
      glDeleteShader(name);
      break;
    case GlObject::Kind::Program:
      glDeleteProgram(name);
      break;
    case GlObject::Kind::None:
      break;
  }
}

base::Result<GlObject> compile_shader(GLenum stage, const std::string& source) {
  GlObject shader(GlObject::Kind::Shader, glCreateShader(stage));
  const char* text = source.c_str();
  glShaderSource(shader.name(), 1, &text, nullptr);
  glCompileShader(shader.name());
  GLint good = GL_FALSE;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &good);
  if (good) return shader;
  char message[1024] = "";
  glGetShaderInfoLog(shader.name(), sizeof message, nullptr, message);
  return base::fail(fmt::format("the OpenGL driver refused a shader: {}", message));
}

int location(const GlObject& program, const char* name) { return glGetUniformLocation(program.name(), name); }

}  // namespace

GlObject::GlObject(Kind kind) : kind_(kind), name_(make(kind)) {}

GlObject::GlObject(GlObject&& other) noexcept
    : kind_(std::exchange(other.kind_, Kind::None)), name_(std::exchange(other.name_, 0)) {}

GlObject& GlObject::operator=(GlObject&& other) noexcept {
  std::swap(kind_, other.kind_);
  std::swap(name_, other.name_);
  return *this;
}

GlObject::~GlObject() { remove(kind_, name_); }

base::Result<GlObject> compile_program(std::string_view vertex, std::string_view fragment,
                                       std::string_view defines, std::string_view profile) {
  const auto source = [&](std::string_view body) {
    return fmt::format("#version 330 {}\n{}{}", profile, defines, body);
  };
  const auto vertex_shader = compile_shader(GL_VERTEX_SHADER, source(vertex));
  if (!vertex_shader) return base::fail(vertex_shader.error().message);
  const auto fragment_shader = compile_shader(GL_FRAGMENT_SHADER, source(fragment));
  if (!fragment_shader) return base::fail(fragment_shader.error().message);
  GlObject program(GlObject::Kind::Program);
  glAttachShader(program.name(), vertex_shader->name());
  glAttachShader(program.name(), fragment_shader->name());
  glBindAttribLocation(program.name(), 0, "position");
  glBindAttribLocation(program.name(), 1, "normal");
  glBindAttribLocation(program.name(), 2, "picture_place");
  glBindAttribLocation(program.name(), 3, "corner_colour");
  glLinkProgram(program.name());
  GLint good = GL_FALSE;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &good);
  if (good) return program;
  char message[1024] = "";
  glGetProgramInfoLog(program.name(), sizeof message, nullptr, message);
  return base::fail(fmt::format("the OpenGL driver refused to link a shader: {}", message));
}

void set_uniform(const GlObject& program, const char* name, int value) {
  glUniform1i(location(program, name), value);
}

void set_uniform(const GlObject& program, const char* name, float value) {
  glUniform1f(location(program, name), value);
}

void set_uniform(const GlObject& program, const char* name, const base::Vector3& value) {
  const Eigen::Vector3f single = value.cast<float>();
  glUniform3fv(location(program, name), 1, single.data());
}

void set_uniform(const GlObject& program, const char* name, const Matrix4& value) {
  const Eigen::Matrix4f single = value.cast<float>();
  glUniformMatrix4fv(location(program, name), 1, GL_FALSE, single.data());
}

GlObject make_target(unsigned format, int width, int height) {
  GlObject texture(GlObject::Kind::Texture);
  const bool depth = format == GL_DEPTH24_STENCIL8;
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0,
               depth ? GL_DEPTH_STENCIL : GL_RGBA, depth ? GL_UNSIGNED_INT_24_8 : GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, depth ? GL_LINEAR : GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, depth ? GL_LINEAR : GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

base::Result<GlObject> make_frame(const GlObject* colour, const GlObject* depth) {
  GlObject frame(GlObject::Kind::Framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, frame.name());
  if (colour) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour->name(), 0);
  } else {
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
  }
  if (depth) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, depth->name(), 0);
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return frame;
  return base::fail("the OpenGL driver cannot draw into a picture of that size; choose a smaller one");
}

}  // namespace icome::render
