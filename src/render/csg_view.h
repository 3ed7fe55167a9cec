#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

#include "base/result.h"
#include "render/camera.h"
#include "render/csg_geometry.h"
#include "render/offscreen.h"

namespace icome::render {

/// One operand's share in the visible surface of a solid.
struct CsgFaces {
  std::optional<Colour> colour;  ///< the operand's own, if it has one
  bool subtracted;               ///< seen from inside: its normals point into what is cut away
};

/// A solid on the graphics card, drawn without making a mesh of its surface: image-based CSG (Kirsch and
/// Doellner's OpenCSG). First draw_depth() finds what is visible and leaves its depth; then shade() draws
/// the faces that have just this depth. Owns its buffers; the context that made it must outlive it.
class CsgView {
 public:
  /// Fails when the functions of a compatibility context cannot be found.
  static base::Result<CsgView> create(const Offscreen& context, const CsgGeometry& geometry);

  CsgView(CsgView&&) noexcept;
  CsgView& operator=(CsgView&&) noexcept;
  ~CsgView();

  /// From the buffers' frame to the tree's own (metres): a scale and a shift.
  const Matrix4& tree_from_buffer() const { return tree_from_buffer_; }

  /// Leaves the nearer of what is there and the solid in the depth buffer of the frame in use, which needs
  /// 8 bits of stencil; the stencil is lost. The viewport must begin at pixel (0, 0) (OpenCSG 1.5 takes its
  /// corner for a size); the scissor is heeded. Leaves no program in use.
  void draw_depth(const Matrix4& clip_from_studio, const Matrix4& studio_from_tree) const;

  /// Issues, with the program in use, the faces that the draw_depth() of the same matrices made visible.
  /// The program's vertex shader must set gl_Position to ftransform(): depths are compared for equality.
  /// `prepare` is called before each operand's, to set colours.
  void shade(const Matrix4& clip_from_studio, const Matrix4& studio_from_tree,
             const std::function<void(const CsgFaces&)>& prepare) const;

 private:
  struct Solid;
  CsgView(std::unique_ptr<Solid> solid, const Matrix4& tree_from_buffer);

  std::unique_ptr<Solid> solid_;
  Matrix4 tree_from_buffer_;
};

}  // namespace icome::render
