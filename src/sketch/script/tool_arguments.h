#pragma once
#include "sketch/script/sketch_tool.h"
#include "sketch/tools/pick.h"

namespace icome::sketch {

using interaction::Parameter;
using interaction::ParameterKind;

constexpr double kMillimetre = 0.001;     // m
constexpr double kFarthestOnPaper = 1e6;  // mm: places beyond are taken for mistakes
constexpr double kNearby = 0.02;          // m, up to which a place means a stroke

// Parameters that several tools have.
Parameter place_parameter(const char* name, const char* meaning, bool required);
Parameter way_parameter(const char* name, const char* meaning, std::size_t components = 2);
Parameter length_parameter(const char* name, const char* meaning, double fallback, double least, double most);
/// "stroke" and "at", of which picked_stroke() takes one.
std::vector<Parameter> stroke_parameters();

/// The place (m) of a parameter of two numbers in mm.
base::Result<Vector2> place_of(const Arguments& arguments, std::string_view name);
/// A list of places, m.
std::vector<Vector2> way_of(const Arguments& arguments, std::string_view name);
double length_of(const Arguments& arguments, std::string_view name);  // m

/// A stroke that may be changed, and where it was pointed at (its start if it was only named).
struct PickedStroke {
  StrokePointer stroke;
  double place;
  Vector2 point;  // m, as given
};
/// The stroke of that number, at its place nearest to "at"; without a number the nearest stroke that is
/// within kNearby. Fails where there is none, and where its layer is hidden or locked.
base::Result<PickedStroke> picked_stroke(const Drafting& drafting, const Arguments& arguments);
base::Result<StrokePointer> stroke_numbered(const Drafting& drafting, std::uint64_t number);

/// The edit that gives a stroke another curve.
DrawingEdit with_curve(const Stroke& stroke, Curve curve);

/// The strokes that a look is given to: the one that is named, else all that are chosen.
base::Result<std::vector<StrokePointer>> meant_strokes(const Drafting& drafting, const Arguments& arguments);

/// The layer of that name, or of that number as "#3"; fails with the names that there are.
base::Result<const Layer*> layer_named(const Drawing& drawing, const std::string& name);

}  // namespace icome::sketch
