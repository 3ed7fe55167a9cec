#pragma once
#include <QMenu>
#include <QPointer>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "drawing/shape/drawing_shape.h"
#include "session/session.h"

class QAction;

namespace icome::ui {

class SketchWindow;

/// Drawings that are objects of the design: each is drawn on in a window of its own, and every edit goes into
/// the design at once, for all who work on it. Main's.
class DrawingActions {
 public:
  struct Hooks {
    std::function<bool()> begin;  ///< ends what else is going on; false: not now
    std::function<void(const std::string&)> refused;
  };
  DrawingActions(session::Session& session, Hooks hooks, QWidget& window);

  void fill(QMenu& menu);
  /// The object of the selection that is a drawing; none for any other selection.
  std::optional<world::ObjectId> selected() const;
  /// Opens the window of the selected drawing, or brings it to the front.
  void draw_on_selected();

 private:
  void draw_on(world::ObjectId id);
  void add(drawing::Drawing drawing, const std::string& name);
  void choose();
  void insert(const std::filesystem::path& file);
  void follow(const world::Changes* changes);
  const drawing::DrawingShape* shape(world::GeometryId id) const;

  session::Session& session_;
  Hooks hooks_;
  QWidget& window_;
  std::map<world::GeometryId, QPointer<SketchWindow>> windows_;
};

}  // namespace icome::ui
