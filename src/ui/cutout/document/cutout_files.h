#pragma once
#include <QWidget>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "ui/cutout/document/cutout_document.h"
#include "ui/cutout/document/export_job.h"
#include "ui/cutout/run_cutout.h"
#include "ui/window/note.h"

namespace icome::ui {

/// Opens, saves and exports the animation of a window, brings in pictures and sound, and asks before unsaved
/// work is lost. Dialogs are children of the window, and nothing here waits for one. Document and window
/// outlive it.
class CutoutFiles {
 public:
  CutoutFiles(CutoutDocument& document, QWidget& window) : document_(document), window_(window) {}
  CutoutFiles(const CutoutFiles&) = delete;
  CutoutFiles& operator=(const CutoutFiles&) = delete;

  /// Sets who tells a person what was done, or what went wrong with a file.
  void on_note(std::function<void(const Note&)> tell) { tell_ = std::move(tell); }
  /// Sets who hears of files that were opened or saved.
  void on_used(std::function<void(const std::filesystem::path&)> used) { used_ = std::move(used); }
  /// Hears the part of an export that is done, below 0 when none is under way.
  void on_progress(std::function<void(double part)> progress) { progress_ = std::move(progress); }

  /// Opens an animation in place of the present one, without a question.
  void open(const std::filesystem::path& file);
  /// Asks which, once unsaved work is saved or given up.
  void choose_and_open();
  void save();
  void save_as();
  /// Calls `then` when no work would be lost: at once, after saving, or after it was given up; not at all
  /// when the person cancels.
  void when_safe(const std::function<void()>& then);
  /// The file's name for people, or "Untitled animation".
  QString name() const;

  /// Asks for pictures, and makes a cell of each, or one cell of all.
  void choose_pictures(bool one_cell);
  /// Asks for pictures that the leading cell gets, too.
  void choose_more_pictures();
  /// Asks for a folder, and makes one cell of its pictures, one after the other, or a cell of each.
  void choose_folder(bool one_cell);
  void choose_sound();
  /// Lets the animation have a sound, unless it cannot be read, which is told.
  void use_sound(const std::filesystem::path& file);
  /// Makes a cell of each picture, or one cell of all. Those that cannot be read are left out, and told.
  void add_cells(const std::vector<std::filesystem::path>& files, bool one_cell);
  /// Makes cells of the pictures of a folder likewise.
  void import_folder(const std::filesystem::path& folder, bool one_cell);
  /// Makes cells of pictures, folders and animations that were dropped; opens an animation among them.
  void take_dropped(const std::vector<std::filesystem::path>& files);

  /// Asks where to, and writes a film or pictures while the window lives on.
  void choose_and_export(const animation::ExportOptions& options);
  void export_to(const std::string& out, const animation::ExportOptions& options);
  /// Likewise, but asks first where pictures of a sequence would be written over others.
  void export_if_agreed(const std::string& out, const animation::ExportOptions& options);
  void cancel_export();
  bool is_exporting() const { return bool(job_); }

 private:
  void save_to(std::filesystem::path file);
  void save_if_agreed(const std::filesystem::path& file);
  void fail(const std::string& why);
  std::vector<std::string> readable_of(const std::vector<std::filesystem::path>& files);
  void tell_left_out(const std::vector<std::string>& problems, std::size_t all);
  void tell_exported(const base::Result<animation::ExportReport>& report);

  CutoutDocument& document_;
  QWidget& window_;
  std::function<void(const Note&)> tell_ = [](const Note&) {};
  std::function<void(const std::filesystem::path&)> used_ = [](const std::filesystem::path&) {};
  std::function<void(double)> progress_ = [](double) {};
  std::function<void()> then_;  // to be called once the work is saved
  bool asking_ = false;
  std::unique_ptr<ExportJob> job_;
};

/// The topic of the note that work was recovered, which is void once it is saved.
inline constexpr const char* kRecoveredTopic = "recovered";

/// The filters of a dialog that opens animations.
QStringList cutout_open_filters();

/// The file, pattern or folder that a typed name means as the export's: frames of PNG and SVG get a number in
/// their names where they have none.
QString export_name(const QString& typed);

}  // namespace icome::ui
