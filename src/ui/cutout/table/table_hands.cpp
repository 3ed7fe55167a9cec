#include "ui/cutout/table/table_hands.h"

namespace icome::ui {

bool TableHands::take(const TableSight& sight, const cutout::KnownTriangles& known) {
  std::vector<animation::TriangleOnTable> triangles;
  for (const cutout::Sighting& seen : sight.seen)
    triangles.push_back({.id = known.triangles[seen.triangle].id,
                         .place = seen.pose.centroid,
                         .angle = seen.pose.angle,
                         .confidence = seen.confidence});
  const auto map =
      animation::TableMap::fitting(sight.table_width, sight.table_height, document_.project().stage);
  const auto cell_under = [this](const animation::Vector2& place) {
    return animation::cell_at(document_.project(), document_.shown(), document_.pictures(), place)
        .value_or(CellId());
  };
  held_ = hands_.next(document_.project(), document_.shown(), triangles, sight.time, map, cell_under).holds();
  return !held_.empty() && document_.try_out(held_);
}

void TableHands::take_again() {
  if (!held_.empty()) document_.try_out(held_);
}

void TableHands::forget() {
  hands_.forget();
  held_.clear();
}

}  // namespace icome::ui
