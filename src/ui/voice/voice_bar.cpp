#include "ui/voice/voice_bar.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QPushButton>
#include <QVBoxLayout>
#include <utility>

#include "ui/forms/elided_label.h"
#include "ui/look/theme.h"
#include "ui/panels/object_look.h"
#include "ui/voice/voice_ways.h"

namespace icome::ui {
namespace {

VoiceAgent::Mood mood_of(const speech::EarState& ear) {
  using Doing = speech::EarState::Doing;
  switch (ear.doing) {
    case Doing::Listening:
      return VoiceAgent::Mood::Listening;
    case Doing::Hearing:
      return VoiceAgent::Mood::Hearing;
    case Doing::Starting:
    case Doing::Understanding:
      return VoiceAgent::Mood::Busy;
    case Doing::Muted:
      return VoiceAgent::Mood::Speaking;
    case Doing::Lost:
      return VoiceAgent::Mood::Puzzled;
  }
  return VoiceAgent::Mood::Asleep;
}

VoiceAgent::Mood mood_of(const speech::Answer& answer) {
  using State = speech::Answer::State;
  return answer.state == State::Done    ? VoiceAgent::Mood::Understood
         : answer.state == State::Asked ? VoiceAgent::Mood::Asking
                                        : VoiceAgent::Mood::Puzzled;
}

/// From silence, 0, to as loud as may be, 1.
double share_of(double level) { return (level + 60.0) / 60.0; }

}  // namespace

VoiceBar::VoiceBar(session::Conversation& conversation, QSettings& settings, speech::OpenSource source,
                   std::function<void()> done, QWidget* parent)
    : QWidget(parent), conversation_(conversation), done_(std::move(done)) {
  setObjectName("voice");
  agent_ = new VoiceAgent(this);
  heard_ = new ElidedLabel(this);
  heard_->setObjectName("voice.heard");
  heard_->setText("Say what to do, such as: create a small red sphere");
  reply_ = new ElidedLabel(this);
  reply_->setObjectName("voice.reply");
  reply_->setAccessibleName("Reply");
  field_ = new QLineEdit(this);
  field_->setObjectName("voice.sentence");
  field_->setAccessibleName("Sentence");
  field_->setPlaceholderText("Type a sentence");
  field_->setClearButtonEnabled(true);
  microphone_ = new QToolButton(this);
  microphone_->setObjectName("voice.microphone");
  microphone_->setText("Listen");
  microphone_->setCheckable(true);
  microphone_->setToolTip("Listens to the microphone; what is heard is done at once, and undo takes it back");
  auto* const ways = new QPushButton("Options", this);
  ways->setObjectName("voice.options");
  ways->setFlat(true);
  ways->setToolTip("When it listens, and whether it speaks");
  ways->setMenu(new VoiceWays(conversation, settings, ways));
  auto* captions = new QVBoxLayout;
  captions->setSpacing(0);
  captions->addWidget(heard_);
  captions->addWidget(reply_);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, kGrid);
  row->setSpacing(2 * kGrid);
  row->addWidget(agent_);
  row->addLayout(captions, 3);
  row->addWidget(field_, 2);
  row->addWidget(microphone_);
  row->addWidget(ways);
  connect(field_, &QLineEdit::returnPressed, this, [this] { say(); });
  connect(microphone_, &QToolButton::toggled, this,
          [this, source = std::move(source)](bool on) { listen(on, source); });
}

/// While it listens, the key that is held down to talk counts wherever the keyboard is.
void VoiceBar::listen(bool on, const speech::OpenSource& source) {
  conversation_.listen(on ? source : nullptr);
  conversation_.hold(false);
  on ? qApp->installEventFilter(this) : qApp->removeEventFilter(this);
  if (!on) return;
  const session::ConversationWays& ways = conversation_.ways();
  if (conversation_.listens_while_held())
    reply_->setText("Hold F9, or the second button of a stylus, while you speak");
  else if (ways.wake_word)
    reply_->setText(QString("Begin with \u201c%1\u201d").arg(one_line(ways.wake_word->text())));
}

bool VoiceBar::eventFilter(QObject* watched, QEvent* event) {
  const bool is_press = event->type() == QEvent::KeyPress;
  if (is_press || event->type() == QEvent::KeyRelease) {
    const auto* const key = static_cast<QKeyEvent*>(event);
    if (key->key() == VoiceWays::kTalkKey && !key->isAutoRepeat()) conversation_.hold(is_press);
  } else if (event->type() == QEvent::ApplicationDeactivate) {
    conversation_.hold(false);  // its release goes to another program
  }
  return QWidget::eventFilter(watched, event);
}

void VoiceBar::say() {
  const QString sentence = field_->text().trimmed();
  if (sentence.isEmpty()) return done_();
  conversation_.say(sentence.toStdString());
  field_->clear();
}

void VoiceBar::show_answer(const session::Spoken& spoken) {
  const speech::Answer& answer = spoken.answer;
  QString heard = answer.heard.empty() ? QString() : QString("\u201c%1\u201d").arg(one_line(answer.heard));
  if (spoken.by_voice && !heard.isEmpty()) heard += QString(" (%1)").arg(spoken.score, 0, 'f', 1);
  heard_->setText(heard);
  problem_ = conversation_.problem();
  tell(one_line(answer.reply) + (problem_.empty() ? QString() : " " + one_line(problem_)));
  agent_->show(mood_of(answer));
}

void VoiceBar::tell(const QString& reply) {
  reply_->setText(reply);
  reply_->setToolTip(reply);
}

void VoiceBar::tick() {
  if (!isVisible()) return;
  // A loudspeaker that is missing is found out later than the reply.
  if (const std::string problem = conversation_.problem(); std::exchange(problem_, problem) != problem)
    tell(reply_->text() + " " + one_line(problem));
  if (!conversation_.listens()) {
    agent_->show(VoiceAgent::Mood::Asleep);
    return;
  }
  const speech::EarState ear = conversation_.ear();
  agent_->show(mood_of(ear));
  agent_->show_level(share_of(ear.level));
  if (!ear.problem.empty()) reply_->setText(one_line(ear.problem));
}

void VoiceBar::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  if (!event->spontaneous()) microphone_->setChecked(false);
}

void VoiceBar::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) return done_();
  QWidget::keyPressEvent(event);
}

}  // namespace icome::ui
