#include "drawing/drawing_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace icome::drawing {
namespace {

std::string complaint(const Stroke& stroke) {
  if (!stroke.id) return "a stroke needs an id";
  if (stroke.curve.segments.empty()) return "a stroke needs a segment";
  if (!(stroke.opacity >= 0.0 && stroke.opacity <= 1.0)) return "an opacity is from 0 to 1";
  for (const CubicBezier& segment : stroke.curve.segments)
    for (const Vector2& point : segment.points)
      if (!point.allFinite()) return "a stroke has a place that is not finite";
  for (const WidthSegment& piece : stroke.curve.widths) {
    if (!(std::isfinite(piece.from_width) && std::isfinite(piece.to_width)) || piece.from_width < 0.0 ||
        piece.to_width < 0.0) {
      return "a width is finite and not negative";
    }
  }
  return {};
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
    if (!(part.size.allFinite() && part.size.minCoeff() > 0.0))
      return base::fail("the paper needs a width and a height above 0");
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

base::Result<DrawingEdit> apply_edit(Drawing& drawing, const DrawingEdit& edit) {
  DrawingEdit back;
  Applying applying(drawing);
  for (const DrawingChange& part : edit) {
    auto undone = std::visit(applying, part);
    if (!undone) {
      for (auto step = back.rbegin(); step != back.rend(); ++step) std::visit(applying, *step);
      return tl::unexpected(undone.error());
    }
    back.push_back(std::move(*undone));
  }
  std::reverse(back.begin(), back.end());
  return back;
}

base::Result<void> DrawingHistory::perform(const DrawingEdit& edit) {
  auto back = apply_edit(drawing_, edit);
  if (!back) return tl::unexpected(back.error());
  undo_.push_back(std::move(*back));
  redo_.clear();
  return {};
}

bool DrawingHistory::step(std::vector<DrawingEdit>& from, std::vector<DrawingEdit>& to) {
  if (from.empty()) return false;
  auto back = apply_edit(drawing_, from.back());
  from.pop_back();
  if (!back) return false;
  to.push_back(std::move(*back));
  return true;
}

bool DrawingHistory::undo() { return step(undo_, redo_); }
bool DrawingHistory::redo() { return step(redo_, undo_); }

}  // namespace icome::drawing
