#pragma once
#include <QElapsedTimer>
#include <QWidget>

namespace icome::ui {

/// The one who is spoken to: a small face that shows whether it listens, hears, thinks, speaks, has
/// understood or has not (thesis 7.3, the metaphor of divinity).
class VoiceAgent final : public QWidget {
 public:
  enum class Mood : std::uint8_t { Asleep, Listening, Hearing, Busy, Speaking, Understood, Asking, Puzzled };

  explicit VoiceAgent(QWidget* parent);

  /// The mood from now on; what came of a sentence stays for a while before it.
  void show(Mood mood);
  /// Loudness of what is heard, 0 to 1.
  void show_level(double level);
  Mood mood() const;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Mood mood_ = Mood::Asleep, outcome_ = Mood::Asleep;
  QElapsedTimer since_outcome_;
  double level_ = 0.0;
  Mood drawn_ = Mood::Asleep;
};

}  // namespace icome::ui
