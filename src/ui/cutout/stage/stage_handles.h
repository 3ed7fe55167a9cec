#pragma once
#include <QPainter>
#include <array>
#include <optional>
#include <vector>

#include "ui/cutout/document/cutout_document.h"
#include "ui/cutout/stage/stage_scale.h"

namespace icome::ui {

/// The part of what is selected that the pointer has hold of.
enum class StageGrip : std::uint8_t { None, Move, Turn, Scale, Pivot };

/// The frame around what is selected, with its handles, in pixels of the screen.
struct HandleFrame {
  std::array<QPointF, 4> corners;  // as the picture has them where one cell is selected
  QPointF top;                     // the middle of its upper side
  QPointF turn;                    // the handle that turns
  std::optional<QPointF> pivot;    // a single cell's
};

/// The corners of a cell on the stage; of the camera, those of what it sees. None where nothing is shown.
std::optional<std::array<animation::Vector2, 4>> corners_of(CutoutDocument& document, CellId cell);

/// None where nothing that is selected is shown.
std::optional<HandleFrame> handle_frame(CutoutDocument& document,
                                        const animation::Affine2& screen_from_stage);
/// The handle at a place of the screen; Move within the frame. The pivot often lies where a cell is dragged,
/// so it is a handle only where that is asked for.
StageGrip grip_at(const HandleFrame& frame, QPointF at, bool takes_pivot);
void paint_handles(QPainter& painter, const HandleFrame& frame, StageGrip under_pointer);

/// A drag of selected cells: how they lay before, and where it began.
struct StageDrag {
  StageGrip grip = StageGrip::None;
  CellStates start;
  animation::Vector2 from = animation::Vector2::Zero();    // px on the stage, where it began
  animation::Vector2 middle = animation::Vector2::Zero();  // about which it turns and scales
};

/// Begins a drag at a place of the stage.
StageDrag begin_drag(const CutoutDocument& document, StageGrip grip, const animation::Vector2& from);
/// The wishes for the cells that are selected when the pointer has come to `to`. `strict`: along one axis
/// only, and in steps of 15 degrees.
std::vector<animation::Hold> dragged(const CutoutDocument& document, const StageDrag& drag,
                                     const animation::Vector2& to, bool strict);
/// Wishes for the cells that are selected, moved by so much.
std::vector<animation::Hold> nudged(const CutoutDocument& document, const animation::Vector2& by);

/// The command that sets the pivot of a cell to a place of the stage, while its pictures stay where they are.
std::optional<interaction::Value> pivot_command(const CutoutDocument& document, CellId cell,
                                                const animation::Vector2& place);

}  // namespace icome::ui
