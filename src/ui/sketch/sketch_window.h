#pragma once
#include <QMainWindow>
#include <QSettings>
#include <filesystem>
#include <memory>
#include <string>

#include "ui/sketch/layer_panel.h"
#include "ui/sketch/pen_panel.h"
#include "ui/sketch/sketch_canvas.h"
#include "ui/sketch/sketch_files.h"
#include "ui/window/banner.h"

class QActionGroup;
class QLabel;
class QToolBar;

namespace icome::ui {

/// The window of a drawing: the paper in the middle, messages above it, pen and layers beside it.
class SketchWindow final : public QMainWindow {
 public:
  /// `settings` is the file of a person's settings; empty: those of ICOME.
  explicit SketchWindow(const QString& settings = {}, QWidget* parent = nullptr);
  ~SketchWindow() override;  // keeps them

  /// Opens a drawing or a recording of a pen; what goes wrong stands above the paper.
  void open(const std::filesystem::path& file) { files_.open(file); }

  /// Draws with a pen that pushes back from now on, on the paper that it has.
  void take_pen(std::unique_ptr<sketch::FeltPen> pen);

  SketchDocument& document() { return document_; }
  SketchCanvas& canvas() { return *canvas_; }
  SketchLook& look() { return look_; }

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  void make_center();
  void make_docks();
  void make_status();
  void make_file_menu(QMenu& menu);
  void make_edit_menu(QMenu& menu);
  void make_stroke_menu(QMenu& menu);
  void make_view_menu(QMenu& menu);
  void make_tool_menu(QMenu& menu);
  void make_tool_bar();
  void add_switch(QMenu& menu, const char* name, const char* text, const char* tip, bool& flag);
  void add_command(QMenu& menu, const char* name, const char* text, const QKeySequence& keys,
                   const SketchDocument::Command& command);
  void show_document();
  void show_pointer(const PenInput& input);
  void show_hint();
  void tell_of_pen();
  void show_shortcuts();

  std::unique_ptr<QSettings> settings_;
  SketchDocument document_;
  SketchLook look_;
  SketchFiles files_;
  Banner* banner_ = nullptr;
  SketchCanvas* canvas_ = nullptr;
  PenPanel* pen_ = nullptr;
  LayerPanel* layers_ = nullptr;
  QActionGroup* tools_ = nullptr;
  QAction *open_ = nullptr, *save_ = nullptr, *undo_ = nullptr, *redo_ = nullptr, *fit_ = nullptr;
  std::vector<QAction*> of_selection_;  // that need one
  QLabel *hint_ = nullptr, *place_ = nullptr, *count_ = nullptr;
  bool agreed_ = false;  // a person has agreed to close
  std::unique_ptr<sketch::FeltPen> felt_pen_;
  QTimer pen_news_;       // tells of its device
  std::string pen_told_;  // about it, last
};

/// Opens a window of its own for a drawing, which is gone when it is closed; an empty page without a file.
SketchWindow& open_sketch_window(const std::filesystem::path& file);
/// Asks which drawing, and opens it likewise.
void choose_sketch(QWidget& parent);

}  // namespace icome::ui
