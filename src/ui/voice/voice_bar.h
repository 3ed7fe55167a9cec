#pragma once
#include <QLabel>
#include <QLineEdit>
#include <QSettings>
#include <QToolButton>
#include <QWidget>
#include <functional>

#include "session/speech/conversation.h"
#include "ui/voice/voice_agent.h"

namespace icome::ui {

/// The row under the scene for voice commands: who is spoken to, what was heard and what came of it, a field
/// to type sentences, and the button of the microphone. Conversation and settings outlive it.
class VoiceBar final : public QWidget {
 public:
  /// `source` opens the sound that the microphone's button listens to; `done` is called when the keyboard is
  /// to go back to the scene.
  VoiceBar(session::Conversation& conversation, QSettings& settings, speech::OpenSource source,
           std::function<void()> done, QWidget* parent);

  void show_answer(const session::Spoken& spoken);
  /// Brings the agent and the microphone's state up to date.
  void tick();
  QLineEdit& field() const { return *field_; }

 protected:
  void hideEvent(QHideEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void say();
  void listen(bool on, const speech::OpenSource& source);
  void tell(const QString& reply);

  session::Conversation& conversation_;
  std::function<void()> done_;
  VoiceAgent* agent_;
  QLabel *heard_, *reply_;
  QLineEdit* field_;
  QToolButton* microphone_;
  std::string problem_;  // that was told
};

}  // namespace icome::ui
