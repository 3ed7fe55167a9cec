#pragma once
#include <QPainter>
#include <optional>

#include "sketch/tools/selection.h"
#include "ui/sketch/paper_view.h"

namespace icome::ui {

/// The frame around what is chosen: dragged within, it moves; by a corner it scales about the opposite one,
/// by the knob above it turns; with Ctrl a drag within it turns and scales about the middle.
class SelectionFrame {
 public:
  enum class Part { Inside, Corner, Knob, Similar };

  struct Grip {
    Part part;
    drawing::Vector2 from;    // where it was taken, m
    drawing::Vector2 about;   // what stays in place
    drawing::Vector2 corner;  // the upper left one of the chosen points, m
  };

  /// Around the chosen points; none where nothing is chosen.
  static std::optional<SelectionFrame> around(const drawing::Drawing& drawing,
                                              const sketch::Selection& selection, const PaperView& view);

  /// The part of the frame that a press at a place of the canvas takes.
  std::optional<Grip> grip(QPointF at, bool control) const;
  /// The transform of the chosen points when it is dragged to a place (m).
  static Eigen::Affine2d moved(const Grip& grip, const drawing::Vector2& to);
  /// Such a transform by which the corner is drawn to a grid of 5 mm, where the frame is moved, or the angle
  /// to a multiple of 15 degrees, where it is turned; `within`: how far a line of the grid draws, m, of which
  /// it takes a half of its step at most.
  static Eigen::Affine2d attracted(const Grip& grip, const Eigen::Affine2d& moved, double within);

  void paint(QPainter& painter) const;

 private:
  SelectionFrame(const drawing::Bounds2& box, const PaperView& view);
  QPointF knob() const;

  drawing::Bounds2 box_;  // m
  drawing::Vector2 corner_;
  PaperView view_;
};

/// Dots for the chosen points, and rings for those that hold them (figure 4.8 of the thesis).
void paint_selection(QPainter& painter, const drawing::Drawing& drawing, const sketch::Selection& selection,
                     const PaperView& view);

}  // namespace icome::ui
