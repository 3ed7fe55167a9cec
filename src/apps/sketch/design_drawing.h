#pragma once
#include <filesystem>
#include <string>

#include "base/result.h"
#include "drawing/drawing_edit.h"
#include "drawing/shape/drawing_shape.h"
#include "files/design.h"

namespace icome::apps {

/// Does the path name a design other than an SVG file, so that a drawing in it is an object among others?
bool names_design(const std::filesystem::path& path);

/// A drawing that is an object of a design.
struct DesignDrawing {
  files::LoadedDesign design;
  world::GeometryId geometry;  ///< of a drawing::DrawingShape

  const drawing::Drawing& drawing() const;
  /// Changes the drawing in the design, as edits of the window do.
  base::Result<void> perform(const drawing::DrawingEdit& edit);
};

/// Reads a design with a drawing: the object of that name or, without one, the only drawing there is. Fails,
/// naming the drawings, where that does not tell which one.
base::Result<DesignDrawing> read_design_drawing(const std::filesystem::path& path, const std::string& object);

}  // namespace icome::apps
