#pragma once
#include <QLineEdit>
#include <QMenu>
#include <QSettings>

#include "session/speech/conversation.h"

namespace icome::ui {

/// The menu of the ways in which voice commands are listened to and answered, kept in the settings.
/// Conversation and settings outlive it.
class VoiceWays final : public QMenu {
 public:
  VoiceWays(session::Conversation& conversation, QSettings& settings, QWidget* parent);

  /// The key that is held down to talk, for people.
  static constexpr Qt::Key kTalkKey = Qt::Key_F9;

 private:
  void add_listening();
  void add_word();
  void apply();

  session::Conversation& conversation_;
  QSettings& settings_;
  QLineEdit* word_ = nullptr;
};

}  // namespace icome::ui
