#pragma once
#include <QLabel>
#include <QTimer>

namespace icome::ui {

/// A line on a panel that says why something was refused, near where it was asked for. It takes no room while
/// it has nothing to say, and goes by itself after some time.
class PanelNote final : public QLabel {
 public:
  explicit PanelNote(QWidget* parent);

  void say(const QString& why);
  void clear();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void dress();

  QTimer timer_;
};

}  // namespace icome::ui
