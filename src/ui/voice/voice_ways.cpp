#include "ui/voice/voice_ways.h"

#include <QActionGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QWidgetAction>

#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr const char* kListeningKey = "voice/listening";
constexpr const char* kWordKey = "voice/word";
constexpr const char* kSpeaksKey = "voice/speaks";
constexpr const char* kUsualWord = "computer";

/// When it listens while the microphone is on.
struct Listening {
  const char* name;  // in the settings
  const char* text;
};
constexpr Listening kAlways{"always", "&Always"};
constexpr Listening kHeld{"held", "While F9, or a Stylus's Second Button, Is &Held Down"};
constexpr Listening kCalled{"called", "After the &Word"};

}  // namespace

VoiceWays::VoiceWays(session::Conversation& conversation, QSettings& settings, QWidget* parent)
    : QMenu(parent), conversation_(conversation), settings_(settings) {
  setObjectName("voice.ways");
  addSection("Listen");
  add_listening();
  add_word();
  addSection("Answer");
  QAction* const speaks = addAction("&Speak Replies");
  speaks->setObjectName("voice.speaks");
  speaks->setCheckable(true);
  speaks->setChecked(settings_.value(kSpeaksKey, false).toBool());
  connect(speaks, &QAction::toggled, this, [this](bool on) {
    settings_.setValue(kSpeaksKey, on);
    apply();
  });
  apply();
}

void VoiceWays::add_listening() {
  auto* const group = new QActionGroup(this);
  const QString chosen = settings_.value(kListeningKey, kAlways.name).toString();
  for (const Listening& listening : {kAlways, kHeld, kCalled}) {
    QAction* const action = addAction(listening.text);
    action->setObjectName(QString("voice.") + listening.name);
    action->setCheckable(true);
    action->setChecked(chosen == listening.name ||
                       (listening.name == kAlways.name && !group->checkedAction()));
    group->addAction(action);
    connect(action, &QAction::triggered, this, [this, name = listening.name] {
      settings_.setValue(kListeningKey, name);
      apply();
    });
  }
}

/// The field for the word that people call by.
void VoiceWays::add_word() {
  auto* const row = new QWidget(this);
  word_ = new QLineEdit(settings_.value(kWordKey, kUsualWord).toString(), row);
  word_->setObjectName("voice.word");
  word_->setAccessibleName("Word to call by");
  auto* const columns = new QHBoxLayout(row);
  columns->setContentsMargins(4 * kGrid, 0, 2 * kGrid, kGrid);
  columns->addWidget(new QLabel("Word", row));
  columns->addWidget(word_);
  connect(word_, &QLineEdit::editingFinished, this, [this] {
    if (!speech::WakeWord::of(word_->text().toStdString())) {
      word_->setText(settings_.value(kWordKey, kUsualWord).toString());
      return;
    }
    settings_.setValue(kWordKey, word_->text());
    apply();
  });
  auto* const action = new QWidgetAction(this);
  action->setDefaultWidget(row);
  addAction(action);
}

void VoiceWays::apply() {
  session::ConversationWays ways;
  const QString listening = settings_.value(kListeningKey).toString();
  if (listening == kHeld.name) ways.attention = speech::Attention::WhileHeld;
  if (listening == kCalled.name) {
    const auto word = speech::WakeWord::of(settings_.value(kWordKey, kUsualWord).toString().toStdString());
    ways.wake_word = word ? *word : *speech::WakeWord::of(kUsualWord);
  }
  ways.speaks = settings_.value(kSpeaksKey, false).toBool();
  conversation_.set_ways(std::move(ways));
}

}  // namespace icome::ui
