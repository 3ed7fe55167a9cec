#include "drawing/shape/drawing_bytes.h"

#include <drawing_generated.h>
#include <flatbuffers/flatbuffers.h>
#include <fmt/format.h>

#include <array>
#include <cstring>

#include "world/edit/flat_bytes.h"

namespace icome::drawing {
namespace {

using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;
using world::FlatReader;

constexpr std::size_t kFewestBytesOfTable = 8;  // with the offset that leads to it

// ---- Writing ------------------------------------------------------------------------------------------

template <typename Number, typename Item>
Offset<flatbuffers::Vector<Number>> numbers(FlatBufferBuilder& builder, const Item* items,
                                            std::size_t count) {
  static_assert(sizeof(Item) % sizeof(Number) == 0);
  return builder.CreateVector(reinterpret_cast<const Number*>(items), count * sizeof(Item) / sizeof(Number));
}

Offset<flat::Stroke> written(FlatBufferBuilder& builder, const Stroke& stroke) {
  const Curve& curve = stroke.curve;
  const auto points = numbers<double>(builder, curve.segments.data(), curve.segments.size());
  const auto widths = numbers<double>(builder, curve.widths.data(), curve.widths.size());
  const auto colour = numbers<float>(builder, stroke.colour.data(), stroke.colour.size());
  Offset<flatbuffers::Vector<float>> fill = 0;
  if (stroke.fill) fill = numbers<float>(builder, stroke.fill->data(), stroke.fill->size());
  return flat::CreateStroke(builder, stroke.id.value, points, widths, curve.closed, colour, stroke.opacity,
                            fill, stroke.ends == CurveEnds::Flat);
}

Offset<flat::Layer> written(FlatBufferBuilder& builder, const Layer& layer) {
  std::vector<Offset<flat::Stroke>> strokes;
  strokes.reserve(layer.strokes.size());
  for (const StrokePointer& stroke : layer.strokes) strokes.push_back(written(builder, *stroke));
  const auto name = builder.CreateString(layer.name);
  const auto all = builder.CreateVector(strokes);
  return flat::CreateLayer(builder, layer.id.value, name, layer.visible, layer.locked, all);
}

std::string finished(FlatBufferBuilder& builder) {
  return {reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize()};
}

std::size_t bytes_of(const Drawing& drawing) {
  constexpr std::size_t kOfStroke = 200, kOfLayer = 100;
  std::size_t bytes = 0;
  for (const Layer& layer : drawing.layers) {
    bytes += kOfLayer + layer.name.size();
    for (const StrokePointer& stroke : layer.strokes)
      bytes += kOfStroke + stroke->curve.segments.size() * sizeof(CubicBezier) +
               stroke->curve.widths.size() * sizeof(WidthSegment);
  }
  return bytes;
}

/// Writes each kind of change.
struct ChangeWriter {
  FlatBufferBuilder& builder;

  template <typename Table>
  Offset<flat::Change> change(Offset<Table> table) const {
    return flat::CreateChange(builder, flat::WhatTraits<Table>::enum_value, table.Union());
  }

  Offset<flat::Change> operator()(const PutStroke& it) const {
    const auto stroke = written(builder, *it.stroke);
    return change(flat::CreatePutStroke(builder, it.layer.value, it.place, stroke));
  }
  Offset<flat::Change> operator()(const TakeStroke& it) const {
    return change(flat::CreateTakeStroke(builder, it.id.value));
  }
  Offset<flat::Change> operator()(const ReplaceStroke& it) const {
    const auto stroke = written(builder, *it.stroke);
    return change(flat::CreateReplaceStroke(builder, stroke));
  }
  Offset<flat::Change> operator()(const PutLayer& it) const {
    const auto name = builder.CreateString(it.look.name);
    return change(
        flat::CreatePutLayer(builder, it.id.value, it.place, name, it.look.visible, it.look.locked));
  }
  Offset<flat::Change> operator()(const TakeLayer& it) const {
    return change(flat::CreateTakeLayer(builder, it.id.value));
  }
  Offset<flat::Change> operator()(const ChangeLayer& it) const {
    const auto name = builder.CreateString(it.look.name);
    return change(flat::CreateChangeLayer(builder, it.id.value, name, it.look.visible, it.look.locked));
  }
  Offset<flat::Change> operator()(const MoveLayer& it) const {
    return change(flat::CreateMoveLayer(builder, it.id.value, it.place));
  }
  Offset<flat::Change> operator()(const ResizePaper& it) const {
    return change(flat::CreateResizePaper(builder, it.size.x(), it.size.y()));
  }
};

// ---- Reading ------------------------------------------------------------------------------------------

/// The table at the root of the bytes if all parts of it lie within them, else null.
template <typename Table>
const Table* root_of(FlatReader& reader) {
  if (reader.size() <= world::kMostReadBytes) {
    flatbuffers::Verifier verifier(reader.data(), reader.size(), 8,
                                   flatbuffers::uoffset_t(reader.size() / kFewestBytesOfTable));
    if (verifier.VerifyBuffer<Table>(nullptr)) return flatbuffers::GetRoot<Table>(reader.data());
  }
  reader.refuse("The bytes of a drawing are damaged.");
  return nullptr;
}

std::optional<Colour> colour_of(FlatReader& reader, const flatbuffers::Vector<float>* from) {
  const std::vector<Colour> read = reader.items<Colour>(from);
  if (read.size() > 1) reader.refuse("A colour of a drawing has more than three parts.");
  if (read.empty()) return std::nullopt;
  return read.front();
}

StrokePointer stroke_of(FlatReader& reader, const flat::Stroke& from) {
  auto stroke = std::make_shared<Stroke>();
  stroke->id = StrokeId{from.id()};
  stroke->curve.segments = reader.items<CubicBezier>(from.points());
  stroke->curve.widths = reader.items<WidthSegment>(from.widths());
  stroke->curve.closed = from.closed();
  stroke->colour = colour_of(reader, from.colour()).value_or(stroke->colour);
  stroke->opacity = from.opacity();
  stroke->fill = colour_of(reader, from.fill());
  stroke->ends = from.flat_ends() ? CurveEnds::Flat : CurveEnds::Round;
  return stroke;
}

Layer layer_of(FlatReader& reader, const flat::Layer& from) {
  Layer layer{LayerId{from.id()}, reader.text(from.name()), from.visible(), from.locked(), {}};
  if (from.strokes()) {
    for (const flat::Stroke* stroke : *from.strokes()) {
      if (!reader.fault().empty()) break;
      layer.strokes.push_back(stroke_of(reader, *stroke));
    }
  }
  return layer;
}

DrawingChange change_of(FlatReader& reader, const flat::Change& from) {
  switch (from.what_type()) {
    case flat::What::PutStroke: {
      const auto& it = *from.what_as_PutStroke();
      return PutStroke{LayerId{it.layer()}, it.place(), stroke_of(reader, *it.stroke())};
    }
    case flat::What::TakeStroke:
      return TakeStroke{StrokeId{from.what_as_TakeStroke()->id()}};
    case flat::What::ReplaceStroke:
      return ReplaceStroke{stroke_of(reader, *from.what_as_ReplaceStroke()->stroke())};
    case flat::What::PutLayer: {
      const auto& it = *from.what_as_PutLayer();
      return PutLayer{LayerId{it.id()}, it.place(), {reader.text(it.name()), it.visible(), it.locked()}};
    }
    case flat::What::TakeLayer:
      return TakeLayer{LayerId{from.what_as_TakeLayer()->id()}};
    case flat::What::ChangeLayer: {
      const auto& it = *from.what_as_ChangeLayer();
      return ChangeLayer{LayerId{it.id()}, {reader.text(it.name()), it.visible(), it.locked()}};
    }
    case flat::What::MoveLayer: {
      const auto& it = *from.what_as_MoveLayer();
      return MoveLayer{LayerId{it.id()}, it.place()};
    }
    case flat::What::ResizePaper: {
      const auto& it = *from.what_as_ResizePaper();
      return ResizePaper{Vector2(it.width(), it.height())};
    }
    case flat::What::NONE:
      break;
  }
  reader.refuse("An edit of a drawing is of a kind that is unknown here.");
  return TakeStroke{};
}

}  // namespace

base::Result<std::string> drawing_bytes(const Drawing& drawing, const DrawingBody& body) {
  if (bytes_of(drawing) > world::kMostFlatBytes)
    return base::fail(
        fmt::format("A drawing of more than {} MB cannot be written.", world::kMostFlatBytes >> 20));
  FlatBufferBuilder builder;
  std::vector<Offset<flat::Layer>> layers;
  for (const Layer& layer : drawing.layers) layers.push_back(written(builder, layer));
  const auto all = builder.CreateVector(layers);
  builder.Finish(flat::CreateShape(builder, drawing.size.x(), drawing.size.y(), drawing.next_id, all,
                                   body.heights.height, body.heights.height_by_width, body.sheet));
  return finished(builder);
}

base::Result<ReadDrawing> drawing_from_bytes(std::string_view bytes) {
  FlatReader reader(bytes);
  const auto* from = root_of<flat::Shape>(reader);
  if (!from) return base::fail(reader.fault());
  ReadDrawing read;
  read.drawing.size = {from->width(), from->height()};
  read.drawing.next_id = from->next_id();
  if (from->layers()) {
    for (const flat::Layer* layer : *from->layers()) read.drawing.layers.push_back(layer_of(reader, *layer));
  }
  read.body = {{from->ridge_height(), from->ridge_height_by_width()}, from->sheet()};
  if (!reader.fault().empty()) return base::fail(reader.fault());
  return read;
}

std::string edit_bytes(const DrawingEdit& edit) {
  FlatBufferBuilder builder;
  std::vector<Offset<flat::Change>> changes;
  for (const DrawingChange& change : edit) changes.push_back(std::visit(ChangeWriter{builder}, change));
  const auto all = builder.CreateVector(changes);
  builder.Finish(flat::CreateEdit(builder, all));
  return finished(builder);
}

base::Result<DrawingEdit> edit_from_bytes(std::string_view bytes) {
  FlatReader reader(bytes);
  const auto* from = root_of<flat::Edit>(reader);
  if (!from) return base::fail(reader.fault());
  DrawingEdit edit;
  if (from->changes()) {
    for (const flat::Change* change : *from->changes()) {
      if (!reader.fault().empty()) break;
      edit.push_back(change_of(reader, *change));
    }
  }
  if (!reader.fault().empty()) return base::fail(reader.fault());
  return edit;
}

}  // namespace icome::drawing
