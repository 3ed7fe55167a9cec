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

/// The design as a file: new, open, save, and what to ask before work would be lost. Dialogs belong to the
/// window; nothing here waits for one. Session and window outlive it.
class FileActions {
 public:
  FileActions(session::Session& session, QSettings& settings, QWidget& window);
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  /// Puts them into the menu.
  void fill(QMenu& menu);
  QAction* open_design() const { return open_; }
  QAction* save_design() const { return save_; }

  /// What else is to happen before the design is touched from here, such as ending a drag; false: what is
  /// asked for here is not to happen.
  void on_begin(std::function<bool()> begin) { begin_ = std::move(begin); }

  /// What else is to happen when the design is written, and before it is left.
  void on_save(std::function<void()> saving) { saving_ = std::move(saving); }
  void on_leave(std::function<void()> leaving) { leaving_ = std::move(leaving); }

  /// Opens it, once what would be lost is saved or given up.
  void open(const std::filesystem::path& design);
  void recover(const std::filesystem::path& journal);
  /// The file as it was saved last, instead of what is there.
  void revert();
  void choose_and_open();
  void save();
  void save_again();
  void save_as();
  /// Calls `then` when nothing would be lost any more: at once, after saving, or after a person has given it
  /// up; not at all when the person thinks better of it.
  void when_safe(const std::function<void()>& then);

  /// What happened to the session; gives what to say of it.
  Note hear(const session::SessionEvent& event);
  /// The name of the design as people know it.
  QString design_name() const;
  /// What is being read or written, for people; null when nothing is.
  QString doing() const;

 private:
  void start();
  void make_new();
  void forget_missing();
  void fill_recent();
  void begin_save(const std::filesystem::path& design);
  Note hear_of_cancelled(const session::SessionEvent& event);
  void ask(const std::function<void()>& then);
  void ask_to_replace(const session::SessionEvent& event);

  session::Session& session_;
  QWidget& window_;
  RecentFiles recent_;
  QMenu* recent_menu_ = nullptr;
  QAction *open_ = nullptr, *save_ = nullptr;
  std::function<bool()> begin_ = [] { return true; };
  std::function<void()> saving_ = [] {}, leaving_ = [] {};
  std::function<void()> then_ = {};                         // waits for the work to be saved
  std::filesystem::path opened_ = {};                       // is being read
  std::filesystem::path saved_ = {};                        // was, or is being, written
  std::optional<session::RecoverableWork> recovered_ = {};  // the last
  bool given_up_ = false;                                   // reading, as a person went on with the design
  bool asking_ = false;
};

/// For a file dialog: all formats together, then each; and those that can be written.
QStringList open_filters();
QStringList save_filters();
/// The ending of a filter's first format, without the dot: "wrl" for "VRML 2.0 (*.wrl *.vrml)".
QString ending_of(const QString& filter);

}  // namespace icome::ui
