#pragma once
#include "animation/motion/hands.h"
#include "ui/cutout/document/cutout_document.h"
#include "ui/cutout/table/table_follower.h"

namespace icome::ui {

/// Lets triangles on a table move the cells of a document, which outlives it.
class TableHands {
 public:
  explicit TableHands(CutoutDocument& document) : document_(document) {}

  /// Moves cells to where the triangles of a frame want them; true: what is shown has changed.
  bool take(const TableSight& sight, const cutout::KnownTriangles& known);
  /// Holds the same cells in another frame of the animation.
  void take_again();
  /// Ends holding cells; they stay where they are until they are keyed or given up.
  void let_go() { held_.clear(); }
  /// Lets triangles begin anew.
  void forget();

 private:
  CutoutDocument& document_;
  animation::Hands hands_;
  std::vector<animation::Hold> held_;  // as the last frame of the table had them
};

}  // namespace icome::ui
