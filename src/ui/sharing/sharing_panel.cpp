#include "ui/sharing/sharing_panel.h"

#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPainter>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QTimer>
#include <QVBoxLayout>

#include "ui/look/theme.h"
#include "ui/panels/object_look.h"
#include "ui/panels/wrapped_label.h"

namespace icome::ui {

using session::SessionSharing;
using Connection = collab::ConversationState;

namespace {

constexpr int kLookEvery = 100;               // ms, between two looks
constexpr std::int64_t kLongSilence = 5'000;  // ms; a server answers every two seconds or so
constexpr int kMostHeldNames = 3;             // of what somebody holds
constexpr int kMostSaid = 2'000;              // bytes that a server passes on
constexpr int kAuthorRole = Qt::UserRole;

QString held_words(const session::Session& session, const SessionSharing::Colleague& person) {
  if (person.holds.empty()) return {};
  QStringList names;
  for (const world::ObjectId id : person.holds)
    if (names.size() < kMostHeldNames) names << shortened(shown_name(session.world(), id), 24);
  const auto more = qsizetype(person.holds.size()) - names.size();
  return " \u2013 " + names.join(", ") + (more > 0 ? QString(" and %1 more").arg(more) : QString());
}

QString words_of(const session::Session& session, const SessionSharing::Colleague& person, bool followed) {
  QString text = shortened(one_line(person.name));
  if (text.isEmpty()) text = "Somebody";
  if (person.is_me) text += " (you)";
  if (person.role == collab::Role::View) text += ", looks on";
  if (followed) text += ", followed";
  return text + held_words(session, person);
}

}  // namespace

QIcon dot_of(std::uint32_t colour) {
  constexpr int kSide = 4 * kGrid, kScale = 2;
  QPixmap picture(kSide * kScale, kSide * kScale);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor::fromRgb(colour));
  painter.drawEllipse(QRectF(picture.rect()).adjusted(4, 4, -4, -4));
  return QIcon(picture);
}

QString sharing_words(const session::Session& session) {
  const auto state = session.sharing().state();
  if (!state) return {};
  const QString name = shortened(one_line(state->design), 24);
  const QString waits = state->unsent == 0 ? QString() : QString(", %L1 to send").arg(state->unsent);
  if (state->connection == Connection::Away) return name + ": no connection" + waits;
  if (state->connection == Connection::Joining) return name + ": connecting" + waits;
  if (state->silence > kLongSilence)
    return QString("%1: no answer for %2 s").arg(name).arg(state->silence / 1'000) + waits;
  const auto people = session.sharing().people().size();
  const QString delay = state->delay ? QString(", %1 ms").arg(*state->delay) : QString();
  return QString("%1: %2%3")
             .arg(name, people == 1 ? QString("you alone") : QString("%1 people").arg(people), delay) +
         (state->unsent > 20 ? waits : QString());
}

QString sharing_tip(const session::Session& session) {
  const auto state = session.sharing().state();
  if (!state) return {};
  QString text = one_line(state->address) + "\n";
  if (state->connection != Connection::Live) {
    text += "There is no connection: " + one_line(state->why) +
            (state->role == collab::Role::View
                 ? QString()
                 : QString("\nYou can go on: what you do is sent when the server is back."));
  } else {
    if (state->silence > kLongSilence)
      text += QString("The server has not answered for %1 s.\n").arg(state->silence / 1'000);
    text += state->delay ? QString("Answers come after %1 ms.").arg(*state->delay) : QString("Connected.");
    if (state->unsent > 0) text += QString("\n%L1 of your edits are under way.").arg(state->unsent);
  }
  if (state->role == collab::Role::View) text += "\nYou may look at it, but not change it.";
  return text;
}

struct SharingPanel::Parts {
  Parts(session::Session& of, Hooks its_hooks, SharingPanel& panel);

  void look();
  void show_people();
  void show_lines();
  void follow(const QListWidgetItem& item);
  void say();

  session::Session& session;
  Hooks hooks;
  WrappedLabel* state;
  QPushButton* open;
  QListWidget* people;
  QPlainTextEdit* words;
  QLineEdit* line;
  WrappedLabel* remark;  // why something could not be said
  QTimer* timer;
  std::uint64_t last_line = 0;
  QStringList shown_people;
};

SharingPanel::Parts::Parts(session::Session& of, Hooks its_hooks, SharingPanel& panel)
    : session(of),
      hooks(std::move(its_hooks)),
      state(new WrappedLabel("", &panel)),
      open(new QPushButton("Open an Address\u2026", &panel)),
      people(new QListWidget(&panel)),
      words(new QPlainTextEdit(&panel)),
      line(new QLineEdit(&panel)),
      remark(new WrappedLabel("", &panel)),
      timer(new QTimer(&panel)) {
  auto* column = new QVBoxLayout(&panel);
  column->setContentsMargins(2 * kGrid, 2 * kGrid, 2 * kGrid, 2 * kGrid);
  column->setSpacing(2 * kGrid);
  for (QWidget* it : std::initializer_list<QWidget*>{state, open, people}) column->addWidget(it);
  column->addWidget(words, 1);
  column->addWidget(line);
  column->addWidget(remark);
  remark->hide();
  state->setObjectName("sharing.state");
  open->setObjectName("sharing.open");
  people->setObjectName("sharing.people");
  people->setAccessibleName("People who are here");
  people->setToolTip(
      "Enter, or a double click, looks through somebody's eyes; the next move of yours ends it");
  people->setMaximumHeight(40 * kGrid);
  words->setObjectName("sharing.words");
  words->setAccessibleName("What people said");
  words->setReadOnly(true);
  words->setMaximumBlockCount(500);
  words->setTabChangesFocus(true);
  line->setObjectName("sharing.say");
  line->setAccessibleName("Say something to all who are here");
  line->setPlaceholderText("Say something to all");
  line->setMaxLength(kMostSaid);
  QObject::connect(open, &QPushButton::clicked, &panel, [this] { hooks.open(); });
  QObject::connect(people, &QListWidget::itemActivated, &panel,
                   [this](const QListWidgetItem* item) { follow(*item); });
  QObject::connect(line, &QLineEdit::returnPressed, &panel, [this] { say(); });
  QObject::connect(timer, &QTimer::timeout, &panel, [this] { look(); });
  timer->setInterval(kLookEvery);
  look();
}

void SharingPanel::Parts::look() {
  const bool is_shared = session.sharing().state().has_value();
  state->say(is_shared
                 ? sharing_tip(session)
                 : QString("This design is on no server. With the address of one that is, several people "
                           "work on it together."));
  open->setVisible(!is_shared);
  for (QWidget* it : std::initializer_list<QWidget*>{people, words, line}) it->setVisible(is_shared);
  if (!is_shared) {
    last_line = 0;
    words->clear();
    return;
  }
  show_people();
  show_lines();
}

void SharingPanel::Parts::show_people() {
  const auto all = session.sharing().people();
  QStringList texts;
  for (const auto& it : all)
    texts << QString("%1 %2").arg(it.author).arg(
        words_of(session, it, session.sharing().followed() == it.author));
  if (texts == shown_people && people->count() == int(all.size())) return;
  shown_people = texts;
  const int row = people->currentRow();
  people->clear();
  for (const auto& it : all) {
    auto* item = new QListWidgetItem(
        dot_of(it.colour), words_of(session, it, session.sharing().followed() == it.author), people);
    item->setData(kAuthorRole, it.is_me ? 0U : it.author);
  }
  people->setCurrentRow(std::min(row, people->count() - 1));
}

void SharingPanel::Parts::show_lines() {
  for (const session::SharedLine& it : session.sharing().lines()) {
    if (it.number <= last_line) continue;
    last_line = it.number;
    const QString name = shortened(one_line(it.name));
    const bool is_at_end = words->verticalScrollBar()->value() == words->verticalScrollBar()->maximum();
    words->appendPlainText(it.is_said ? name + ": " + QString::fromStdString(it.text)
                                      : name + " " + QString::fromStdString(it.text));
    if (is_at_end) words->verticalScrollBar()->setValue(words->verticalScrollBar()->maximum());
  }
}

void SharingPanel::Parts::follow(const QListWidgetItem& item) {
  const std::uint32_t author = item.data(kAuthorRole).toUInt();
  const bool ends = author == 0 || session.sharing().followed() == author;
  session.sharing().follow(ends ? std::nullopt : std::optional(author));
  look();
}

void SharingPanel::Parts::say() {
  const auto said = session.sharing().say(line->text().toStdString());
  remark->setVisible(!said);
  if (said) return line->clear();
  remark->say(one_line(said.error().message));
}

SharingPanel::SharingPanel(session::Session& session, Hooks hooks, QWidget* parent)
    : QWidget(parent), parts_(std::make_unique<Parts>(session, std::move(hooks), *this)) {
  setAccessibleName("People");
}

SharingPanel::~SharingPanel() = default;

void SharingPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  parts_->look();
  parts_->timer->start();
}

void SharingPanel::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  parts_->timer->stop();
}

}  // namespace icome::ui
