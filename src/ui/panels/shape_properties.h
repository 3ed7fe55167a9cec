#pragma once
#include <QString>

#include "ui/forms/quantity_text.h"
#include "ui/panels/property.h"

namespace icome::ui {

/// A size of one kind of primitive, which other shapes do not have.
struct ShapeSize {
  const char* label;  // "Radius"
  Property<double> property;
};
/// The sizes of all kinds of primitives; an object has those of its own kind.
std::vector<ShapeSize> shape_sizes();

/// The formula of an implicit surface. Setting one that cannot be read fails, naming the column.
Property<std::string> formula_property();

/// Figures of a shape that has no sizes to change: "1,200 triangles, 602 vertices"; else empty.
QString figures_of(const world::Geometry& shape);

}  // namespace icome::ui
