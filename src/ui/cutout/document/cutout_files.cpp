#include "ui/cutout/document/cutout_files.h"

#include <fmt/format.h>

#include <QApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "animation/export/output_names.h"
#include "animation/sound/sound_track.h"
#include "ui/actions/recent_files.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

constexpr const char* kAnimations = "Cut-out animations (*.cutout)";
constexpr const char* kCellFiles = "Pictures (*.png *.svg *.svgz *.jpg *.jpeg *.icome)";

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

/// The ending of a filter's files, with its dot.
QString ending_of_filter(const QString& filter) { return filter.section('*', 1, 1).chopped(1); }

bool is_frame_ending(const QString& name) {
  return name.endsWith(".png", Qt::CaseInsensitive) || name.endsWith(".svg", Qt::CaseInsensitive);
}

/// A dialog for the name of an export, which may be a pattern (shot%04d.png), or a folder, with a / at its
/// end.
class ExportNameDialog final : public QFileDialog {
 public:
  ExportNameDialog(QWidget& window, const QStringList& filters, const QString& stem)
      : QFileDialog(&window, "Export the Animation") {
    setObjectName("cutout.export");
    setAttribute(Qt::WA_DeleteOnClose);
    setOption(QFileDialog::DontUseNativeDialog);  // others know neither patterns nor folders to be
    setAcceptMode(QFileDialog::AcceptSave);
    setNameFilters(filters);
    setLabelText(QFileDialog::FileName, "Film, or folder/ of frames:");
    offer(filters.front(), stem);
    connect(this, &QFileDialog::filterSelected, this,
            [this](const QString& chosen) { offer(chosen, stem_of(name_field()->text())); });
  }

 protected:
  void accept() override {
    const QString typed = name_field()->text();
    if (!typed.endsWith('/')) return QFileDialog::accept();
    const QString folder = QFileInfo(typed).isAbsolute() ? typed : directory().filePath(typed);
    emit fileSelected(folder.endsWith('/') ? folder : folder + '/');
    done(QDialog::Accepted);
  }

 private:
  QLineEdit* name_field() const { return findChild<QLineEdit*>("fileNameEdit"); }

  static QString stem_of(QString name) {
    if (name.endsWith('/')) return name;
    for (const char* ending : {".mp4", ".webm", ".gif", ".apng", ".png", ".svg"})
      if (name.endsWith(ending, Qt::CaseInsensitive))
        name.chop(qsizetype(std::char_traits<char>::length(ending)));
    return name.remove("%04d");
  }
  void offer(const QString& filter, const QString& stem) {
    const QString ending = ending_of_filter(filter);
    setDefaultSuffix(ending.mid(1));
    if (!stem.endsWith('/')) name_field()->setText(stem + (is_frame_ending(ending) ? "%04d" : "") + ending);
  }
};

/// A question with two answers, in front of a window that lives on.
QMessageBox* cutout_question(QWidget& window, const char* name, const QString& title, const QString& text) {
  auto* box = new QMessageBox(QMessageBox::Warning, title, text, QMessageBox::Cancel, &window);
  box->setObjectName(name);
  box->setTextFormat(Qt::PlainText);
  box->setDefaultButton(QMessageBox::Cancel);
  box->setAttribute(Qt::WA_DeleteOnClose);
  return box;
}

/// Files of a sequence that are there already.
int frames_there(const animation::OutputNames& names, const animation::FrameRange& range) {
  int count = 0;
  std::error_code error;
  for (int frame = range.first; frame <= range.last; ++frame)
    if (std::filesystem::exists(names.of(frame), error)) ++count;
  return count;
}

std::string recovered_words(const std::string& name, std::size_t edits) {
  if (edits == 1)
    return fmt::format("1 edit of {} was not saved when the program ended. It is recovered: save to keep it.",
                       name);
  return fmt::format(
      "{} edits of {} were not saved when the program ended. They are recovered: save to keep "
      "them.",
      edits, name);
}

/// Without the name of the tool, which is nothing to a person who has chosen from a menu.
std::string without_tool(const std::string& message, const std::string& tool) {
  return message.starts_with(tool + ": ") ? message.substr(tool.size() + 2) : message;
}

std::vector<std::filesystem::path> paths_of_texts(const QStringList& texts) {
  std::vector<std::filesystem::path> paths;
  for (const QString& text : texts) paths.push_back(path_of(text));
  return paths;
}

}  // namespace

QString export_name(const QString& typed) {
  if (!is_frame_ending(typed) || QFileInfo(typed).fileName().contains('%')) return typed;
  return typed.chopped(4) + "%04d" + typed.right(4);
}

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
  const auto done = document_.open(file);
  if (!done) return fail(done.error().message);
  used_(file);
  if (done->recovered > 0)
    tell_({.text = recovered_words(file.filename().string(), done->recovered), .topic = kRecoveredTopic});
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
  if (!done->note.empty())
    return tell_({.weight = Note::Weight::Warning, .text = opened + " " + done->note, .topic = "file"});
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

/// Saves at once, unless the work of others would be lost by it: then a person is asked.
void CutoutFiles::save_if_agreed(const std::filesystem::path& file) {
  const std::string reason = document_.reason_not_to_write(file);
  if (reason.empty()) return save_to(file);
  auto* box =
      cutout_question(window_, "cutout.overwrite", "Overwrite the File?", QString::fromStdString(reason));
  box->setInformativeText("Overwriting takes away what was done to it elsewhere.");
  const auto* overwrite = box->addButton("&Overwrite", QMessageBox::DestructiveRole);
  const auto* elsewhere = box->addButton("Save &As\u2026", QMessageBox::AcceptRole);
  QObject::connect(box, &QMessageBox::finished, &window_, [=, this] {
    if (box->clickedButton() == overwrite) return save_to(file);
    if (box->clickedButton() == elsewhere) return save_as();
    then_ = nullptr;
  });
  box->open();
}

void CutoutFiles::save() {
  if (document_.file().empty()) return save_as();
  save_if_agreed(document_.file());
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
    save_if_agreed(path_of(path.endsWith(".cutout", Qt::CaseInsensitive) ? path : path + ".cutout"));
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

void CutoutFiles::tell_left_out(const std::vector<std::string>& problems, std::size_t all) {
  if (problems.empty()) return;
  if (all == 1) return tell_({.weight = Note::Weight::Error, .text = problems.front(), .topic = "pictures"});
  tell_({.weight = Note::Weight::Warning,
         .text = fmt::format("{} of {} pictures could not be read, and {} left out.", problems.size(), all,
                             problems.size() == 1 ? "was" : "were"),
         .topic = "pictures",
         .details = problems});
}

/// Names of pictures as the project has them, without those that cannot be read, which are told.
std::vector<std::string> CutoutFiles::readable_of(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names, problems;
  for (const std::filesystem::path& file : files) {
    std::string name = document_.name_in_project(file);
    const auto size = document_.disk().size(name);
    size ? names.push_back(std::move(name)) : problems.push_back(size.error().message);
  }
  tell_left_out(problems, files.size());
  return names;
}

void CutoutFiles::add_cells(const std::vector<std::filesystem::path>& files, bool one_cell) {
  const std::vector<std::string> names = readable_of(files);
  if (names.empty()) return;
  if (one_cell)
    document_.perform(cutout_command("add-cell", {{"pictures", command_texts(names)}}));
  else
    document_.as_one_step([&] {
      for (const std::string& name : names)
        document_.perform(cutout_command("add-cell", {{"pictures", command_texts({name})}}));
    });
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
  QObject::connect(
      dialog, &QFileDialog::filesSelected, &window_, [this, name = cell->name](const QStringList& paths) {
        const std::vector<std::string> names = readable_of(paths_of_texts(paths));
        if (!names.empty())
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
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_,
                   [=, this](const QString& path) { import_folder(path_of(path), one_cell); });
  dialog->open();
}

void CutoutFiles::import_folder(const std::filesystem::path& folder, bool one_cell) {
  const auto note = document_.attempt(cutout_command("import", {{"folder", document_.name_in_project(folder)},
                                                                {"as", one_cell ? "pictures" : "cells"},
                                                                {"frame", document_.frame()},
                                                                {"skip", true}}));
  if (!note)
    return tell_({.weight = Note::Weight::Error,
                  .text = without_tool(note.error().message, "import"),
                  .topic = "pictures"});
  if (!note->empty())
    tell_({.weight = Note::Weight::Warning,
           .text = "The folder was imported; " + *note + ".",
           .topic = "pictures"});
}

void CutoutFiles::choose_sound() {
  auto* dialog = cutout_dialog(window_, "cutout.sound", "Sound of the Animation",
                               {"Sounds (*.wav *.ogg *.flac)", "All files (*)"});
  dialog->setFileMode(QFileDialog::ExistingFile);
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_,
                   [this](const QString& path) { use_sound(path_of(path)); });
  dialog->open();
}

void CutoutFiles::use_sound(const std::filesystem::path& file) {
  const std::string name = document_.name_in_project(file);
  QApplication::setOverrideCursor(Qt::WaitCursor);
  const auto samples =
      animation::read_track(document_.folder(), {.file = name}, 0, animation::Reach::Anywhere);
  QApplication::restoreOverrideCursor();
  if (!samples)
    return tell_({.weight = Note::Weight::Error, .text = samples.error().message, .topic = "sound"});
  document_.perform(cutout_command("sound", {{"file", name}}));
}

void CutoutFiles::take_dropped(const std::vector<std::filesystem::path>& files) {
  const auto project = std::ranges::find_if(files, is_cutout_file);
  if (project != files.end()) return when_safe([this, file = *project] { open(file); });
  std::vector<std::filesystem::path> pictures;
  for (const std::filesystem::path& file : files) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
      import_folder(file, true);
    else
      pictures.push_back(file);
  }
  add_cells(pictures, false);
}

// Export.

void CutoutFiles::choose_and_export(const animation::ExportOptions& options) {
  const QStringList filters = {"MP4 film (*.mp4)",      "WebM film (*.webm)",   "GIF picture (*.gif)",
                               "APNG picture (*.apng)", "PNG sequence (*.png)", "SVG sequence (*.svg)"};
  auto* dialog = new ExportNameDialog(
      window_, filters,
      QFileInfo(document_.file().empty() ? QString("animation") : name()).completeBaseName());
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_, [=, this](const QString& path) {
    export_if_agreed(path_of(export_name(path)).string(), options);
  });
  dialog->open();
}

void CutoutFiles::export_if_agreed(const std::string& out, const animation::ExportOptions& options) {
  const animation::FrameRange range =
      options.range.value_or(animation::FrameRange{0, document_.last_frame()});
  const auto names = animation::output_names(out, range.count());
  // Films are asked for by the dialog, and a wrong name is told by the export itself.
  const int there = names && animation::is_sequence(names->format) ? frames_there(*names, range) : 0;
  if (there == 0) return export_to(out, options);
  auto* box =
      cutout_question(window_, "cutout.replace_frames", "Replace Files?",
                      there == 1 ? QString("1 of these files is there already. Replace it?")
                                 : QString("%L1 of these files are there already. Replace them?").arg(there));
  const auto* replace = box->addButton("&Replace", QMessageBox::DestructiveRole);
  QObject::connect(box, &QMessageBox::finished, &window_, [=, this] {
    if (box->clickedButton() == replace) export_to(out, options);
  });
  box->open();
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
