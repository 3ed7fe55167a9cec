#include "ui/cutout/document/cutout_files.h"

#include <fmt/format.h>

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "ui/actions/recent_files.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

constexpr const char* kAnimations = "Cut-out animations (*.cutout)";
constexpr const char* kCellFiles = "Pictures (*.png *.svg *.jpg *.jpeg *.icome)";

QFileDialog* cutout_dialog(QWidget& window, const char* name, const char* title, const QStringList& filters) {
  auto* dialog = new QFileDialog(&window, title);
  dialog->setObjectName(name);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setNameFilters(filters);
  return dialog;
}

/// A dialog that writes a file; its name gets the ending of the chosen filter.
QFileDialog* cutout_writing_dialog(QWidget& window, const char* name, const char* title,
                                   const QStringList& filters) {
  auto* dialog = cutout_dialog(window, name, title, filters);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  const auto ending = [](const QString& filter) { return filter.section("*.", 1, 1).chopped(1); };
  dialog->setDefaultSuffix(ending(filters.front()));
  QObject::connect(dialog, &QFileDialog::filterSelected, dialog,
                   [=](const QString& chosen) { dialog->setDefaultSuffix(ending(chosen)); });
  return dialog;
}

std::vector<std::filesystem::path> paths_of_texts(const QStringList& texts) {
  std::vector<std::filesystem::path> paths;
  for (const QString& text : texts) paths.push_back(path_of(text));
  return paths;
}

}  // namespace

QStringList cutout_open_filters() { return {kAnimations, "All files (*)"}; }

bool is_cutout_file(const std::filesystem::path& file) {
  return text_of(file).endsWith(".cutout", Qt::CaseInsensitive);
}

QString CutoutFiles::name() const {
  return document_.file().empty() ? QString("Untitled animation") : text_of(document_.file().filename());
}

void CutoutFiles::fail(const std::string& why) {
  tell_({.weight = Note::Weight::Error, .text = why, .topic = "file"});
}

void CutoutFiles::open(const std::filesystem::path& file) {
  const auto note = document_.open(file);
  if (!note) return fail(note.error().message);
  used_(file);
  std::vector<std::string> problems;
  for (const animation::PictureProblem& problem :
       animation::picture_problems(document_.project(), document_.pictures()))
    problems.push_back(problem.message);
  const std::string opened = file.filename().string() + " was opened.";
  if (!problems.empty())
    return tell_({.weight = Note::Weight::Warning,
                  .text = fmt::format("{} {} cannot be shown; a crossed frame stands there.", opened,
                                      problems.size() == 1 ? "A picture" : "Some pictures"),
                  .topic = "file",
                  .details = problems});
  if (!note->empty())
    return tell_({.weight = Note::Weight::Warning, .text = opened + " " + *note, .topic = "file"});
  tell_({.weight = Note::Weight::Passing, .text = opened, .topic = "file"});
}

void CutoutFiles::choose_and_open() {
  when_safe([this] {
    auto* dialog = cutout_dialog(window_, "cutout.open", "Open an Animation", cutout_open_filters());
    dialog->setFileMode(QFileDialog::ExistingFile);
    QObject::connect(dialog, &QFileDialog::fileSelected, &window_,
                     [this](const QString& path) { open(path_of(path)); });
    dialog->open();
  });
}

void CutoutFiles::save_to(std::filesystem::path file) {
  const auto then = std::exchange(then_, nullptr);
  if (const auto saved = document_.save(file); !saved) return fail(saved.error().message);
  used_(file);
  tell_(
      {.weight = Note::Weight::Passing, .text = "Saved " + file.filename().string() + ".", .topic = "file"});
  if (then) then();
}

void CutoutFiles::save() {
  if (document_.file().empty()) return save_as();
  save_to(document_.file());
}

void CutoutFiles::save_as() {
  auto* dialog = cutout_writing_dialog(window_, "cutout.save_as", "Save the Animation As", {kAnimations});
  if (document_.file().empty()) {
    dialog->selectFile("animation.cutout");
  } else {
    dialog->setDirectory(text_of(document_.file().parent_path()));
    dialog->selectFile(name());
  }
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_, [this](const QString& path) {
    save_to(path_of(path.endsWith(".cutout", Qt::CaseInsensitive) ? path : path + ".cutout"));
  });
  QObject::connect(dialog, &QFileDialog::rejected, &window_, [this] { then_ = nullptr; });
  dialog->open();
}

void CutoutFiles::when_safe(const std::function<void()>& then) {
  if (!document_.is_modified()) return then();
  if (asking_) return;
  asking_ = true;
  auto* box =
      new QMessageBox(QMessageBox::Warning, "Save Changes?", QString("Save the changes to %1?").arg(name()),
                      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &window_);
  box->setObjectName("cutout.save_changes");
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

// Pictures and sound.

void CutoutFiles::add_cells(const std::vector<std::filesystem::path>& files, bool one_cell) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files) names.push_back(document_.name_in_project(file));
  if (one_cell) {
    if (!names.empty()) document_.perform(cutout_command("add-cell", {{"pictures", command_texts(names)}}));
  } else {
    document_.as_one_step([&] {
      // The rest is not tried after one that cannot be read, which is told.
      for (const std::string& name : names)
        if (!document_.perform(cutout_command("add-cell", {{"pictures", command_texts({name})}}))) return;
    });
  }
  const auto& layers = document_.project().layers;
  // The last one is about to be moved.
  if (!layers.empty() && !layers.back().cells.empty()) document_.select({layers.back().cells.back().id});
}

void CutoutFiles::choose_pictures(bool one_cell) {
  auto* dialog =
      cutout_dialog(window_, "cutout.pictures", one_cell ? "Pictures of One Cell" : "Pictures, Each a Cell",
                    {kCellFiles, "All files (*)"});
  dialog->setFileMode(QFileDialog::ExistingFiles);
  QObject::connect(dialog, &QFileDialog::filesSelected, &window_,
                   [=, this](const QStringList& paths) { add_cells(paths_of_texts(paths), one_cell); });
  dialog->open();
}

void CutoutFiles::choose_more_pictures() {
  const animation::Cell* const cell = document_.leading();
  if (cell == nullptr || cell->id == animation::kCamera)
    return document_.remark("Select the cell that is to get more pictures.");
  auto* dialog = cutout_dialog(window_, "cutout.more_pictures", "More Pictures for the Cell",
                               {kCellFiles, "All files (*)"});
  dialog->setFileMode(QFileDialog::ExistingFiles);
  QObject::connect(dialog, &QFileDialog::filesSelected, &window_,
                   [this, name = cell->name](const QStringList& paths) {
                     std::vector<std::string> names;
                     for (const auto& file : paths_of_texts(paths))
                       names.push_back(document_.name_in_project(file));
                     document_.perform(
                         cutout_command("add-picture", {{"cell", name}, {"pictures", command_texts(names)}}));
                   });
  dialog->open();
}

void CutoutFiles::choose_folder(bool one_cell) {
  auto* dialog =
      cutout_dialog(window_, "cutout.folder", one_cell ? "A Folder as One Cell" : "A Folder as Cells", {});
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_, [=, this](const QString& path) {
    document_.perform(cutout_command("import", {{"folder", document_.name_in_project(path_of(path))},
                                                {"as", one_cell ? "pictures" : "cells"},
                                                {"frame", document_.frame()}}));
  });
  dialog->open();
}

void CutoutFiles::choose_sound() {
  auto* dialog = cutout_dialog(window_, "cutout.sound", "Sound of the Animation",
                               {"Sounds (*.wav *.ogg *.flac)", "All files (*)"});
  dialog->setFileMode(QFileDialog::ExistingFile);
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_, [this](const QString& path) {
    document_.perform(cutout_command("sound", {{"file", document_.name_in_project(path_of(path))}}));
  });
  dialog->open();
}

void CutoutFiles::take_dropped(const std::vector<std::filesystem::path>& files) {
  const auto project = std::ranges::find_if(files, is_cutout_file);
  if (project != files.end()) return when_safe([this, file = *project] { open(file); });
  std::vector<std::filesystem::path> pictures;
  for (const std::filesystem::path& file : files) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
      document_.perform(cutout_command(
          "import", {{"folder", document_.name_in_project(file)}, {"frame", document_.frame()}}));
    else
      pictures.push_back(file);
  }
  add_cells(pictures, false);
}

// Export.

void CutoutFiles::choose_and_export(const animation::ExportOptions& options) {
  const QStringList filters = {"MP4 film (*.mp4)",      "WebM film (*.webm)",   "GIF picture (*.gif)",
                               "APNG picture (*.apng)", "PNG sequence (*.png)", "SVG sequence (*.svg)"};
  auto* dialog = cutout_writing_dialog(window_, "cutout.export", "Export the Animation", filters);
  dialog->selectFile(QFileInfo(document_.file().empty() ? QString("animation") : name()).completeBaseName());
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_, [=, this](const QString& path) {
    QString out = path;
    // A sequence has the frame's number in its names.
    const bool is_sequence =
        path.endsWith(".png", Qt::CaseInsensitive) || path.endsWith(".svg", Qt::CaseInsensitive);
    if (is_sequence && !path.contains('%')) out = path.chopped(4).replace('%', "%%") + "%04d" + path.right(4);
    export_to(path_of(out).string(), options);
  });
  dialog->open();
}

void CutoutFiles::export_to(const std::string& out, const animation::ExportOptions& options) {
  if (job_) return fail("An export is under way; wait for it, or cancel it.");
  progress_(0.0);
  job_ = std::make_unique<ExportJob>(
      document_, out, options, [this](double part) { progress_(part); },
      [this](const base::Result<animation::ExportReport>& report) {
        tell_exported(report);
        // Not from within the job's own call.
        QMetaObject::invokeMethod(
            &window_, [this] { job_.reset(); }, Qt::QueuedConnection);
      });
}

void CutoutFiles::tell_exported(const base::Result<animation::ExportReport>& report) {
  progress_(-1.0);
  if (!report) return fail(report.error().message);
  std::string where = report->files.empty() ? std::string() : report->files.front();
  if (report->files.size() > 1) where += fmt::format(" and {} more", report->files.size() - 1);
  const std::string text = fmt::format("Exported {} frames as {}: {}", report->frames, report->format, where);
  if (report->remarks.empty()) return tell_({.weight = Note::Weight::Plain, .text = text, .topic = "file"});
  tell_({.weight = Note::Weight::Warning, .text = text, .topic = "file", .details = report->remarks});
}

void CutoutFiles::cancel_export() {
  if (job_) job_->cancel();
}

}  // namespace icome::ui
