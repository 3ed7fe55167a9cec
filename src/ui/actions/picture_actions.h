#pragma once
#include <QMenu>
#include <QStringList>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "session/background_task.h"
#include "session/session.h"

namespace icome::ui {

/// Does the name of the file say that it is a picture, of any kind?
bool is_named_as_picture(const std::filesystem::path& file);

/// For a file dialog.
QStringList picture_filters();

/// Pictures that are brought in by hand: chosen in a dialog for what is selected, or dropped on an object.
/// They are read on a thread of their own. Session and window outlive it.
class PictureActions {
 public:
  struct Hooks {
    std::function<bool()> begin;                      // before the world is touched from here; false: do not
    std::function<void(const std::string&)> refused;  // why something was not done
  };
  PictureActions(session::Session& session, Hooks hooks, QWidget& window);
  PictureActions(const PictureActions&) = delete;
  PictureActions& operator=(const PictureActions&) = delete;

  /// Puts the entry into the menu.
  void fill(QMenu& menu);
  /// Asks for the file of a picture that is to lie on what is selected.
  void choose();
  /// Lays the picture on the objects and all below the groups among them, as soon as it has been read: as one
  /// action.
  void put(const std::filesystem::path& file, const std::vector<world::ObjectId>& objects);

  /// Once for each update of the session.
  void tick();

 private:
  struct Reading {
    std::filesystem::path file;
    std::vector<world::ObjectId> objects;
    session::BackgroundTask<world::Texture> task;
  };
  base::Result<void> lay(const base::Result<world::Texture>& picture,
                         const std::vector<world::ObjectId>& objects);

  session::Session& session_;
  Hooks hooks_;
  QWidget& window_;
  QString folder_ = {};  // where the last one was
  std::unique_ptr<Reading> reading_ = {};
};

}  // namespace icome::ui
