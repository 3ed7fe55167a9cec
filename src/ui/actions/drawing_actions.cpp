#include "ui/actions/drawing_actions.h"

#include <QFileDialog>
#include <algorithm>

#include "interaction/object_edits.h"
#include "ui/actions/actions.h"
#include "ui/actions/recent_files.h"
#include "ui/panels/object_look.h"
#include "ui/sketch/sketch_window.h"

namespace icome::ui {

using world::GeometryId;
using world::ObjectId;

DrawingActions::DrawingActions(session::Session& session, Hooks hooks, QWidget& window)
    : session_(session), hooks_(std::move(hooks)), window_(window) {
  session_.on_change([this](const world::Changes* changes) { follow(changes); });
}

void DrawingActions::fill(QMenu& menu) {
  add_action(menu, "model.new_drawing", "&New Drawing in the Design", {}, [this] {
    drawing::Drawing page;
    page.layers.push_back({.id = page.next_layer_id(), .name = "Layer 1", .strokes = {}});
    add(std::move(page), "drawing");
  })->setStatusTip("Puts a sheet of paper into the design and opens it to be drawn on");
  add_action(menu, "model.insert_drawing", "&Insert a Drawing\u2026", {}, [this] {
    choose();
  })->setStatusTip("Puts the drawing of an SVG file or a recording of a pen into the design");
  add_action(menu, "model.draw", "&Draw on It\u2026", {}, [this] {
    draw_on_selected();
  })->setStatusTip("Opens the selected drawing; what is drawn is seen and felt in the design at once");
}

const drawing::DrawingShape* DrawingActions::shape(GeometryId id) const {
  const world::GeometryObject* const geometry = session_.world().find(id);
  return geometry ? drawing::drawing_in(*geometry->shape) : nullptr;
}

std::optional<ObjectId> DrawingActions::selected() const {
  if (session_.selection().size() != 1) return std::nullopt;
  const world::PhysicalObject* const object = session_.world().find(session_.selection().front());
  if (!object || !shape(object->geometry)) return std::nullopt;
  return session_.selection().front();
}

void DrawingActions::draw_on_selected() {
  const auto id = selected();
  if (!id) return hooks_.refused("Select a drawing of the design first, or make a new one");
  draw_on(*id);
}

void DrawingActions::draw_on(ObjectId id) {
  const world::PhysicalObject& object = *session_.world().find(id);
  const GeometryId geometry = object.geometry;
  QPointer<SketchWindow>& window = windows_[geometry];
  if (!window) {
    window = new SketchWindow({}, &window_);
    window->setAttribute(Qt::WA_DeleteOnClose);
    const std::string action = action_name("Draw on", session_.world(), std::vector{id});
    window->document().open(
        {.name = object.name,
         .shape = [this, geometry] { return shape(geometry); },
         .edit = [this, geometry, action](const drawing::DrawingEdit& edit) -> base::Result<void> {
           if (!hooks_.begin()) return base::fail("The design is busy with something else.");
           return session_.history().perform(world::AmendGeometry{geometry, drawing::edit_bytes(edit)},
                                             action);
         }});
  }
  window->show();
  window->raise();
  window->activateWindow();
}

void DrawingActions::add(drawing::Drawing drawing, const std::string& name) {
  if (!hooks_.begin()) return;
  const double upright = 0.5 * drawing.size.y();  // stands on the plane y = 0
  auto shape = drawing::DrawingShape::create(std::move(drawing), {});
  if (!shape) return hooks_.refused(shape.error().message);
  world::EditGroup group;
  world::PhysicalObject object{.name = name};
  object.parent_from_object = base::Affine3(Eigen::Translation3d(0.0, upright, 0.0));
  object.geometry = session_.ids().next<GeometryId>();
  const auto id = session_.ids().next<ObjectId>();
  group.edits.push_back(world::CreateGeometry{object.geometry, std::move(*shape)});
  group.edits.push_back(world::CreateObject{id, session_.world().roots().size(), std::move(object)});
  const auto done = session_.history().perform(world::Edit(std::move(group)), "Create " + name);
  if (!done) return hooks_.refused(done.error().message);
  session_.select({id});
  draw_on(id);
}

void DrawingActions::choose() {
  auto* dialog = new QFileDialog(&window_, "Insert a Drawing");
  dialog->setObjectName("insert.drawing");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->setNameFilters(sketch_open_filters());
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_,
                   [this](const QString& path) { insert(path_of(path)); });
  dialog->open();
}

void DrawingActions::insert(const std::filesystem::path& file) {
  auto read = sketch::read_drawing(file, {});
  if (!read) return hooks_.refused(read.error().message);
  add(std::move(read->drawing), file.stem().string());
}

/// Null: another design is open, in which the same ids may belong to other things.
void DrawingActions::follow(const world::Changes* changes) {
  std::erase_if(windows_, [](const auto& it) { return it.second.isNull(); });
  const auto windows = windows_;
  if (!changes) windows_.clear();
  for (const auto& [id, window] : windows) {
    if (!changes) {
      window->document().leave_home();
    } else if (std::ranges::binary_search(changes->geometries, id)) {
      window->document().follow_home();
    }
  }
}

}  // namespace icome::ui
