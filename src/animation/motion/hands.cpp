#include "animation/motion/hands.h"

#include <algorithm>

#include "animation/motion/cell_point.h"

namespace icome::animation {
namespace {

/// Whether hands may move a cell: the camera, and cells of layers that are shown and not locked.
bool is_movable(const Project& project, CellId cell) {
  if (cell == project.camera.id) return true;
  const Layer* layer = project.layer_of(cell);
  return layer && layer->visible && !layer->locked;
}

bool can_move(const Project& project, const CellStates& now, CellId cell) {
  return now.contains(cell) && is_movable(project, cell);
}

bool is_seen(const TriangleOnTable& triangle, double least_confidence) {
  return triangle.place.allFinite() && std::isfinite(triangle.angle) &&
         triangle.confidence >= least_confidence;
}

const TriangleOnTable* triangle_of(std::span<const TriangleOnTable> triangles, const std::string& id) {
  const auto found = std::find_if(triangles.begin(), triangles.end(),
                                  [&](const TriangleOnTable& triangle) { return triangle.id == id; });
  return found == triangles.end() ? nullptr : &*found;
}

}  // namespace

TableMap TableMap::fitting(double table_width, double table_height, const Stage& stage) {
  TableMap map;
  map.scale = std::min(stage.width / table_width, stage.height / table_height);
  map.corner = 0.5 * (Vector2(stage.width, stage.height) - map.scale * Vector2(table_width, table_height));
  return map;
}

std::vector<Hold> Moves::holds() const {
  std::vector<Hold> holds;
  for (const auto& [id, state] : wished) holds.push_back({id, state});
  return holds;
}

CellId Hands::held_by(const std::string& triangle) const {
  const auto found = grips_.find(triangle);
  return found == grips_.end() ? CellId{} : found->second.cell;
}

bool Hands::is_held(CellId cell) const {
  return std::any_of(grips_.begin(), grips_.end(),
                     [&](const auto& entry) { return entry.second.cell == cell; });
}

/// Ends grips whose time is over or whose mapping is another one, and lets go of cells that may not be moved
/// any more: then Nearest takes no other one.
void Hands::let_go(const Project& project, const CellStates& now, double time) {
  std::erase_if(grips_, [&](const auto& entry) {
    const Grip& grip = entry.second;
    if (time - grip.last_seen > settings_.lets_go_after) return true;
    if (std::find(project.mappings.begin(), project.mappings.end(), grip.mapping) == project.mappings.end())
      return true;
    return grip.mapping.mode != MappingMode::Nearest && !can_move(project, now, grip.cell);
  });
  for (auto& [id, grip] : grips_)
    if (!can_move(project, now, grip.cell)) grip.cell = CellId{};
}

Moves Hands::next(const Project& project, const CellStates& now, std::span<const TriangleOnTable> triangles,
                  double time, const TableMap& table, const CellUnder& cell_under) {
  for (auto& [id, grip] : grips_) {
    const TriangleOnTable* seen = triangle_of(triangles, id);
    if (seen && is_seen(*seen, settings_.least_confidence) &&
        time - grip.last_seen <= settings_.lets_go_after)
      follow(grip, *seen, time, project.smooth_hands);
  }
  let_go(project, now, time);
  for (const Mapping& mapping : project.mappings) {
    const TriangleOnTable* seen = triangle_of(triangles, mapping.triangle);
    if (seen && !grips_.contains(mapping.triangle) && is_seen(*seen, settings_.least_confidence))
      lay_down(project, now, mapping, *seen, time, table, cell_under);
  }
  Moves moves;
  for (const auto& [id, grip] : grips_)
    if (grip.cell) moves.wished[grip.cell] = wish_of(grip, now.at(grip.cell), table);
  for (const auto& [id, state] : moves.wished) moves.held.push_back(id);
  return moves;
}

void Hands::follow(Grip& grip, const TriangleOnTable& seen, double time, bool smooth) {
  if (smooth) {
    grip.place = grip.steady_place.next(seen.place, time);
    grip.angle = unwrapped(grip.steady_angle.next(seen.angle, time), grip.angle);
  } else {
    grip.steady_place.forget();
    grip.steady_angle.forget();
    grip.place = seen.place;
    grip.angle = unwrapped(seen.angle, grip.angle);
  }
  grip.last_seen = time;
}

void Hands::lay_down(const Project& project, const CellStates& now, const Mapping& mapping,
                     const TriangleOnTable& seen, double time, const TableMap& table,
                     const CellUnder& cell_under) {
  const bool is_nearest = mapping.mode == MappingMode::Nearest;
  const CellId cell =
      is_nearest ? taken_under(project, now, table.to_stage(seen.place), cell_under) : mapping.cell;
  const auto state = now.find(cell);
  const bool can_take = can_move(project, now, cell) && !is_held(cell);
  if (!can_take && !is_nearest) return;  // it may be free later
  Grip grip;
  grip.mapping = mapping;
  grip.steady_place = SteadyPlace(settings_.place);
  grip.steady_angle = SteadyAngle(settings_.angle);
  if (can_take) {
    grip.cell = cell;
    grip.start = state->second;
    grip.angle = settings_.upright + grip.start.angle;
  }
  follow(grip, seen, time, project.smooth_hands);
  grip.first_place = grip.place;
  grip.first_angle = grip.angle;
  grips_[mapping.triangle] = std::move(grip);
}

CellId Hands::taken_under(const Project& project, const CellStates& now, const Vector2& place,
                          const CellUnder& cell_under) const {
  const auto is_free = [&](CellId cell) {
    return cell != project.camera.id && can_move(project, now, cell) && !is_held(cell);
  };
  const CellId under = cell_under ? cell_under(place) : CellId{};
  if (is_free(under)) return under;
  CellId nearest;
  double least = settings_.nearest_reach;
  for (auto layer = project.layers.rbegin(); layer != project.layers.rend(); ++layer)
    for (auto cell = layer->cells.rbegin(); cell != layer->cells.rend(); ++cell) {
      if (!is_free(cell->id)) continue;
      const double distance = (now.at(cell->id).place - place).norm();
      if (distance >= least) continue;
      least = distance;
      nearest = cell->id;
    }
  return nearest;
}

CellState Hands::wish_of(const Grip& grip, const CellState& now, const TableMap& table) const {
  CellState wish = now;
  if (grip.mapping.mode == MappingMode::Absolute) {
    wish.place = table.to_stage(grip.place);
    wish.angle = grip.angle - settings_.upright;
  } else {
    wish.place = grip.start.place + table.scale * (grip.place - grip.first_place);
    wish.angle = grip.start.angle + grip.angle - grip.first_angle;
  }
  return wish;
}

}  // namespace icome::animation
