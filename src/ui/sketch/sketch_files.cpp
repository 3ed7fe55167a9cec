#include "ui/sketch/sketch_files.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <utility>

#include "ui/actions/recent_files.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

constexpr int kExportedSide = 2400;  // pixels
constexpr const char* kOwnFormat = "SVG drawing (*.svg)";

/// A dialog that writes a file; its name gets the ending of the chosen filter.
QFileDialog* writing_dialog(QWidget& window, const char* title, const QStringList& filters) {
  auto* dialog = new QFileDialog(&window, title);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setNameFilters(filters);
  const auto ending = [](const QString& filter) { return filter.section("*.", 1, 1).chopped(1); };
  dialog->setDefaultSuffix(ending(filters.front()));
  QObject::connect(dialog, &QFileDialog::filterSelected, dialog,
                   [=](const QString& chosen) { dialog->setDefaultSuffix(ending(chosen)); });
  return dialog;
}

}  // namespace

QStringList sketch_open_filters() {
  return {"Drawings and pen recordings (*.svg *.csv *.inkml *.svc *.scap *.dat *.events)", kOwnFormat,
          "All files (*)"};
}

QString SketchFiles::name() const {
  if (document_.lives_in_design()) return shortened(one_line(document_.home_name())) + " (in the design)";
  return document_.file().empty() ? QString("Untitled drawing") : text_of(document_.file().filename());
}

void SketchFiles::fail(const std::string& why) {
  tell_({.weight = Note::Weight::Error, .text = why, .topic = "file"});
}

void SketchFiles::open(const std::filesystem::path& file) {
  const auto notes = document_.open(file);
  if (!notes) return fail(notes.error().message);
  const std::string opened = file.filename().string() + " was opened.";
  if (notes->empty()) return tell_({.weight = Note::Weight::Passing, .text = opened, .topic = "file"});
  tell_({.text = opened + " Some of it was skipped or taken otherwise.", .topic = "file", .details = *notes});
}

void SketchFiles::choose_and_open() {
  when_safe([this] {
    auto* dialog = new QFileDialog(&window_, "Open a Drawing");
    dialog->setObjectName("sketch.open");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    dialog->setNameFilters(sketch_open_filters());
    QObject::connect(dialog, &QFileDialog::fileSelected, &window_,
                     [this](const QString& path) { open(path_of(path)); });
    dialog->open();
  });
}

void SketchFiles::save_to(const std::filesystem::path& file) {
  const auto then = std::exchange(then_, nullptr);
  if (const auto saved = document_.save(file); !saved) return fail(saved.error().message);
  tell_(
      {.weight = Note::Weight::Passing, .text = "Saved " + file.filename().string() + ".", .topic = "file"});
  if (then) then();
}

void SketchFiles::save() {
  if (document_.lives_in_design()) {
    return tell_(
        {.text = "The drawing is kept in the design, which the main window saves. Save As writes a copy.",
         .topic = "file"});
  }
  if (document_.file().empty()) return save_as();
  save_to(document_.file());
}

void SketchFiles::save_as() {
  auto* dialog = writing_dialog(window_, "Save the Drawing As", {kOwnFormat});
  dialog->setObjectName("sketch.save_as");
  if (document_.file().empty()) {
    dialog->selectFile("drawing.svg");
  } else {
    dialog->setDirectory(text_of(document_.file().parent_path()));
    dialog->selectFile(name());
  }
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_, [this](const QString& path) {
    // Only SVG keeps all that was drawn.
    save_to(path_of(path.endsWith(".svg", Qt::CaseInsensitive) ? path : path + ".svg"));
  });
  QObject::connect(dialog, &QFileDialog::rejected, &window_, [this] { then_ = nullptr; });
  dialog->open();
}

void SketchFiles::choose_and_export() {
  auto* dialog = writing_dialog(window_, "Export a Picture", {"PNG picture (*.png)", "PDF page (*.pdf)"});
  dialog->setObjectName("sketch.export");
  dialog->selectFile(QFileInfo(name()).completeBaseName());
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_, [this](const QString& path) {
    sketch::PictureOptions options;
    options.longer_side = kExportedSide;
    const auto written =
        sketch::write_drawing(document_.drawing(), path_of(path), options, drawing::SvgLines::Outlines);
    if (!written) return fail(written.error().message);
    tell_({.weight = Note::Weight::Passing,
           .text = "Exported " + path_of(path).filename().string() + ".",
           .topic = "file"});
  });
  dialog->open();
}

void SketchFiles::when_safe(const std::function<void()>& then) {
  if (!document_.is_modified()) return then();
  if (asking_) return;
  asking_ = true;
  auto* box =
      new QMessageBox(QMessageBox::Warning, "Save Changes?", QString("Save the changes to %1?").arg(name()),
                      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &window_);
  box->setObjectName("sketch.save_changes");
  box->setTextFormat(Qt::PlainText);
  box->setInformativeText("Without saving, what you did since the last time is lost.");
  box->button(QMessageBox::Discard)->setText("&Don\u2019t Save");
  box->setDefaultButton(QMessageBox::Save);
  box->setAttribute(Qt::WA_DeleteOnClose);
  QObject::connect(box, &QMessageBox::finished, &window_, [this, then](int answer) {
    asking_ = false;
    if (answer == QMessageBox::Discard) return then();
    if (answer != QMessageBox::Save) return;
    then_ = then;
    save();
  });
  box->open();
}

}  // namespace icome::ui
