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

/// Filters of a file dialog for pictures.
QStringList picture_filters();

/// Puts pictures on objects by hand: on the selection, chosen in a dialog, or on an object that a file is
/// dropped on. Pictures are read on a thread of their own. Session and window outlive it.
class PictureActions {
 public:
  struct Hooks {
    std::function<bool()> begin;                      // asked before the world is edited; false: do not
    std::function<void(const std::string&)> refused;  // tells why something was not done
  };
  PictureActions(session::Session& session, Hooks hooks, QWidget& window);
  PictureActions(const PictureActions&) = delete;
  PictureActions& operator=(const PictureActions&) = delete;

  /// Adds the action to the menu.
  void fill(QMenu& menu);
  /// Asks for the file of a picture to put on the selected objects.
  void choose();
  /// Puts the picture on the objects, and on all below the groups among them, as soon as it has been read; as
  /// one action.
  void put(const std::filesystem::path& file, const std::vector<world::ObjectId>& objects);

  /// To be called once for each update of the session.
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
  QString folder_ = {};  // of the last picture
  std::unique_ptr<Reading> reading_ = {};
};

}  // namespace icome::ui
