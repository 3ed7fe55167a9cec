#include "ui/voice/voice_bar.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QVBoxLayout>
#include <utility>

#include "ui/forms/elided_label.h"
#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

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

VoiceBar::VoiceBar(session::Conversation& conversation, speech::OpenSource source, std::function<void()> done,
                   QWidget* parent)
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
  connect(field_, &QLineEdit::returnPressed, this, [this] { say(); });
  connect(microphone_, &QToolButton::toggled, this,
          [this, source = std::move(source)](bool on) { conversation_.listen(on ? source : nullptr); });
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
  QString reply = one_line(answer.reply);
  if (!conversation_.problem().empty()) reply += " " + one_line(conversation_.problem());
  reply_->setText(reply);
  reply_->setToolTip(reply);
  agent_->show(mood_of(answer));
}

void VoiceBar::tick() {
  if (!isVisible()) return;
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
