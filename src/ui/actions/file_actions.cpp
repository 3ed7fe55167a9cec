#include "ui/actions/file_actions.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <utility>

#include "ui/actions/actions.h"
#include "ui/cutout/run_cutout.h"
#include "ui/look/icons.h"
#include "ui/panels/object_look.h"
#include "ui/sharing/connect_dialog.h"

namespace icome::ui {

using session::SessionEvent;
namespace {

QString text_of_some(const std::vector<std::string>& sentences) {
  constexpr std::size_t kMost = 3;
  QStringList some;
  for (std::size_t i = 0; i < sentences.size() && i < kMost; ++i)
    some.push_back(QString::fromStdString(sentences[i]));
  return some.join(' ') +
         (sentences.size() > kMost ? QString(" (and %1 more)").arg(sentences.size() - kMost) : "");
}

}  // namespace

FileActions::FileActions(session::Session& session, QSettings& settings, QWidget& window)
    : session_(session), settings_(settings), window_(window), recent_(settings) {
  // An edit of this design cancels the reading of another, which would replace it.
  session_.on_change([this](const world::Changes* changes) {
    if (!changes || session_.follows_others() || !session_.files().opening()) return;
    session_.files().cancel_open();
    given_up_ = true;
  });
}

void FileActions::fill(QMenu& menu) {
  add_action(menu, "file.new", "&New", QKeySequence::New, [this] { start(); })->setIcon(icon(Icon::New));
  open_ = add_action(menu, "file.open", "&Open\u2026", QKeySequence::Open, [this] { choose_and_open(); });
  open_->setIcon(icon(Icon::Open));
  add_action(menu, "file.open_address", "Open A&ddress\u2026", QKeySequence("Ctrl+Shift+O"),
             [this] { choose_address(); });
  recent_menu_ = menu.addMenu("Open &Recent");
  recent_menu_->setObjectName("file.recent");
  QObject::connect(recent_menu_, &QMenu::aboutToShow, &window_, [this] { fill_recent(); });
  recent_menu_->setEnabled(!recent_.paths().isEmpty());
  add_action(menu, "file.integrate", "&Integrate a Design\u2026", {}, [this] {
    choose_and_integrate();
  })->setStatusTip("Puts all of another design into this one, under the selected object");
  keep_ = add_action(menu, "file.keep", "&Keep for Offline Work", {}, [this] {
    session_.sharing().keep(keep_->isChecked());
    renew_keep();
  });
  keep_->setCheckable(true);
  keep_->setStatusTip("Keeps a design of a server on this machine, so that it opens without the server, too");
  QObject::connect(&menu, &QMenu::aboutToShow, &window_, [this] { renew_keep(); });
  renew_keep();
  menu.addSeparator();
  save_ = add_action(menu, "file.save", "&Save", QKeySequence::Save, [this] { save(); });
  save_->setIcon(icon(Icon::Save));
  add_action(menu, "file.save_as", "Save &As\u2026", QKeySequence("Ctrl+Shift+S"), [this] { save_as(); });
}

void FileActions::renew_keep() {
  if (keep_ == nullptr) return;  // there is no menu
  keep_->setEnabled(session_.sharing().state().has_value());
  keep_->setChecked(session_.sharing().is_kept());
}

void FileActions::fill_recent() {
  recent_menu_->clear();
  const QStringList labels = recent_.labels();
  for (int i = 0; i < labels.size(); ++i) {
    // An ampersand in a file's name must not become a mnemonic.
    const QString name = QString(labels[i]).replace('&', "&&");
    QAction* action = recent_menu_->addAction(i < 9 ? QString("&%1  %2").arg(i + 1).arg(name) : name);
    action->setStatusTip(recent_.paths()[i]);
    QObject::connect(action, &QAction::triggered, &window_,
                     [this, path = recent_.paths()[i]] { open(path_of(path)); });
  }
  recent_menu_->addSeparator();
  QObject::connect(recent_menu_->addAction("&Clear This List"), &QAction::triggered, &window_, [this] {
    recent_.clear();
    recent_menu_->setEnabled(false);
  });
}

QString FileActions::design_name() const {
  if (const auto shared = session_.sharing().state()) return one_line(shared->design);
  return session_.files().path().empty() ? QString("Untitled") : text_of(session_.files().path().filename());
}

QString FileActions::doing() const {
  if (session_.files().opening()) {
    if (session::SessionSharing::is_address(opened_.string()))
      return QString("Joining %1\u2026").arg(text_of(opened_));
    return opened_.empty() ? QString("Reading\u2026")
                           : QString("Reading %1\u2026").arg(text_of(opened_.filename()));
  }
  if (session_.files().integrating()) return QString("Reading a design to integrate\u2026");
  if (session_.files().saving()) return QString("Saving %1\u2026").arg(text_of(saved_.filename()));
  return {};
}

void FileActions::start() {
  when_safe([this] { make_new(); });
}

void FileActions::make_new() {
  given_up_ = false;
  recovered_.reset();
  opened_.clear();
  session_.files().make_new();
}

void FileActions::open(const std::filesystem::path& design) {
  if (session::SessionSharing::is_address(design.string())) return open_address(text_of(design));
  if (is_cutout_file(design)) return open_cutout_window(design);
  when_safe([this, design] {
    std::error_code ignored;
    const auto whole = std::filesystem::absolute(design, ignored);
    opened_ = whole.empty() ? design : whole;
    recovered_.reset();
    given_up_ = false;
    session_.files().open(opened_);
  });
}

void FileActions::open_address(const QString& address) {
  when_safe([this, address] {
    const auto shown = session::SessionSharing::shown(address.toStdString());
    opened_ = shown ? path_of(QString::fromStdString(*shown)) : std::filesystem::path();
    recovered_.reset();
    given_up_ = false;
    session_.sharing().open(address.toStdString(), person_name(settings_).toStdString());
  });
}

void FileActions::choose_and_integrate() {
  if (!begin_()) return;
  auto* dialog = new QFileDialog(&window_, "Integrate a Design");
  dialog->setObjectName("integrate");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->setNameFilters(open_filters());
  if (!recent_.paths().isEmpty()) dialog->setDirectory(QFileInfo(recent_.paths().front()).dir());
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_, [this](const QString& path) {
    const auto& selected = session_.selection();
    session_.files().integrate(path_of(path), selected.size() == 1 ? selected.front() : world::ObjectId{});
  });
  dialog->open();
}

void FileActions::choose_address() {
  if (!begin_()) return;
  auto* dialog = new ConnectDialog(
      session_, settings_, [this](const QString& address) { open_address(address); }, &window_);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->open();
}

void FileActions::recover(const std::filesystem::path& journal) {
  for (const session::RecoverableWork& work : session_.files().recoverable()) {
    if (work.journal != journal) continue;
    when_safe([this, work] {
      opened_ = work.design;
      recovered_ = work;
      given_up_ = false;
      session_.files().recover(work);
    });
    return;
  }
}

void FileActions::revert() {
  if (session_.files().path().empty()) {
    start();
  } else {
    open(session_.files().path());
  }
}

void FileActions::choose_and_open() {
  if (!begin_()) return;
  auto* dialog = new QFileDialog(&window_, "Open a Design");
  dialog->setObjectName("open");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->setNameFilters(open_filters());
  if (!session_.files().path().empty()) {
    dialog->setDirectory(text_of(session_.files().path().parent_path()));
  } else if (!recent_.paths().isEmpty()) {
    dialog->setDirectory(QFileInfo(recent_.paths().front()).dir());
  }
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_,
                   [this](const QString& path) { open(path_of(path)); });
  dialog->open();
}

void FileActions::save() {
  if (!begin_()) return;
  if (session_.sharing().state()) {
    save_as();  // a copy: the server keeps the design
  } else if (session_.files().path().empty()) {
    save_as();
  } else {
    begin_save(session_.files().path());
  }
}

void FileActions::save_again() {
  if (!begin_()) return;
  if (saved_.empty()) {
    save();
  } else {
    begin_save(saved_);
  }
}

void FileActions::save_as() {
  if (!begin_()) return;
  const auto shared = session_.sharing().state();
  auto* dialog = new QFileDialog(&window_, shared ? "Save a Copy of the Design" : "Save the Design As");
  dialog->setObjectName("save_as");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  const QStringList filters = save_filters();
  dialog->setNameFilters(filters);
  QString chosen = filters.front();
  if (!session_.files().path().empty()) {
    const QFileInfo file(text_of(session_.files().path()));
    for (const QString& it : filters) {
      if (it.contains("*." + file.suffix().toLower())) chosen = it;
    }
    dialog->setDirectory(file.dir());
    dialog->selectFile(file.completeBaseName());
  } else {
    if (!recent_.paths().isEmpty()) dialog->setDirectory(QFileInfo(recent_.paths().front()).dir());
    dialog->selectFile(shared ? one_line(shared->design) : QString("Untitled"));
  }
  dialog->selectNameFilter(chosen);
  dialog->setDefaultSuffix(ending_of(chosen));
  QObject::connect(dialog, &QFileDialog::filterSelected, dialog,
                   [dialog](const QString& it) { dialog->setDefaultSuffix(ending_of(it)); });
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_,
                   [this](const QString& path) { begin_save(path_of(path)); });
  QObject::connect(dialog, &QFileDialog::rejected, &window_, [this] { then_ = nullptr; });
  dialog->open();
}

void FileActions::begin_save(const std::filesystem::path& design) {
  saved_ = design;
  saving_();
  session_.files().save(design);
}

void FileActions::when_safe(const std::function<void()>& then) {
  if (!begin_()) return;
  leaving_();
  if (session_.files().modified()) {
    ask(then);
  } else if (session_.files().saving()) {
    then_ = then;
  } else {
    then();
  }
}

void FileActions::ask(const std::function<void()>& then) {
  if (asking_) return;
  asking_ = true;
  auto* box = new QMessageBox(QMessageBox::Warning, "Save Changes?",
                              QString("Save the changes to %1?").arg(design_name()),
                              QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &window_);
  box->setObjectName("save_changes");
  box->setTextFormat(Qt::PlainText);
  const auto& left_out = session_.files().left_out();
  if (const auto shared = session_.sharing().state()) {
    box->setText(QString("Leave %1 now?").arg(design_name()));
    box->setInformativeText(
        QString("The server has not got %L1 of your edits yet, and they are lost when you leave. "
                "Wait until there is a connection, or save a copy in a file.")
            .arg(shared->unsent));
    box->button(QMessageBox::Save)->setText("&Save a Copy\u2026");
  } else {
    box->setInformativeText(
        left_out.empty()
            ? QString("Without saving, what you did since the last time is lost.")
            : QString("%1 cannot hold all of your design: %2\nSave it as .icome, or what is left "
                      "out is lost.")
                  .arg(design_name(), text_of_some(left_out)));
  }
  box->button(QMessageBox::Discard)->setText("&Don\u2019t Save");
  box->setDefaultButton(QMessageBox::Save);
  box->setAttribute(Qt::WA_DeleteOnClose);
  QObject::connect(box, &QMessageBox::finished, &window_, [this, then](int answer) {
    asking_ = false;
    if (answer == QMessageBox::Discard) {
      then();
    } else if (answer == QMessageBox::Save) {
      then_ = then;
      // Saving in the same format would leave out the same things again.
      session_.files().left_out().empty() ? save() : save_as();
    }
  });
  box->open();
}

/// Asks whether to replace a file that another program has changed, or a damaged one.
void FileActions::ask_to_replace(const SessionEvent& event) {
  auto* box = new QMessageBox(QMessageBox::Warning, "Replace the File?", QString::fromStdString(event.text),
                              QMessageBox::Cancel, &window_);
  box->setObjectName("replace_file");
  box->setTextFormat(Qt::PlainText);
  box->setInformativeText("Your work is still open here, and the file is as it was.");
  const auto* replace = box->addButton("&Replace", QMessageBox::DestructiveRole);
  const auto* elsewhere = box->addButton("Save &As\u2026", QMessageBox::AcceptRole);
  box->setDefaultButton(QMessageBox::Cancel);
  box->setAttribute(Qt::WA_DeleteOnClose);
  QObject::connect(box, &QMessageBox::finished, &window_, [=, this, design = saved_] {
    if (box->clickedButton() == replace) {
      session_.files().save(design, true);
    } else if (box->clickedButton() == elsewhere) {
      save_as();
    } else {
      then_ = nullptr;
    }
  });
  box->open();
}

/// Takes a design that no longer exists off the list of recent files.
void FileActions::forget_missing() {
  std::error_code error;
  const bool there = opened_.empty() || std::filesystem::exists(opened_, error);
  if (there || error) return;
  recent_.remove(opened_);
  if (recent_menu_) recent_menu_->setEnabled(!recent_.paths().isEmpty());
}

/// The note on a cancelled reading; where an edit cancelled it, the note offers to open the file again.
Note FileActions::hear_of_cancelled(const SessionEvent& event) {
  const std::filesystem::path design = std::exchange(opened_, {});
  const auto work = std::exchange(recovered_, std::nullopt);
  if (!std::exchange(given_up_, false)) return note_of(event);
  const std::string other = design_name().toStdString();
  if (work) return note_of_given_up(*work, other);
  return design.empty() ? note_of(event) : note_of_given_up(design, other);
}

Note FileActions::hear(const SessionEvent& event) {
  renew_keep();
  switch (event.kind) {
    case SessionEvent::Kind::Opened:
    case SessionEvent::Kind::Saved:
    case SessionEvent::Kind::SavedInPart:
      if (!session_.files().path().empty()) recent_.add(session_.files().path());
      if (recent_menu_) recent_menu_->setEnabled(!recent_.paths().isEmpty());
      if (event.kind == SessionEvent::Kind::Opened) opened_.clear();
      break;
    case SessionEvent::Kind::OpenFailed:
      forget_missing();
      opened_.clear();
      break;
    case SessionEvent::Kind::Recovered:
      opened_.clear();
      break;
    case SessionEvent::Kind::OpenCancelled:
      return hear_of_cancelled(event);
    case SessionEvent::Kind::SaveFailed:
      then_ = nullptr;
      break;
    case SessionEvent::Kind::SaveAsks:
      ask_to_replace(event);
      break;
    default:
      break;
  }
  // Asks again if the design was edited meanwhile. A save that is still pending is waited for.
  const bool written =
      event.kind == SessionEvent::Kind::Saved || event.kind == SessionEvent::Kind::SavedInPart;
  if (written && then_ && !session_.files().saving()) {
    const auto then = std::exchange(then_, nullptr);
    // A copy of a shared design was what the person wanted.
    session_.sharing().state() ? then() : when_safe(then);
  }
  if (event.kind == SessionEvent::Kind::Recovered && recovered_)
    return note_of_recovered(*std::exchange(recovered_, std::nullopt), event.details);
  return note_of(event);
}

}  // namespace icome::ui
