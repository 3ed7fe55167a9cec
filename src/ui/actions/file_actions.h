#pragma once
#include <QAction>
#include <QMenu>
#include <filesystem>
#include <functional>
#include <optional>

#include "session/session.h"
#include "ui/actions/recent_files.h"
#include "ui/window/note.h"

namespace icome::ui {

/// The file menu: new, open and save, and the question before unsaved work is lost. Dialogs are children of
/// the window, and nothing here waits for one. Session and window outlive it.
class FileActions {
 public:
  FileActions(session::Session& session, QSettings& settings, QWidget& window);
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  /// Adds the actions to the menu.
  void fill(QMenu& menu);
  QAction* open_design() const { return open_; }
  QAction* save_design() const { return save_; }

  /// Sets a hook that is called before an action here touches the design, for example to end a drag. Where it
  /// returns false, the action does not take place.
  void on_begin(std::function<bool()> begin) { begin_ = std::move(begin); }

  /// Sets hooks that are called when the design is written, and before it is left.
  void on_save(std::function<void()> saving) { saving_ = std::move(saving); }
  void on_leave(std::function<void()> leaving) { leaving_ = std::move(leaving); }

  /// Opens the design, once unsaved work is saved or given up.
  void open(const std::filesystem::path& design);
  void recover(const std::filesystem::path& journal);
  /// Goes back to the file as it was last saved; to a new design where there is no file.
  void revert();
  /// Begins a new design, likewise.
  void leave() { start(); }
  void choose_and_open();
  /// Joins a design on a server, likewise.
  void open_address(const QString& address);
  void choose_address();
  /// Puts a design that was made alone into this one, under the selected object if it is one.
  void choose_and_integrate();
  void save();
  void save_again();
  void save_as();
  /// Calls `then` when no work would be lost any more: at once, after saving, or after a person has given the
  /// work up; not at all when the person cancels.
  void when_safe(const std::function<void()>& then);

  /// Handles an event of the session; returns the note that tells of it.
  Note hear(const session::SessionEvent& event);
  /// Name of the design for people: its file name, or "Untitled".
  QString design_name() const;
  /// Tells people which file is being read or written; null when none is.
  QString doing() const;

 private:
  void start();
  void make_new();
  void forget_missing();
  void fill_recent();
  void renew_keep();
  void begin_save(const std::filesystem::path& design);
  Note hear_of_cancelled(const session::SessionEvent& event);
  void ask(const std::function<void()>& then);
  void ask_to_replace(const session::SessionEvent& event);

  session::Session& session_;
  QSettings& settings_;
  QWidget& window_;
  RecentFiles recent_;
  QMenu* recent_menu_ = nullptr;
  QAction *open_ = nullptr, *save_ = nullptr, *keep_ = nullptr;
  std::function<bool()> begin_ = [] { return true; };
  std::function<void()> saving_ = [] {}, leaving_ = [] {};
  std::function<void()> then_ = {};                         // called once the work is saved
  std::filesystem::path opened_ = {};                       // the file being read
  std::filesystem::path saved_ = {};                        // the file that was, or is being, written
  std::optional<session::RecoverableWork> recovered_ = {};  // the recovery asked for last
  bool given_up_ = false;                                   // reading, cancelled by an edit of the design
  bool asking_ = false;
};

/// Filters of file dialogs: all formats together, then each, to open; the writable formats, to save.
QStringList open_filters();
QStringList save_filters();
/// The first file extension of a filter, without the dot: "wrl" for "VRML 2.0 (*.wrl *.vrml)".
QString ending_of(const QString& filter);

}  // namespace icome::ui
