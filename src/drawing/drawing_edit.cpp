#include "drawing/drawing_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace icome::drawing {
namespace {

constexpr double kKilometresOfMetre = 1e-3;
constexpr double kJoined = 1e-6;  // of the largest coordinate, or of the number of segments

std::string complaint_about_segments(const std::vector<CubicBezier>& segments) {
  double largest = 0.0;
  for (const CubicBezier& segment : segments) {
    for (const Vector2& point : segment.points) {
      if (!point.allFinite()) return "a stroke has a place that is not finite";
      largest = std::max(largest, point.cwiseAbs().maxCoeff());
    }
  }
  if (largest > kLargestDrawing)
    return fmt::format("a stroke reaches farther than {:g} km from the paper's corner",
                       kLargestDrawing * kKilometresOfMetre);
  for (std::size_t i = 1; i < segments.size(); ++i) {
    if ((segments[i].points[0] - segments[i - 1].points[3]).norm() > kJoined * largest)
      return "the segments of a stroke do not join";
  }
  return {};
}

std::string complaint_about_widths(const Curve& curve) {
  const double slack = kJoined * curve.end();
  double place = 0.0;
  for (const WidthSegment& piece : curve.widths) {
    for (const double width : {piece.from_width, piece.to_width})
      if (!(width >= 0.0 && width <= kLargestDrawing))
        return fmt::format("a width is from 0 to {:g} km", kLargestDrawing * kKilometresOfMetre);
    if (!(std::abs(piece.from - place) <= slack && piece.to >= piece.from))
      return "the widths of a stroke do not join";
    place = piece.to;
  }
  if (!curve.widths.empty() && !(std::abs(place - curve.end()) <= slack))
    return "the widths of a stroke do not reach to its end";
  return {};
}

std::string complaint(const Stroke& stroke) {
  if (!stroke.id) return "a stroke needs an id";
  if (stroke.curve.segments.empty()) return "a stroke needs a segment";
  if (!(stroke.opacity >= 0.0 && stroke.opacity <= 1.0)) return "an opacity is from 0 to 1";
  for (const float part : stroke.colour)
    if (!std::isfinite(part)) return "a colour is finite";
  if (stroke.fill) {
    for (const float part : *stroke.fill)
      if (!std::isfinite(part)) return "a colour is finite";
  }
  if (std::string why = complaint_about_segments(stroke.curve.segments); !why.empty()) return why;
  return complaint_about_widths(stroke.curve);
}

constexpr const char* kBadPaper = "the paper needs a width and a height above 0";

bool is_paper(const Vector2& size) {
  return size.allFinite() && size.minCoeff() > 0.0 && size.maxCoeff() <= kLargestDrawing;
}

/// Applies parts one after the other to a drawing of its own.
class Applying {
 public:
  explicit Applying(Drawing& drawing) : drawing_(drawing) {}

  using Undone = base::Result<DrawingChange>;

  Undone operator()(const PutStroke& part) {
    Layer* const layer = find_layer(part.layer);
    if (layer == nullptr) return base::fail(no_layer(part.layer));
    if (!part.stroke) return base::fail("there is no stroke to put");
    if (const std::string why = complaint(*part.stroke); !why.empty()) return base::fail(why);
    if (drawing_.find(part.stroke->id) != nullptr || find_layer(LayerId{part.stroke->id.value}) != nullptr)
      return base::fail(fmt::format("the number {} is taken already", part.stroke->id.value));
    if (part.place > layer->strokes.size())
      return base::fail(fmt::format("layer \"{}\" has {} strokes, so there is no place {}", layer->name,
                                    layer->strokes.size(), part.place));
    layer->strokes.insert(layer->strokes.begin() + std::ptrdiff_t(part.place), part.stroke);
    drawing_.next_id = std::max(drawing_.next_id, part.stroke->id.value + 1);
    return DrawingChange(TakeStroke{part.stroke->id});
  }

  Undone operator()(const TakeStroke& part) {
    const auto [layer, place] = find_stroke(part.id);
    if (layer == nullptr) return base::fail(no_stroke(part.id));
    const PutStroke back = {layer->id, place, layer->strokes[place]};
    layer->strokes.erase(layer->strokes.begin() + std::ptrdiff_t(place));
    return DrawingChange(back);
  }

  Undone operator()(const ReplaceStroke& part) {
    if (!part.stroke) return base::fail("there is no stroke to put");
    if (const std::string why = complaint(*part.stroke); !why.empty()) return base::fail(why);
    const auto [layer, place] = find_stroke(part.stroke->id);
    if (layer == nullptr) return base::fail(no_stroke(part.stroke->id));
    const ReplaceStroke back = {layer->strokes[place]};
    layer->strokes[place] = part.stroke;
    return DrawingChange(back);
  }

  Undone operator()(const PutLayer& part) {
    if (!part.id || find_layer(part.id) != nullptr || drawing_.find(StrokeId{part.id.value}) != nullptr)
      return base::fail(fmt::format("the number {} is taken already", part.id.value));
    if (part.place > drawing_.layers.size())
      return base::fail(
          fmt::format("there are {} layers, so there is no place {}", drawing_.layers.size(), part.place));
    drawing_.layers.insert(drawing_.layers.begin() + std::ptrdiff_t(part.place),
                           Layer{part.id, part.look.name, part.look.visible, part.look.locked, {}});
    drawing_.next_id = std::max(drawing_.next_id, part.id.value + 1);
    return DrawingChange(TakeLayer{part.id});
  }

  Undone operator()(const TakeLayer& part) {
    Layer* const layer = find_layer(part.id);
    if (layer == nullptr) return base::fail(no_layer(part.id));
    if (!layer->strokes.empty()) return base::fail(fmt::format("layer \"{}\" has strokes", layer->name));
    const PutLayer back = {part.id, std::size_t(layer - drawing_.layers.data()), look_of(*layer)};
    drawing_.layers.erase(drawing_.layers.begin() + std::ptrdiff_t(back.place));
    return DrawingChange(back);
  }

  Undone operator()(const ChangeLayer& part) {
    Layer* const layer = find_layer(part.id);
    if (layer == nullptr) return base::fail(no_layer(part.id));
    const ChangeLayer back = {part.id, look_of(*layer)};
    layer->name = part.look.name;
    layer->visible = part.look.visible;
    layer->locked = part.look.locked;
    return DrawingChange(back);
  }

  Undone operator()(const MoveLayer& part) {
    Layer* const layer = find_layer(part.id);
    if (layer == nullptr) return base::fail(no_layer(part.id));
    if (part.place >= drawing_.layers.size())
      return base::fail(
          fmt::format("there are {} layers, so there is no place {}", drawing_.layers.size(), part.place));
    const std::size_t from = std::size_t(layer - drawing_.layers.data());
    const auto begin = drawing_.layers.begin();
    if (from < part.place) {
      std::rotate(begin + std::ptrdiff_t(from), begin + std::ptrdiff_t(from) + 1,
                  begin + std::ptrdiff_t(part.place) + 1);
    } else {
      std::rotate(begin + std::ptrdiff_t(part.place), begin + std::ptrdiff_t(from),
                  begin + std::ptrdiff_t(from) + 1);
    }
    return DrawingChange(MoveLayer{part.id, from});
  }

  Undone operator()(const ResizePaper& part) {
    if (!is_paper(part.size)) return base::fail(kBadPaper);
    const ResizePaper back = {drawing_.size};
    drawing_.size = part.size;
    return DrawingChange(back);
  }

 private:
  struct StrokePlace {
    Layer* layer;
    std::size_t place;
  };

  static LayerLook look_of(const Layer& layer) { return {layer.name, layer.visible, layer.locked}; }
  static std::string no_layer(LayerId id) { return fmt::format("there is no layer {}", id.value); }
  static std::string no_stroke(StrokeId id) { return fmt::format("there is no stroke {}", id.value); }

  Layer* find_layer(LayerId id) {
    const auto found = std::find_if(drawing_.layers.begin(), drawing_.layers.end(),
                                    [&](const Layer& l) { return l.id == id; });
    return found == drawing_.layers.end() ? nullptr : &*found;
  }

  StrokePlace find_stroke(StrokeId id) {
    for (Layer& layer : drawing_.layers)
      for (std::size_t i = 0; i < layer.strokes.size(); ++i)
        if (layer.strokes[i]->id == id) return {&layer, i};
    return {nullptr, 0};
  }

  Drawing& drawing_;
};

}  // namespace

DrawingEdit edit_of(DrawingChange change) {
  DrawingEdit edit;
  edit.push_back(std::move(change));
  return edit;
}

base::Result<void> check_drawing(const Drawing& drawing) {
  if (!is_paper(drawing.size)) return base::fail(kBadPaper);
  std::set<std::uint64_t> numbers;
  const auto take = [&](std::uint64_t number) {
    return number != 0 && number < drawing.next_id && numbers.insert(number).second;
  };
  for (const Layer& layer : drawing.layers) {
    if (!take(layer.id.value)) return base::fail(fmt::format("a layer has the number {}", layer.id.value));
    for (const StrokePointer& stroke : layer.strokes) {
      if (!stroke) return base::fail("a stroke is missing");
      if (const std::string why = complaint(*stroke); !why.empty()) return base::fail(why);
      if (!take(stroke->id.value))
        return base::fail(fmt::format("a stroke has the number {}", stroke->id.value));
    }
  }
  return {};
}

base::Result<DrawingEdit> apply_edit(Drawing& drawing, const DrawingEdit& edit) {
  Applying applying(drawing);
  return base::apply_parts(applying, edit);
}

}  // namespace icome::drawing
