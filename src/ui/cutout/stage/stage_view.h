#pragma once
#include <QImage>
#include <QWidget>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "ui/cutout/cutout_look.h"
#include "ui/cutout/stage/stage_handles.h"

namespace icome::ui {

/// The stage of an animation: shows the present frame, and takes mouse and keys to select, move, turn and
/// scale cells. Document and look outlive it.
class StageView final : public QWidget {
 public:
  StageView(CutoutDocument& document, const CutoutLook& look, QWidget* parent);

  /// Shows the document as it is now.
  void refresh();
  /// Shows cells that have moved, and draws only the parts of the picture that they have changed.
  void show_moved();
  /// Shows another frame; what is dragged goes on in it.
  void follow_frame();
  void fit();
  void zoom(double factor);  // about the middle
  const StageScale& scale() const { return scale_; }
  animation::Affine2 screen_from_stage() const;
  /// Ends holding cells, which stay as their keys have them.
  void let_go();
  /// Backs out of a drag, of places that are asked for, else of the selection.
  void back_out();

  /// Asks a person to click on places of the stage; `use` gets them (px) once there are `most`, or on Enter
  /// when there are `least`. A later question takes the place of an earlier one.
  void ask_places(const QString& words, std::size_t least, std::size_t most,
                  std::function<void(const std::vector<animation::Vector2>&)> use);
  bool is_asking() const { return bool(use_places_); }
  /// Large words over the stage, such as a count-in; none: an empty text.
  void show_words(const QString& words);

  /// Frames the stage in red, while what is moved is recorded.
  void show_recording(bool recording);

  /// Hears of the place (px on the stage) that the pointer comes to.
  void on_pointer(std::function<void(const animation::Vector2&)> pointer) { pointer_ = std::move(pointer); }
  /// Hears of files that were dropped there.
  void on_drop(std::function<void(const std::vector<std::filesystem::path>&)> drop) {
    drop_ = std::move(drop);
  }
  /// Called when the picture of the present state has been painted.
  void on_painted(std::function<void()> painted) { painted_ = std::move(painted); }
  /// Makes the menu of a cell under the pointer.
  void on_menu(std::function<void(QPoint)> menu) { menu_ = std::move(menu); }
  /// Hears the question that is asked, and an empty text when it is answered or given up.
  void on_question(std::function<void(const QString&)> question) { question_ = std::move(question); }

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  enum class Contact : std::uint8_t { None, Shift, Press, Drag, Marquee };

  animation::Vector2 on_stage(QPointF at) const { return screen_from_stage().inverse() * place_of(at); }
  std::optional<CellId> cell_under(QPointF at);
  bool camera_under(QPointF at);
  void press(QPointF at, Qt::KeyboardModifiers modifiers);
  void drag_to(QPointF at, bool strict);
  void select_within(const QRectF& marquee, bool more);
  void add_place(QPointF at);
  void end_question(bool use);
  void show_cursor(QPointF at);
  void renew_picture();
  void renew_skins(const animation::FrameOptions& options);
  QRegion changed_part(const animation::Affine2& pixels_from_stage);
  void draw_part(const QRect& part, const animation::Affine2& pixels_from_stage);
  void paint_surroundings(QPainter& painter);
  void paint_hover(QPainter& painter);
  void paint_question(QPainter& painter);
  void paint_words(QPainter& painter);
  void paint_beginning(QPainter& painter);
  bool nudge(const QKeyEvent& event);

  CutoutDocument& document_;
  const CutoutLook& look_;
  StageScale scale_;
  bool is_fitted_ = true;  // the stage is seen whole, also when the widget changes its size
  QImage picture_;
  QImage skins_;           // other poses, over it; null: none
  bool is_stale_ = true;   // all of the picture
  bool is_moved_ = false;  // cells lie otherwise than the picture has them
  CellStates drawn_;       // as the picture has them
  animation::Affine2 drawn_map_ =
      animation::Affine2::Identity();  // pixels of the picture from px of the stage
  Contact contact_ = Contact::None;
  StageDrag drag_;
  int drag_frame_ = 0;                  // the animation's, in which it began
  std::size_t steps_before_nudge_ = 0;  // of undo, before a key was pressed that moves cells
  QPointF pressed_, last_;
  bool strict_ = false;  // a drag goes along one axis, or in steps of an angle
  StageGrip under_ = StageGrip::None;
  std::optional<CellId> hovered_;
  std::optional<animation::Vector2> pivot_;  // while it is dragged, px on the stage
  QString words_;
  bool is_recording_ = false;
  QString asked_;
  std::vector<animation::Vector2> places_;
  std::size_t least_places_ = 1, most_places_ = 1;
  std::function<void(const std::vector<animation::Vector2>&)> use_places_;
  std::function<void(const animation::Vector2&)> pointer_ = [](const animation::Vector2&) {};
  std::function<void(const std::vector<std::filesystem::path>&)> drop_ =
      [](const std::vector<std::filesystem::path>&) {};
  std::function<void()> painted_ = [] {};
  std::function<void(QPoint)> menu_ = [](QPoint) {};
  std::function<void(const QString&)> question_ = [](const QString&) {};
};

/// Draws joints, chains, distances, paths and axes over the stage; those of cells that are selected stand
/// out.
void paint_constraints(QPainter& painter, const CutoutDocument& document,
                       const animation::Affine2& screen_from_stage);

}  // namespace icome::ui
