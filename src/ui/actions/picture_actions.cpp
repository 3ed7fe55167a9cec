#include "ui/actions/picture_actions.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMimeDatabase>
#include <utility>

#include "interaction/operations/looks/material_edits.h"
#include "interaction/operations/operation_runner.h"
#include "session/storage/picture_file.h"
#include "ui/actions/actions.h"
#include "ui/actions/recent_files.h"
#include "ui/panels/object_look.h"

namespace icome::ui {

using world::ObjectId;

bool is_named_as_picture(const std::filesystem::path& file) {
  const QMimeType type = QMimeDatabase().mimeTypeForFile(text_of(file), QMimeDatabase::MatchExtension);
  return type.name().startsWith("image/");
}

QStringList picture_filters() { return {"Pictures (*.png *.jpg *.jpeg *.gif)", "All files (*)"}; }

PictureActions::PictureActions(session::Session& session, Hooks hooks, QWidget& window)
    : session_(session), hooks_(std::move(hooks)), window_(window) {
  // In another design the same ids may belong to other objects.
  session_.on_change([this](const world::Changes* changes) {
    if (!changes) reading_.reset();
  });
}

void PictureActions::fill(QMenu& menu) {
  QAction* action = add_action(menu, "model.picture", "P&ut a Picture On\u2026", {}, [this] { choose(); });
  action->setStatusTip("Lays a picture of a file (PNG, JPEG or GIF) on what is selected");
}

void PictureActions::choose() {
  if (session_.selection().empty())
    return hooks_.refused("Select what the picture is to lie on, or drop its file on an object in the scene");
  auto* dialog = new QFileDialog(&window_, "Put a Picture On");
  dialog->setObjectName("picture");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->setNameFilters(picture_filters());
  if (!folder_.isEmpty()) {
    dialog->setDirectory(folder_);
  } else if (!session_.files().path().empty()) {
    dialog->setDirectory(text_of(session_.files().path().parent_path()));
  }
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_, [this](const QString& path) {
    folder_ = QFileInfo(path).path();
    put(path_of(path), session_.selection());
  });
  dialog->open();
}

void PictureActions::put(const std::filesystem::path& file, const std::vector<ObjectId>& objects) {
  reading_.reset(new Reading{file, objects, session::BackgroundTask<world::Texture>([file] {
                               return session::read_picture(file);
                             })});
}

void PictureActions::tick() {
  if (!reading_ || !reading_->task.is_done()) return;
  const std::unique_ptr<Reading> done = std::move(reading_);
  if (const auto laid = lay(done->task.take(), done->objects); !laid) hooks_.refused(laid.error().message);
}

base::Result<void> PictureActions::lay(const base::Result<world::Texture>& picture,
                                       const std::vector<ObjectId>& objects) {
  if (!picture) return tl::unexpected(picture.error());
  if (!hooks_.begin()) return {};
  std::vector<ObjectId> there = objects;
  std::erase_if(there, [&](ObjectId id) { return !session_.world().find(id); });
  if (there.empty()) return base::fail("What the picture was to lie on is gone meanwhile");
  const auto shaped = interaction::with_shapes(session_.world(), there);
  if (!shaped) return tl::unexpected(shaped.error());
  const auto operation = interaction::find_operation("texture");
  if (!operation) return tl::unexpected(operation.error());
  const interaction::Value::Fields fields{{"file", picture->name}, {"projection", "own"}};
  const auto plan = interaction::plan_for_each(**operation, fields, *shaped, session_.world(), session_.ids(),
                                               [&](const std::string&) { return picture; });
  if (!plan) return tl::unexpected(plan.error());
  const auto done =
      session_.history().perform(plan->edit, action_name("Put Picture on", session_.world(), there));
  if (done) session_.select(there);
  return done;
}

}  // namespace icome::ui
