#pragma once
#include <QWidget>
#include <filesystem>
#include <functional>

#include "ui/sketch/sketch_document.h"
#include "ui/window/note.h"

namespace icome::ui {

/// Opens and saves the drawing of a window, and asks before unsaved work is lost. Dialogs are children of the
/// window, and nothing here waits for one. Document and window outlive it.
class SketchFiles {
 public:
  SketchFiles(SketchDocument& document, QWidget& window) : document_(document), window_(window) {}
  SketchFiles(const SketchFiles&) = delete;
  SketchFiles& operator=(const SketchFiles&) = delete;

  /// Sets who tells a person what was done, or what went wrong with a file.
  void on_note(std::function<void(const Note&)> tell) { tell_ = std::move(tell); }

  /// Opens a drawing or a recording of a pen in place of the present drawing, without a question.
  void open(const std::filesystem::path& file);
  /// Asks which, once unsaved work is saved or given up.
  void choose_and_open();
  void save();
  void save_as();
  /// Writes a picture; the drawing is as unsaved as before.
  void choose_and_export();
  /// Calls `then` when no work would be lost: at once, after saving, or after it was given up; not at all
  /// when the person cancels.
  void when_safe(const std::function<void()>& then);
  /// The file's name for people, or "Untitled drawing".
  QString name() const;

 private:
  void save_to(const std::filesystem::path& file);
  void fail(const std::string& why);

  SketchDocument& document_;
  QWidget& window_;
  std::function<void(const Note&)> tell_ = [](const Note&) {};
  std::function<void()> then_;  // to be called once the work is saved
  bool asking_ = false;
};

/// The filters of a dialog that opens drawings and recordings of pens.
QStringList sketch_open_filters();

}  // namespace icome::ui
