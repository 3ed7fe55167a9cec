#pragma once
#include <QString>

#include "ui/forms/quantity_text.h"
#include "ui/panels/property.h"

namespace icome::ui {

/// A size of a primitive, which other shapes do not have.
struct ShapeSize {
  const char* label;  // "Radius"
  Property<double> property;
};
/// Of all kinds of primitives; an object has those of its own kind.
std::vector<ShapeSize> shape_sizes();

/// Of implicit surfaces. What cannot be read is refused, naming the column.
Property<std::string> formula_property();

/// Figures of shapes that have no sizes to change: "1,200 triangles, 602 vertices".
QString figures_of(const world::Geometry& shape);

}  // namespace icome::ui
