#include "animation/project/project.h"

#include <cmath>

namespace icome::animation {

Project::Project() {
  camera.id = kCamera;
  camera.name = kCameraName;
  camera.rest.place = 0.5 * Vector2(stage.width, stage.height);
  next_id = kCamera.value + 1;
}

const Cell* Project::find(CellId id) const {
  if (id == kCamera) return &camera;
  for (const Layer& layer : layers)
    for (const Cell& cell : layer.cells)
      if (cell.id == id) return &cell;
  return nullptr;
}

const Cell* Project::find(const std::string& name) const {
  if (name == camera.name) return &camera;
  for (const Layer& layer : layers)
    for (const Cell& cell : layer.cells)
      if (cell.name == name) return &cell;
  return nullptr;
}

const Layer* Project::find(LayerId id) const {
  for (const Layer& layer : layers)
    if (layer.id == id) return &layer;
  return nullptr;
}

const Layer* Project::layer_of(CellId id) const {
  for (const Layer& layer : layers)
    for (const Cell& cell : layer.cells)
      if (cell.id == id) return &layer;
  return nullptr;
}

std::size_t Project::cell_count() const {
  std::size_t count = 0;
  for (const Layer& layer : layers) count += layer.cells.size();
  return count;
}

CellState state_at(const Cell& cell, double frame) {
  CellState state = cell.rest;
  for (const Channel channel : kAllChannels) {
    const Track& track = cell.tracks[std::size_t(channel)];
    if (!track.empty()) set_channel(state, channel, value_at(track, channel, frame, 0));
  }
  return state;
}

double channel_of(const CellState& state, Channel channel) {
  switch (channel) {
    case Channel::X:
      return state.place.x();
    case Channel::Y:
      return state.place.y();
    case Channel::Angle:
      return state.angle;
    case Channel::Scale:
      return state.scale;
    case Channel::Opacity:
      return state.opacity;
    case Channel::Picture:
      return state.picture;
  }
  return 0;
}

void set_channel(CellState& state, Channel channel, double value) {
  switch (channel) {
    case Channel::X:
      state.place.x() = value;
      break;
    case Channel::Y:
      state.place.y() = value;
      break;
    case Channel::Angle:
      state.angle = value;
      break;
    case Channel::Scale:
      state.scale = value;
      break;
    case Channel::Opacity:
      state.opacity = value;
      break;
    case Channel::Picture:
      state.picture = int(value);
      break;
  }
}

Vector2 on_stage(const Cell& cell, const CellState& state, const PointOnCell& point) {
  const double cosine = std::cos(state.angle), sine = std::sin(state.angle);
  const Vector2 way = state.scale * (point - cell.pivot);
  return state.place + Vector2(cosine * way.x() + sine * way.y(), cosine * way.y() - sine * way.x());
}

PointOnCell on_cell(const Cell& cell, const CellState& state, const Vector2& place) {
  if (state.scale == 0) return cell.pivot;
  const double cosine = std::cos(state.angle), sine = std::sin(state.angle);
  const Vector2 way = (place - state.place) / state.scale;
  return cell.pivot + Vector2(cosine * way.x() - sine * way.y(), sine * way.x() + cosine * way.y());
}

std::vector<CellId> cells_of(const Constraint& constraint) {
  struct Cells {
    std::vector<CellId> operator()(const DistanceLimit& limit) const { return {limit.one, limit.other}; }
    std::vector<CellId> operator()(const Joint& joint) const { return {joint.parent, joint.child}; }
    std::vector<CellId> operator()(const Chain& chain) const { return chain.cells; }
    std::vector<CellId> operator()(const PathGuide& guide) const { return {guide.cell}; }
    std::vector<CellId> operator()(const AxisGuide& guide) const { return {guide.cell}; }
  };
  return std::visit(Cells{}, constraint.what);
}

}  // namespace icome::animation
