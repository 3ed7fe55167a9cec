#include "ui/forms/operation_panel.h"

#include <QCheckBox>
#include <QElapsedTimer>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QShortcut>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "ui/forms/operation_form.h"
#include "ui/forms/operation_preview.h"
#include "ui/look/theme.h"
#include "ui/panels/column_area.h"
#include "ui/panels/panel_note.h"

namespace icome::ui {

namespace {

constexpr int kUpdate = 16;  // ms from a change to its preview
constexpr int kSlow = 100;   // ms, beyond which previews would disturb typing
constexpr int kPause = 400;  // ms without typing before a slow preview or an error is shown

constexpr const char* kStays = "It stays, as you went on with it. Change something here to do it once more.";

}  // namespace

struct OperationPanel::Parts {
  Parts(session::Session& of, Hooks its, OperationPanel& panel);

  void build(OperationPanel& panel);
  void listen();
  void follow();
  void forget_remark();

  void change();
  void schedule();
  void refresh();
  bool is_hand_busy() const;
  base::Result<void> show(const interaction::Value::Fields& fields);
  void refuse(bool wrong_field, const std::string& why);
  void end(OperationPreview::End how);
  void rest();
  void keep(const std::string& remark);
  void leave();
  void show_state();

  session::Session& session;
  Hooks hooks;
  QLabel* title;
  QLabel* summary;
  ColumnArea* scroll;
  OperationForm* form = nullptr;  // null: nothing is asked yet
  PanelNote* note;
  QCheckBox* previews;
  QPushButton* apply;
  QPushButton* close;
  OperationPreview preview;
  QTimer due;                                                  // runs until the next preview
  QElapsedTimer since_change;                                  // of a field; invalid: none yet
  bool awake = false;                                          // a preview of the fields is wanted
  bool slow = false;                                           // the last preview was
  std::shared_ptr<bool> alive = std::make_shared<bool>(true);  // listeners may outlive us
};

OperationPanel::Parts::Parts(session::Session& of, Hooks its, OperationPanel& panel)
    : session(of),
      hooks(std::move(its)),
      title(new QLabel(&panel)),
      summary(new QLabel(&panel)),
      scroll(new ColumnArea(&panel)),
      note(new PanelNote(&panel)),
      previews(new QCheckBox("&Preview", &panel)),
      apply(new QPushButton("&Apply", &panel)),
      close(new QPushButton(&panel)),
      preview(of, [this](OperationPreview::End how) { end(how); }) {
  build(panel);
  due.setParent(&panel);
  due.setObjectName("operation.due");
  due.setSingleShot(true);
  QObject::connect(&due, &QTimer::timeout, &panel, [this] { refresh(); });
  listen();
  show_state();
}

void OperationPanel::Parts::build(OperationPanel& panel) {
  QFont large = title->font();
  large.setPointSizeF(large.pointSizeF() * 1.15);
  large.setWeight(QFont::DemiBold);
  title->setFont(large);
  title->setObjectName("operation.title");
  title->setContentsMargins(4 * kGrid, 3 * kGrid, 3 * kGrid, 0);
  summary->setObjectName("operation.summary");
  summary->setTextFormat(Qt::PlainText);
  summary->setWordWrap(true);
  summary->setForegroundRole(QPalette::PlaceholderText);
  summary->setContentsMargins(4 * kGrid, kGrid, 3 * kGrid, 2 * kGrid);
  summary->setText("Choose what to make or to change in the Model menu.");
  note->setObjectName("operation.note");
  note->setContentsMargins(4 * kGrid, kGrid, 3 * kGrid, kGrid);
  previews->setObjectName("operation.preview");
  previews->setToolTip("Shows at once what would be done; nothing is done before it is applied");
  previews->setChecked(true);
  QObject::connect(previews, &QCheckBox::toggled, &panel, [this](bool on) {
    if (!on) return leave();
    awake = true;
    schedule();
  });
  apply->setObjectName("operation.apply");
  apply->setToolTip("Does it, as one step to undo (Ctrl+Return)");
  apply->setEnabled(false);
  close->setObjectName("operation.close");
  QObject::connect(apply, &QPushButton::clicked, &panel, [&panel] { panel.apply(); });
  QObject::connect(close, &QPushButton::clicked, &panel, [this] {
    leave();
    hooks.closed();
  });
  auto* key = new QShortcut(QKeySequence("Ctrl+Return"), &panel);
  key->setContext(Qt::WidgetWithChildrenShortcut);
  QObject::connect(key, &QShortcut::activated, &panel, [&panel] { panel.apply(); });
  auto* buttons = new QHBoxLayout;
  buttons->setContentsMargins(4 * kGrid, 2 * kGrid, 3 * kGrid, 3 * kGrid);
  buttons->setSpacing(2 * kGrid);
  buttons->addWidget(previews);
  buttons->addWidget(apply, 1);
  buttons->addWidget(close, 1);
  auto* all = new QVBoxLayout(&panel);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(0);
  all->addWidget(title);
  all->addWidget(summary);
  all->addWidget(scroll, 1);
  all->addWidget(note);
  all->addLayout(buttons);
}

void OperationPanel::Parts::listen() {
  const std::weak_ptr<bool> guard = alive;
  session.on_selection([this, guard] {
    if (guard.expired()) return;
    forget_remark();
    follow();
  });
  session.on_change([this, guard](const world::Changes* changes) {
    if (guard.expired()) return;
    forget_remark();
    if (!changes || !changes->objects.empty()) follow();  // names may have changed
  });
}

/// Clears the remark on the operation that was applied last, as the person goes on with something else.
void OperationPanel::Parts::forget_remark() {
  if (!awake && !preview.busy() && note->text() != kStays) note->clear();
}

/// Takes over the present selection.
void OperationPanel::Parts::follow() {
  if (!form || preview.busy()) return;
  // Objects that exist only in the preview cannot be arguments.
  const auto is_there = [this](world::ObjectId id) { return preview.world().find(id) != nullptr; };
  if (!std::ranges::all_of(session.selection(), is_there)) return;
  form->follow_selection();
  schedule();
}

/// Schedules a preview, after a field has changed.
void OperationPanel::Parts::change() {
  note->clear();
  awake = true;
  since_change.start();
  schedule();
}

void OperationPanel::Parts::schedule() {
  if (!form || !awake || !previews->isChecked()) return;
  if (slow) {
    due.start(kPause);
  } else if (!due.isActive()) {
    due.start(kUpdate);
  }
}

/// Is something being dragged, or held? A preview would change it under the hand.
bool OperationPanel::Parts::is_hand_busy() const {
  bool holds = QGuiApplication::mouseButtons() != Qt::NoButton;
  for (std::size_t i = 0; i < session.hands().pointers(); ++i) holds = holds || session.hands().holds(i);
  return holds;
}

/// Shows the preview of the fields. An error is shown after a pause only, as typing may not be at its end.
void OperationPanel::Parts::refresh() {
  if (!form || !awake) return;
  if (is_hand_busy()) return due.start(kUpdate);
  const auto fields = form->given();
  if (fields && form->is_incomplete()) {
    preview.take_back();
    return show_state();
  }
  const auto done = fields ? show(*fields) : base::Result<void>(tl::unexpected(fields.error()));
  const qint64 typed = since_change.isValid() ? since_change.elapsed() : kPause;
  if (!done && typed < kPause) return due.start(int(kPause - typed));
  if (!done) refuse(!fields, done.error().message);
  show_state();
}

base::Result<void> OperationPanel::Parts::show(const interaction::Value::Fields& fields) {
  // Ends what is being done elsewhere; it may have been built on the preview.
  if (!hooks.begin()) rest();
  if (!awake) return {};
  QElapsedTimer time;
  time.start();
  const auto shown = preview.show(form->operation(), fields);
  slow = time.elapsed() > kSlow;
  if (!shown) return tl::unexpected(shown.error());
  (void)form->fields();  // clears the errors at the fields
  note->remark(QString::fromStdString(*shown));
  return {};
}

void OperationPanel::Parts::refuse(bool wrong_field, const std::string& why) {
  preview.take_back();
  const bool untouched = !since_change.isValid();
  if (wrong_field && !untouched) {
    (void)form->fields();
  } else if (untouched || !form->explain(why)) {
    note->remark(QString::fromStdString(why));
  }
}

/// The preview has ended, as something else was done.
void OperationPanel::Parts::end(OperationPreview::End how) {
  rest();
  if (how == OperationPreview::End::Kept) note->remark(kStays);
}

/// Stops updates of the preview until a field changes.
void OperationPanel::Parts::rest() {
  if (form) form->finish_typing();
  due.stop();
  awake = false;
  note->clear();
  show_state();
}

void OperationPanel::Parts::keep(const std::string& remark) {
  preview.keep();
  rest();
  follow();
  note->remark(QString::fromStdString(remark));
}

void OperationPanel::Parts::leave() {
  preview.take_back();
  rest();
  follow();
}

void OperationPanel::Parts::show_state() {
  close->setText(preview.shown() ? "&Cancel" : "&Close");
  close->setToolTip(preview.shown() ? "Takes it back and closes the form (Esc)"
                                    : "Leaves the design as it is (Esc)");
}

OperationPanel::OperationPanel(session::Session& session, Hooks hooks, QWidget* parent)
    : QWidget(parent), parts_(std::make_unique<Parts>(session, std::move(hooks), *this)) {
  setAccessibleName("Operation");
}

OperationPanel::~OperationPanel() {
  delete parts_->scroll->takeWidget();  // its fields report what was being typed
}

void OperationPanel::ask(const interaction::Operation& operation) {
  Parts& parts = *parts_;
  parts.leave();
  parts.title->setText(QString::fromStdString(operation.title));
  parts.summary->setText(QString::fromStdString(operation.summary));
  parts.form = new OperationForm(operation, parts.session, parts.scroll);
  parts.form->plan_on([&preview = parts.preview]() -> const world::World& { return preview.world(); });
  parts.form->on_change([&parts] { parts.change(); });
  parts.scroll->setWidget(parts.form);  // deletes the one before
  parts.form->show();
  parts.apply->setEnabled(true);
  parts.since_change.invalidate();
  parts.slow = false;
  parts.awake = true;
  parts.schedule();
}

QWidget* OperationPanel::first_field() const {
  if (!parts_->form) return nullptr;
  QWidget* const field = parts_->form->first_field();
  return field ? field : parts_->apply;
}

QString OperationPanel::remark() const {
  const QString text = parts_->note->text();
  return text == kStays ? QString() : text;
}

void OperationPanel::apply() {
  Parts& parts = *parts_;
  const bool was_shown = parts.preview.shown();
  if (!parts.form || !parts.hooks.begin()) return;
  if (was_shown && !parts.preview.shown()) return;  // it is kept already
  parts.rest();
  const auto fields = parts.form->fields();
  const auto done = fields ? parts.preview.show(parts.form->operation(), *fields)
                           : base::Result<std::string>(tl::unexpected(fields.error()));
  if (done) return parts.keep(*done);
  parts.preview.take_back();
  if (fields && !parts.form->explain(done.error().message))
    parts.note->keep(QString::fromStdString(done.error().message));
  parts.show_state();
  if (QWidget* explanation = parts.form->first_explanation())
    QTimer::singleShot(0, explanation,
                       [&parts, explanation] { parts.scroll->ensureWidgetVisible(explanation); });
}

void OperationPanel::keep() {
  if (parts_->preview.shown()) parts_->keep(kStays);
}

void OperationPanel::leave() { parts_->leave(); }

void OperationPanel::forget_remark() { parts_->forget_remark(); }

void OperationPanel::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) return parts_->close->click();
  QWidget::keyPressEvent(event);
}

}  // namespace icome::ui
