#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "base/result.h"
#include "render/csg/csg_geometry.h"
#include "render/model/camera.h"

namespace icome::render {

/// One operand's share in the visible surface of a solid.
struct CsgFaces {
  std::optional<charts::Colour> colour;  ///< the operand's own, if it has one
  bool subtracted;                       ///< seen from inside: its normals point into the part cut away
};

/// The state for images of CSG in the OpenGL context that is current where it is made, used and destroyed:
/// all solids of the context share it. Kirsch and Doellner's OpenCSG, which does the work, keeps its state in
/// global variables: contexts of several threads take turns, solid by solid.
class CsgImages {
 public:
  /// Fails when the context has no matrices and vertex inputs of OpenGL 1 and 2 (a compatibility context).
  static base::Result<std::shared_ptr<CsgImages>> create();
  CsgImages(const CsgImages&) = delete;
  CsgImages& operator=(const CsgImages&) = delete;
  ~CsgImages();

  /// The library is this context's own until the lock goes.
  std::unique_lock<std::mutex> take_turn() const;

 private:
  explicit CsgImages(int number) : number_(number) {}

  int number_;  // of the library's buffers in this context
};

/// A solid on the graphics card, drawn without making a mesh of its surface: image-based CSG. First
/// draw_depth() finds the visible surface and leaves its depth; then shade() draws the faces that have just
/// this depth. Owns its buffers; the context that made it must outlive it.
class CsgView {
 public:
  CsgView(std::shared_ptr<const CsgImages> images, const CsgGeometry& geometry);
  CsgView(CsgView&&) noexcept;
  CsgView& operator=(CsgView&&) noexcept;
  ~CsgView();

  /// Transform from the buffers' frame to the tree's own (metres): a scale and a shift.
  const Matrix4& tree_from_buffer() const { return tree_from_buffer_; }

  /// Leaves the nearer of the solid and the depths there in the depth buffer of the frame in use, which
  /// needs 8 bits of stencil; the stencil is lost. The viewport must begin at pixel (0, 0) (OpenCSG 1.5
  /// takes its corner for a size); scissor and glFrontFace are heeded. Leaves no program in use.
  void draw_depth(const Matrix4& clip_from_buffer) const;

  /// Issues, with the program in use, the faces that the draw_depth() of the same matrix made visible.
  /// The program's vertex shader must set gl_Position to ftransform(): depths are compared for equality.
  /// `prepare` is called before each operand's, to set colours.
  void shade(const Matrix4& clip_from_buffer, const std::function<void(const CsgFaces&)>& prepare) const;

 private:
  struct Solid;

  std::unique_ptr<Solid> solid_;
  Matrix4 tree_from_buffer_;
};

}  // namespace icome::render
